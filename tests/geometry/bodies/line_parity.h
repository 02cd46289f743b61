// Lines that cross a closed body an odd number of times: there are none, whichever way they go, but for those that
// graze or meet within rounding an edge in which the body touches itself.
#pragma once

#include <random>

#include "geometry/body.h"
#include "geometry/queries/rays/line_intersections.h"
#include "geometry/vectors.h"

namespace lekalo::geometry {

struct LineParity {
  int lines = 0;
  int odd = 0;
  // Odd, but even for most copies that are shifted by 1e-9 of the size; of lines that were not aimed at anything, and
  // of those at edges and vertices.
  int in_band = 0, aimed_in_band = 0;
  LineParity& operator+=(const LineParity& other) {
    lines += other.lines, odd += other.odd, in_band += other.in_band, aimed_in_band += other.aimed_in_band;
    return *this;
  }
};

// Lines through points of the body's box, of its edges, and of the surroundings of its vertices.
inline LineParity line_parity(const Body& body, const LineIntersector& intersector, int count, unsigned seed) {
  constexpr double kBesideVertex = 1e-5, kShift = 1e-9;  // of the size
  constexpr int kCopies = 32, kFewOdd = 8;
  const Box3 box = bounds(body);
  const double size = box.diameter();
  std::mt19937 random(seed);
  const auto unit = [&] { return std::uniform_real_distribution<double>(0, 1)(random); };
  const auto vector = [&] {
    const double x = unit(), y = unit(), z = unit();
    return Vec3(x, y, z);
  };
  const auto any_direction = [&] {
    for (;;) {
      const Vec3 v = 2.0 * vector() - Vec3(1);
      if (const double length = glm::length(v); length > 0.1 && length < 1) return v / length;
    }
  };
  const auto one_of = [&](const auto& list) -> const auto& {
    return list[static_cast<size_t>(unit() * static_cast<double>(list.size()))];
  };
  const auto hits = [&](const Line& line) { return intersector.all_hits(line, {0, 4 * size}).size(); };
  LineParity result;
  for (int k = 0; k < count; ++k) {
    Vec3 through;
    if (k % 3 == 1) {
      const Edge& edge = one_of(body.edges);
      through = edge.curve->point(edge.curve->domain().lo + unit() * edge.curve->domain().width());
    } else if (k % 3 == 2) {
      through = one_of(body.vertices).point + unit() * kBesideVertex * size * any_direction();
    } else {
      through = box.lo + vector() * (box.hi - box.lo);
    }
    const Vec3 direction = any_direction();
    const Line line{through - 2 * size * direction, direction};
    ++result.lines;
    if (hits(line) % 2 == 0) continue;
    int still_odd = 0;
    for (int copy = 0; copy < kCopies; ++copy)
      still_odd += hits({line.origin + kShift * size * any_direction(), direction}) % 2 != 0;
    ++(still_odd > kFewOdd ? result.odd : k % 3 == 0 ? result.in_band : result.aimed_in_band);
  }
  return result;
}

}  // namespace lekalo::geometry
