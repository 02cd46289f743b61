#include "geometry/queries/rays/sampled_extent.h"

#include <algorithm>
#include <vector>

#include "geometry/point_formulas.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// Bounds this many times larger than the sampled extent are those of the enclosure, not of the surface.
constexpr double kImplausible = 8;
constexpr int kSteps = 16;           // of the grid that tells the surface's size
constexpr size_t kMaxParts = 400;    // about a place in the middle of a cell four rows of 40 halvings, two parts each
constexpr double kMaxGrowth = 1000;  // of the points' box by a part's own: more is a pole

double at(const Interval& range, int i, int steps) { return range.lo + (range.hi - range.lo) * i / steps; }

}  // namespace

SampledExtent::SampledExtent(const Surface& surface) : surface_(surface), domain_(surface.domain()) {
  // By medians: a few points near a pole are not what the surface is like.
  std::vector<double> coordinates[3], distances;
  std::vector<Vec3> points;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j)
      if (const Vec3 p = surface.point(at(domain_.u, i, kSteps), at(domain_.v, j, kSteps)); is_finite(p))
        points.push_back(p);
  if (points.empty()) return;
  const auto median = [](std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  };
  Vec3 middle;
  for (int k = 0; k < 3; ++k) {
    for (const Vec3& p : points) coordinates[k].push_back(p[k]);
    middle[k] = median(coordinates[k]);
  }
  for (const Vec3& p : points) distances.push_back(glm::length(p - middle));
  typical_ = 2 * median(distances);
}

bool SampledExtent::is_plausible(double by_bounds, const CellModel& model) {
  return by_bounds <= kImplausible * (glm::length(model.dx) + glm::length(model.dy));
}

double SampledExtent::share(const Rectangle& cell) const {
  return std::max(cell.u.width() / domain_.u.width(), cell.v.width() / domain_.v.width());
}

Box3 SampledExtent::points(const Rectangle& cell) const {
  Box3 box;
  for (int i = 0; i <= 2; ++i)
    for (int j = 0; j <= 2; ++j)
      if (const Vec3 p = surface_.point(at(cell.u, i, 2), at(cell.v, j, 2)); is_finite(p)) box.include(p);
  return box;
}

double SampledExtent::size(const Rectangle& cell, const CellModel& model) const {
  const double by_bounds = model.reach_x() + model.reach_y();
  if (is_plausible(by_bounds, model)) return by_bounds;
  const Box3 sampled = points(cell);
  const double by_points = sampled.empty() ? 0 : 0.5 * kImplausible * sampled.diameter();
  return std::min(model.is_bounded() ? by_bounds : kImplausible * typical_ * share(cell), by_points);
}

Box3 SampledExtent::hull(const Rectangle& cell, const CellModel& model) const {
  struct Part {
    Rectangle box;
    Box3 hull;
    double size = 0;
  };
  const auto part_of = [&](const Rectangle& box) {
    Part part{box, surface_.enclose(box, 0).values[0]};
    part.size = part.hull.bounded() ? 0.5 * part.hull.diameter() : kInfinity;
    return part;
  };
  const Part whole = part_of(cell);
  if (is_plausible(whole.size, model)) return whole.hull;
  std::vector<Part> parts{whole};
  const auto is_smaller = [](const Part& a, const Part& b) { return a.size < b.size; };
  const Box3 sampled = points(cell);
  const double enough = sampled.empty() ? 0 : kImplausible * sampled.diameter();
  Box3 result;
  // The loosest first. Parts too small to be divided leave the list, so that their number bounds no work.
  for (size_t looked_at = 0; looked_at < kMaxParts && parts.front().size > enough; ++looked_at) {
    std::pop_heap(parts.begin(), parts.end(), is_smaller);
    const Part loosest = parts.back();
    parts.pop_back();
    if (share(loosest.box) < kSmallestCell) {
      const Box3 here = points(loosest.box);
      if (!here.empty() && here.diameter() > kMaxGrowth * sampled.diameter()) return whole.hull;
      result.include(here);
      if (parts.empty()) break;
      continue;
    }
    Rectangle first = loosest.box, second = first;
    if (first.u.width() * domain_.v.width() >= first.v.width() * domain_.u.width())
      first.u.hi = second.u.lo = first.u.middle();
    else
      first.v.hi = second.v.lo = first.v.middle();
    for (const Rectangle& half : {first, second}) {
      parts.push_back(part_of(half));
      std::push_heap(parts.begin(), parts.end(), is_smaller);
    }
  }
  for (const Part& part : parts) result.include(part.hull);
  return result;
}

}  // namespace lekalo::geometry
