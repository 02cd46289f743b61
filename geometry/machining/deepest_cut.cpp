#include "geometry/machining/deepest_cut.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lekalo::geometry {

namespace {

constexpr int kGrid = 64;      // of the surface, each way
constexpr int kPoses = 1000;   // of the path, about
constexpr int kMinPoses = 16;  // of a move
constexpr int kHalvings = 40;  // of the steps of both
constexpr int kMaxSteps = 2000;
// What is less deep, of the radius, is contact.
constexpr double kContact = 1e-9;

struct Place {
  Vec3 point;
  double u, v;
};

std::vector<Place> places_of(const Surface& part) {
  const Rectangle d = part.domain();
  std::vector<Place> places;
  for (int i = 0; i <= kGrid; ++i)
    for (int j = 0; j <= kGrid; ++j) {
      const double u = d.u.clamp(d.u.lo + d.u.width() * i / kGrid), v = d.v.clamp(d.v.lo + d.v.width() * j / kGrid);
      places.push_back({part.point(u, v), u, v});
    }
  return places;
}

// Above the end, hollow or not.
double depth_over_end(const Cutter& cutter, double distance, double height) {
  if (cutter.corner_radius >= 0) return height;
  const double r = -cutter.corner_radius, low = std::sqrt(r * r - cutter.radius * cutter.radius);
  return std::hypot(distance, height + low) - r;
}

}  // namespace

double depth_inside(const Cutter& cutter, double distance, double height) {
  const Vec2 flank = cutter.flank_start();
  const double rho = cutter.rounding(), c = std::cos(cutter.angle), s = std::sin(cutter.angle);
  double depth = std::min(depth_over_end(cutter, distance, height), cutter.length - height);
  if (!(depth > 0)) return depth;
  // Across the flank, from a point of it; a disc has none.
  if (c > 1e-9) depth = std::min(depth, (flank.x - distance) * c + (height - flank.y) * s);
  const Vec2 from_center(distance - cutter.ring_radius(), height - rho);
  // Where the corner is nearest: beyond the end, and before the flank begins.
  const bool is_beyond_end = cutter.ring_radius() < 0 || from_center.x > 0;
  const bool is_before_flank = from_center.x * s + from_center.y * c < 0;
  if (rho > 0 && is_beyond_end && is_before_flank) depth = std::min(depth, rho - glm::length(from_center));
  return depth;
}

namespace {

// Places of a move and of the part, and how deep the point is in the cutter there.
struct Probe {
  const Cutter& cutter;
  const Surface& part;
  const ToolMove* move = nullptr;
  std::array<double, 3> at{};  // t, u, v
  double depth = 0;

  std::array<Interval, 3> ranges() const { return {move->curve->domain(), part.domain().u, part.domain().v}; }
  double depth_at(const std::array<double, 3>& place) const {
    const CutterPose pose = move->pose(place[0]);
    const Vec3 from = part.point(place[1], place[2]) - pose.reference;
    const double height = glm::dot(from, pose.axis);
    return depth_inside(cutter, std::sqrt(std::max(glm::dot(from, from) - height * height, 0.0)), height);
  }
  // Uphill along the coordinates by ever smaller steps (Hooke, Jeeves 1961).
  void climb(std::array<double, 3> step) {
    const auto range = ranges();
    for (int k = 0, steps = 0; k < kHalvings && steps < kMaxSteps; ++steps) {
      bool rises = false;
      for (const size_t i : {0, 1, 2})
        for (const double way : {-1.0, 1.0}) {
          std::array<double, 3> place = at;
          place[i] = range[i].clamp(place[i] + way * step[i]);
          const double found = depth_at(place);
          if (!(found > depth)) continue;
          depth = found, at = place, rises = true;
        }
      if (rises) continue;
      for (double& one : step) one *= 0.5;
      ++k;
    }
  }
};

}  // namespace

DeepestCut deepest_cut(const ToolPath& path, const Surface& part) {
  const Cutter& cutter = path.cutter();
  const double reach = std::max({cutter.radius, cutter.top_radius(), cutter.flank_radius()});
  const std::vector<Place> places = places_of(part);
  Probe deepest{cutter, part};
  const int count = std::max(kMinPoses, kPoses / static_cast<int>(path.moves().size()));
  for (const ToolMove& move : path.moves()) {
    if (move.kind != ToolMove::Kind::cut && move.kind != ToolMove::Kind::link) continue;
    const Interval range = move.curve->domain();
    for (int k = 0; k <= count; ++k) {
      const double t = range.clamp(range.lo + range.width() * k / count);
      const CutterPose pose = move.pose(t);
      for (const Place& place : places) {
        const Vec3 from = place.point - pose.reference;
        const double height = glm::dot(from, pose.axis);
        if (height < -reach || height > cutter.length) continue;
        const double distance = std::sqrt(std::max(glm::dot(from, from) - height * height, 0.0));
        if (distance > reach) continue;
        const double depth = depth_inside(cutter, distance, height);
        if (depth > deepest.depth) deepest.move = &move, deepest.at = {t, place.u, place.v}, deepest.depth = depth;
      }
    }
  }
  if (deepest.depth <= kContact * cutter.radius) return {};
  const auto range = deepest.ranges();
  deepest.climb({range[0].width() / count, range[1].width() / kGrid, range[2].width() / kGrid});
  return {deepest.depth, deepest.at[1], deepest.at[2]};
}

}  // namespace lekalo::geometry
