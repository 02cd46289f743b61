// The edges along which a tube goes through itself (declared in tube_lines.h).
//
// Walls meet one another and themselves (self_intersections.h), balls and flat ends. A wall of constant radius R about
// a curve whose curvature is at most k, R k < 1, does not meet itself along a stretch of it that is no longer than
// pi/k: the ball of radius R that touches the curve's circle of curvature 1/k lies in the ball of that radius, outside
// of which the stretch keeps (Schur's theorem; do Carmo 1976, 5-7, exercise 7).
#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/describe.h"
#include "geometry/queries/ball_circles.h"
#include "geometry/queries/box_tree.h"
#include "geometry/queries/self_intersections.h"
#include "geometry/queries/tube_lines.h"

namespace lekalo::geometry {

namespace {

using Cell = BallSweep::Cell;

std::vector<Cell> cells_in(const BallSweep& sweep, const Interval& range) {
  std::vector<Cell> cells;
  for (const Cell& cell : sweep.cells())
    if (intersect(cell.t, range).width() > kSameOnBalls * range.width()) cells.push_back(cell);
  return cells;
}

// Bounds over a cell.
struct Bend {
  double curvature, length;
};
Bend bend_of(const Cell& cell) {
  const Vec3 &r1 = cell.middle.center[1], &r2 = cell.middle.center[2];
  const double h = 0.5 * cell.t.width(), speed = glm::length(r1);
  const double turn = (glm::length(r2) + cell.wander) * h, slowest = speed - turn;
  const double along = glm::dot(r1, r2) / (speed * speed);
  const double across = glm::length(r2 - along * r1) + cell.wander + std::abs(along) * turn;
  return {slowest > 0 ? across / (slowest * slowest) : kInfinity, 2 * h * (speed + turn)};
}

double apart(const Box3& a, const Box3& b) {
  return glm::length(glm::max(Vec3(0), glm::max(a.lo - b.hi, b.lo - a.hi)));
}

}  // namespace

bool TubeBoundary::bends_too_much(const CanalSurface& wall) const {
  constexpr int kPlaces = 4, kAngles = 24;
  for (const Cell& cell : cells_in(tube_.sweep(), wall.domain().u)) {
    if (cell.regular) continue;
    for (int i = 0; i <= kPlaces; ++i)
      for (int k = 0; k < kAngles; ++k) {
        const double u = wall.domain().u.clamp(cell.t.lo + cell.t.width() * i / kPlaces), v = kTwoPi * k / kAngles;
        if (glm::dot(wall.normal(u, v), wall.outward(u, v)) < 0) return true;
      }
  }
  return false;
}

bool TubeBoundary::bends_too_much() const {
  return std::any_of(parts_.begin(), parts_.end(),
                     [this](const Part& part) { return part.wall && bends_too_much(*part.wall); });
}

bool TubeBoundary::may_meet_itself(const CanalSurface& wall) const {
  const std::vector<Cell> cells = cells_in(tube_.sweep(), wall.domain().u);
  const double radius = cells.front().middle.radius[0];
  double most = 0;
  std::vector<double> from{0};  // along the curve, at most
  std::vector<Box3> centers;
  for (const Cell& cell : cells) {
    if (cell.middle.radius[1] != 0 || cell.middle.radius[2] != 0 || cell.radius_wander != 0) return true;
    const Bend bend = bend_of(cell);
    most = std::max(most, bend.curvature);
    from.push_back(from.back() + bend.length);
    centers.push_back(cell.box.inflated(-radius));
  }
  if (!(most * radius < 1)) return true;
  const BoxTree tree(centers);
  const double safe = kPi / most;  // infinite for a straight one
  for (size_t i = 0; i < cells.size(); ++i) {
    bool meets = false;
    tree.around(centers[i].inflated(2 * radius), [&](int other) {
      const auto k = static_cast<size_t>(other);
      if (k <= i || from[k + 1] - from[i] <= safe) return;
      if (wall.periods().u > 0 && from.back() - (from[k] - from[i + 1]) <= safe) return;
      meets = meets || apart(centers[i], centers[k]) <= 2 * radius;
    });
    if (meets) return true;
  }
  return false;
}

std::optional<TubeBoundary::Part> TubeBoundary::apart_from(const Part& part, const Part& other) const {
  if (!part.wall) return part;
  const BallSweep& sweep = tube_.sweep();
  const Interval whole = sweep.curve().domain();
  const Interval range = part.wall->domain().u;
  const auto is_one = [&](double a, double b) {
    return std::abs(a - b) <= kSameOnBalls * whole.width() ||
           (sweep.curve().is_closed() && std::abs(std::abs(a - b) - whole.width()) <= kSameOnBalls * whole.width());
  };
  // Where the other part begins and ends.
  std::vector<double> ends;
  if (other.before) ends.push_back(*other.before);
  if (other.after) ends.push_back(*other.after);
  if (other.wall) ends = {other.wall->domain().u.lo, other.wall->domain().u.hi};
  if (other.end >= 0) ends = {other.end == 0 ? whole.lo : whole.hi};
  const std::vector<Cell> cells = cells_in(sweep, range);
  const int count = static_cast<int>(cells.size());
  int first = 0, last = count;
  for (const double end : ends) {
    const int own = other.end >= 0 ? tube_.end(other.end).end - tube_.end(other.end).begin : 0;  // of a flat end
    if (is_one(range.lo, end)) first = std::max(1, own);
    if (is_one(range.hi, end)) last = count - std::max(1, own);
  }
  if (first == 0 && last == count) return part;
  if (first >= last) return std::nullopt;
  const auto wall = std::make_shared<CanalSurface>(
      sweep, Interval{cells[static_cast<size_t>(first)].t.lo, cells[static_cast<size_t>(last - 1)].t.hi}, false);
  return Part{wall, wall, {}, {}, -1};
}

bool TubeBoundary::meet_in_curved_corner(const CanalSurface& a, const CanalSurface& b) const {
  const BallSweep& sweep = tube_.sweep();
  const auto is_corner_between = [&](double before, double after) {
    return is_corner(sweep, next_down(before), after) && !is_straight_corner(sweep, next_down(before), after);
  };
  const Interval whole = sweep.curve().domain(), first = a.domain().u, second = b.domain().u;
  return (first.hi == second.lo && is_corner_between(first.hi, second.lo)) ||
         (sweep.curve().is_closed() && first.lo == whole.lo && second.hi == whole.hi &&
          is_corner_between(second.hi, first.lo));
}

ShapeOutlines TubeBoundary::edges(const ViewOf& view) const {
  ShapeOutlines found;
  found.complete = complete_;
  const auto add = [&](const Contours& contours, const Part& a, const Part& b) {
    found.complete = found.complete && contours.complete;
    for (const Contour& contour : contours.branches)
      if (contour.kind == ContourKind::crossing) add_edges(contour, a, b, view, found);
  };
  for (size_t i = 0; i < parts_.size(); ++i) {
    const Part& part = parts_[i];
    if (part.wall) {
      if (!bends_too_much(*part.wall) && may_meet_itself(*part.wall)) add(self_intersection(part.surface), part, part);
    }
    for (size_t k = i + 1; k < parts_.size(); ++k) {
      const Part& other = parts_[k];
      if (!BoxTree::meets(bounds(*part.surface), bounds(*other.surface))) continue;
      const bool is_crease = part.wall && other.wall && meet_in_curved_corner(*part.wall, *other.wall);
      const std::optional<Part> a = part.wall && other.wall ? part : apart_from(part, other),
                                b = is_crease ? other : apart_from(other, part);
      if (a && b && BoxTree::meets(bounds(*a->surface), bounds(*b->surface)))
        add(intersect(a->surface, b->surface), *a, *b);
    }
  }
  return found;
}

}  // namespace lekalo::geometry
