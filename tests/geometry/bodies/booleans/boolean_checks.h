// Whether booleans of two bodies are right: validity, identities of volume and area, rays through the CSG, membership,
// and lines that cross the result an even number of times.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "geometry/bodies/booleans/boolean.h"
#include "geometry/bodies/line_parity.h"
#include "geometry/queries/closest/position.h"
#include "geometry/queries/measures/mass_properties.h"
#include "geometry/queries/rays/line_intersections.h"
#include "geometry/shapes/csg/body_shape.h"
#include "geometry/shapes/csg/csg.h"
#include "geometry/vectors.h"

namespace lekalo::geometry {

struct BooleanReport {
  std::vector<std::string> refused, wrong;
  LineParity parity;  // of all results together
};

struct BooleanChecks {
  int rays = 65'536;
  int points = 1'000;
  int crossing_lines = 200;  // of each result
  bool areas = true;         // no face of one body lies on one of the other
};

namespace boolean_checks {

// The volume of a solid by parallel rays on a quasi-random set (Roberts' R2), and its standard error, of which too few
// rays that meet it tell nothing.
struct RayVolume {
  double value = 0, error = 0;
  int met = 0;
};
inline RayVolume volume_by_rays(const Shape& shape, const Box3& box, const Vec3& direction, int count) {
  const Frame frame = frame_about(box.center(), direction);
  const double reach = 0.5 * box.diameter();
  double sum = 0, squares = 0;
  int met = 0;
  std::vector<SurfaceHit> hits;
  for (int k = 0; k < count; ++k) {
    const double x = std::fmod(0.5 + 0.7548776662466927 * k, 1.0), y = std::fmod(0.5 + 0.5698402909980532 * k, 1.0);
    const Line line{box.center() + reach * ((2 * x - 1) * frame.x + (2 * y - 1) * frame.y - 1.1 * frame.z), frame.z};
    hits.clear();
    shape.all_hits(line, {0, 2.2 * reach}, hits);
    double inside = 0;
    for (size_t h = 0; h + 1 < hits.size(); h += 2) inside += hits[h + 1].t - hits[h].t;
    sum += inside;
    squares += inside * inside;
    met += inside > 0 ? 1 : 0;
  }
  const double mean = sum / count, area = 4 * reach * reach;
  return {area * mean, area * std::sqrt(std::max(0.0, squares / count - mean * mean) / count), met};
}

}  // namespace boolean_checks

// `seed` gives the direction of the rays and the points.
inline BooleanReport check_booleans(const Body& a, const Body& b, unsigned seed, const BooleanChecks& checks = {}) {
  constexpr std::array<const char*, 4> kNames{"or", "and", "minus", "minus, exchanged"};
  const std::array<Csg::Operation, 4> in_csg{Csg::Operation::unite, Csg::Operation::intersect, Csg::Operation::subtract,
                                             Csg::Operation::subtract};
  BooleanReport report;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  const Vec3 direction = glm::normalize(Vec3(unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5));
  const Box3 of_first = bounds(a), of_second = bounds(b),
             shared{glm::max(of_first.lo, of_second.lo), glm::min(of_first.hi, of_second.hi)};
  Box3 box = of_first;
  box.include(of_second);
  const std::array<Box3, 4> boxes{box, shared, of_first, of_second};
  std::vector<Vec3> points;
  for (int k = 0; k < checks.points; ++k) {
    const double x = unit(random), y = unit(random), z = unit(random);
    points.push_back(box.lo + Vec3(x, y, z) * (box.hi - box.lo));
  }
  const auto body_a = std::make_shared<Body>(a), body_b = std::make_shared<Body>(b);
  const LineIntersector lines_a(a), lines_b(b);
  const MassProperties of_a = measure(a), of_b = measure(b);
  const double volumes = of_a.volume.value + of_b.volume.value, areas = of_a.area.value + of_b.area.value;
  std::array<std::optional<MassProperties>, 4> results;
  for (int k = 0; k < 4; ++k) {
    const auto wrong = [&](const std::string& what) { report.wrong.push_back(fmt::format("{}: {}", kNames[k], what)); };
    Body body;
    try {
      body = boolean(k == 3 ? BooleanOperation::subtract : static_cast<BooleanOperation>(k), k == 3 ? b : a,
                     k == 3 ? a : b);
    } catch (const BooleanError& error) {
      if (error.empty)
        results[k] = MassProperties{};
      else
        report.refused.push_back(fmt::format("{}: {}", kNames[k], error.what()));
    } catch (const std::exception& error) {
      // Not by its name.
      report.refused.push_back(fmt::format("{}: {} (not a BooleanError)", kNames[k], error.what()));
    }
    if (!body.faces.empty()) {
      for (const Violation& violation : body.violations()) wrong(violation.condition + " " + violation.entity);
      results[k] = measure(body);
      const LineIntersector lines(body);
      int astray = 0;
      for (const Vec3& p : points) {
        const bool in_a = is_inside(p, lines_a), in_b = is_inside(p, lines_b);
        const bool expected = k == 0 ? in_a || in_b : k == 1 ? in_a && in_b : k == 2 ? in_a && !in_b : in_b && !in_a;
        astray += is_inside(p, lines) != expected;
      }
      if (astray > 0) wrong(fmt::format("{} points astray", astray));
      const LineParity parity = line_parity(body, lines, checks.crossing_lines, 4 * seed + static_cast<unsigned>(k));
      report.parity += parity;
      if (parity.odd > 0) wrong(fmt::format("{} lines cross it an odd number of times", parity.odd));
    }
    if (!results[k] || checks.rays == 0) continue;
    boolean_checks::RayVolume by_rays;
    if (boxes[k].empty()) continue;
    try {
      const ShapePtr first = std::make_shared<BodyShape>(k == 3 ? body_b : body_a),
                     second = std::make_shared<BodyShape>(k == 3 ? body_a : body_b);
      by_rays = boolean_checks::volume_by_rays(Csg(in_csg[k], {first, second}), boxes[k], direction, checks.rays);
    } catch (const std::invalid_argument&) {
      // Nothing can be left.
    }
    constexpr int kFewestRays = 30;
    if (by_rays.met < kFewestRays) continue;
    if (!(std::abs(by_rays.value - results[k]->volume.value) <= 4 * by_rays.error + 1e-9 * volumes))
      wrong(fmt::format("volume {:.17g}, by rays {:.9g} +- {:.2g}", results[k]->volume.value, by_rays.value,
                        by_rays.error));
  }
  const auto identity = [&](const char* name, double found, double expected, double scale) {
    if (!(std::abs(found - expected) <= 1e-9 * scale))
      report.wrong.push_back(fmt::format("{}: off by {:.3g} of {:.3g}", name, found - expected, scale));
  };
  const auto volume = [&](int k) { return results[k]->volume.value; };
  const auto area = [&](int k) { return results[k]->area.value; };
  if (results[0] && results[1]) {
    identity("volumes of or and and", volume(0) + volume(1), volumes, volumes);
    if (checks.areas) identity("areas of or and and", area(0) + area(1), areas, areas);
  }
  if (results[1] && results[2]) identity("volume of minus", volume(2), of_a.volume.value - volume(1), volumes);
  if (results[1] && results[3])
    identity("volume of minus, exchanged", volume(3), of_b.volume.value - volume(1), volumes);
  if (results[2] && results[3] && checks.areas) identity("areas of both minus", area(2) + area(3), areas, areas);
  return report;
}

}  // namespace lekalo::geometry
