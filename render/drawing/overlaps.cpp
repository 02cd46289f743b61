#include "render/drawing/overlaps.h"

#include <algorithm>
#include <cmath>

namespace lekalo::render {

namespace {

constexpr double kSame = 1e-3;      // millimetres between lines that are one
constexpr double kShortest = 1e-2;  // of what is left
constexpr int kPlaces = 32;         // on each step of a curve
constexpr int kPlacesOnSide = 7;    // of a path with corners: others may touch it where a construction says so

double distance_from(const Vec2& place, const Vec2& a, const Vec2& b) {
  const Vec2 way = b - a;
  const double square = glm::dot(way, way);
  const double x = square > 0 ? std::clamp(glm::dot(place - a, way) / square, 0.0, 1.0) : 0;
  return glm::length(place - (a + x * way));
}

}  // namespace

std::vector<Vec2> Overlaps::places_on(const Path& path) {
  std::vector<Vec2> places{path.from};
  for (const PathStep& step : path.steps) {
    const Vec2 begin = places.back();
    const int parts = step.kind != PathStep::Kind::line ? kPlaces : path.steps.size() == 1 ? 1 : kPlacesOnSide;
    for (int k = 1; k <= parts; ++k) places.push_back(point_on(begin, step, static_cast<double>(k) / parts));
  }
  return places;
}

bool Overlaps::is_covered(const Vec2& place) const {
  for (const Drawn& one : drawn_) {
    if (place.x < one.lo.x - kSame || place.x > one.hi.x + kSame || place.y < one.lo.y - kSame ||
        place.y > one.hi.y + kSame)
      continue;
    for (size_t k = 0; k + 1 < one.places.size(); ++k)
      if (distance_from(place, one.places[k], one.places[k + 1]) < kSame) return true;
  }
  return false;
}

std::vector<Path> Overlaps::left_of(const Path& path) {
  const bool straight = path.steps.size() == 1 && path.steps[0].kind == PathStep::Kind::line;
  Drawn own{path.from, path.from, straight, places_on(path), path.from, path.from};
  for (const Vec2& place : own.places) own.lo = glm::min(own.lo, place), own.hi = glm::max(own.hi, place);
  std::vector<Path> left;
  if (!straight) {
    // In the middle of its places too, where no other line's chord can be its own by chance.
    bool covered = true;
    for (size_t k = 0; k + 1 < own.places.size() && covered; ++k)
      covered = is_covered(own.places[k]) && is_covered(0.5 * (own.places[k] + own.places[k + 1]));
    if (!covered) left.push_back(path);
  } else {
    own.to = path.steps[0].to;
    const Vec2 way = own.to - own.from;
    const double length = glm::length(way);
    if (!(length > 0)) return {path};
    const Vec2 along = way / length;
    std::vector<std::pair<double, double>> covered;
    for (const Drawn& one : drawn_) {
      if (!one.straight || own.lo.x > one.hi.x + kSame || one.lo.x > own.hi.x + kSame || own.lo.y > one.hi.y + kSame ||
          one.lo.y > own.hi.y + kSame)
        continue;
      const auto off = [&](const Vec2& p) {
        return std::abs((p.x - own.from.x) * along.y - (p.y - own.from.y) * along.x);
      };
      if (off(one.from) > kSame || off(one.to) > kSame) continue;
      const double a = glm::dot(one.from - own.from, along), b = glm::dot(one.to - own.from, along);
      covered.emplace_back(std::min(a, b), std::max(a, b));
    }
    std::sort(covered.begin(), covered.end());
    double at = 0;
    const auto keep = [&](double from, double to) {
      if (to - from < (covered.empty() ? 0 : kShortest)) return;
      Path part;
      part.from = own.from + from * along;
      part.steps.push_back(line_to(to == length ? own.to : own.from + to * along));
      left.push_back(std::move(part));
    };
    for (const auto& [from, to] : covered) {
      if (from > at) keep(at, std::min(from, length));
      at = std::max(at, to);
    }
    if (at < length) keep(at, length);
  }
  if (!left.empty()) drawn_.push_back(std::move(own));
  return left;
}

}  // namespace lekalo::render
