// The parameter lines of a tube (declared in tube_lines.h).
//
// Those of its walls, as far as they are bare. A line along the curve reaches a corner at the direction n of its ball;
// where the curve turns there from e to f, n turns with it about e x f, and ends where the line of the next wall
// begins.
#include <algorithm>
#include <cmath>

#include "geometry/curves/analytic/circle.h"
#include "geometry/point_formulas.h"
#include "geometry/queries/contours/contour_approximation.h"
#include "geometry/shapes/tube/tube_lines.h"

namespace lekalo::geometry {

namespace {

constexpr int kPlaces = 256;         // where a line is asked whether it is bare, and four in each cell of the curve
constexpr double kInside = 1e-9;     // of the curve: beside a flat end, whose circle rounding puts on either side of it
constexpr double kSameSlope = 1e-9;  // of the radius, on both sides of a corner
constexpr double kNoArc = 1e-9;      // of the radius: smaller arcs are points

Vec3 across(const Vec3& v, const Vec3& unit) { return v - glm::dot(v, unit) * unit; }

}  // namespace

// Of each part that is a wall: its v where that of the tube is zero.
std::vector<double> TubeBoundary::zero_angles() const {
  const BallSweep& sweep = tube_.sweep();
  const auto direction = [&](double t) { return glm::normalize(sweep.ball(t).center[1]); };
  std::vector<double> angles;
  const CanalSurface* before = nullptr;
  double angle_before = 0;
  for (const Part& part : parts_) {
    angles.push_back(0);
    if (!part.wall) continue;
    const Interval range = part.wall->domain().u;
    const Vec3 axis = direction(range.lo);
    const auto arm = [&](const CanalSurface& wall, double u, double v) {
      return wall.point(u, v) - sweep.ball(u).center[0];
    };
    const Vec3 x = glm::normalize(across(arm(*part.wall, range.lo, 0), axis)), y = glm::cross(axis, x);
    Vec3 zero;
    if (before && before->domain().u.hi == range.lo) {
      // Mirrored between both directions, which for what stands across the one is to turn with them.
      const double end = next_down(range.lo);
      const Vec3 sum = direction(end) + axis, arrived = across(arm(*before, end, angle_before), direction(end));
      zero = arrived - 2 * glm::dot(arrived, sum) / glm::dot(sum, sum) * sum;
    } else {
      const auto& cells = sweep.cells();
      const auto cell = std::find_if(cells.begin(), cells.end(), [&](const auto& one) { return one.t.lo == range.lo; });
      const Vec3 p = part.wall->point(range.lo, 0);
      const double v = tube_.point({0, range.lo, 0, 0, static_cast<int>(cell - cells.begin())}, p).v;
      zero = std::cos(v) * x - std::sin(v) * y;
    }
    angles.back() = std::atan2(glm::dot(zero, y), glm::dot(zero, x));
    before = part.wall.get(), angle_before = angles.back();
  }
  return angles;
}

TubeLine TubeBoundary::line_on_wall(const Part& part, IsoDirection held, double at) const {
  const Interval domain = tube_.sweep().curve().domain();
  const bool has_flat_ends = tube_.caps() != Caps::round;
  const auto place = [=](double t) { return held == IsoDirection::u ? Vec2(at, t) : Vec2(t, at); };
  TubeLine line;
  line.curve = contour_approximation(whole_line(part.surface, held, at).curve());
  line.places = std::max(kPlaces, 4 * static_cast<int>(tube_.sweep().cells().size()));
  line.outward = {[=, this, &part](double t) { return outward(part, place(t)); }};
  // The circle between a wall and a corner's ball touches the wall beyond it: which half of it is bare is told by
  // directions.
  std::vector<std::pair<const Part*, double>> corners;
  for (const Part& ball : parts_) {
    if (held == IsoDirection::v || !ball.before || !ball.after) continue;
    const Interval range = part.wall->domain().u;
    if (at == range.hi && *ball.before == next_down(at)) corners.emplace_back(&ball, *ball.after);
    if (at == range.lo && *ball.after == at) corners.emplace_back(&ball, *ball.before);
  }
  line.is_exposed = [=, this, &part](double t, double beside) {
    for (const auto& [ball, other] : corners) {
      const BallJet on_other = tube_.sweep().ball(other);
      const Vec3 n = outward(part, place(t));
      if ((other == *ball->after ? 1 : -1) * (glm::dot(n, on_other.center[1]) + on_other.radius[1]) > 0) return false;
    }
    Vec2 asked = place(t);
    if (has_flat_ends)
      asked.x = std::clamp(asked.x, domain.lo + kInside * domain.width(), domain.hi - kInside * domain.width());
    return is_exposed(part, asked, beside);
  };
  return line;
}

// None where the radius does not change alike on both sides, so that the walls have no directions in common.
std::optional<TubeLine> TubeBoundary::line_over_corner(const Part& ball, const Part& before, double v) const {
  const BallJet in = tube_.sweep().ball(*ball.before), out = tube_.sweep().ball(*ball.after);
  const Vec3 e = glm::normalize(in.center[1]), f = glm::normalize(out.center[1]);
  const double slope = in.radius[1] / glm::length(in.center[1]), next = out.radius[1] / glm::length(out.center[1]);
  const double sine = glm::length(glm::cross(e, f)), R = in.radius[0];
  if (!(std::abs(slope - next) <= kSameSlope) || !(sine > 0)) return std::nullopt;
  const Vec3 center = in.center[0], axis = glm::cross(e, f) / sine;
  const Vec3 arm = before.wall->point(before.wall->domain().u.hi, v) - center, from_axis = across(arm, axis);
  const double radius = glm::length(from_axis);
  if (!(radius > kNoArc * R)) return std::nullopt;
  const Vec3 x = from_axis / radius;
  TubeLine line;
  line.curve = std::make_shared<Circle>(Frame{center + arm - from_axis, x, glm::cross(axis, x), axis}, radius,
                                        Interval{0, std::atan2(sine, glm::dot(e, f))});
  const auto normal = [curve = line.curve, center, R](double t) { return (curve->point(t) - center) / R; };
  line.places = kPlaces;
  line.outward = {normal};
  line.is_exposed = [=, this, curve = line.curve, &ball](double t, double beside) {
    const Vec3 p = curve->point(t);
    return !tube_.is_cut_off(p, *ball.before) && !tube_.holds(p + beside * size_ * normal(t));
  };
  return line;
}

ShapeOutlines TubeBoundary::parameter_lines(const ParameterNet& net, const ViewOf& view) const {
  ShapeOutlines found;
  found.complete = complete();
  const Curve& curve = tube_.sweep().curve();
  constexpr Interval kTurn{0, kTwoPi};
  ParameterValues asked = net.v;
  for (double& angle : asked.values) angle = kTurn.clamp(wrapped(angle, kTurn));
  const std::vector<double> places = values_in(net.u, curve.domain(), net.u.count > 1 && curve.is_closed()),
                            angles = values_in(asked, kTurn, asked.count > 1), zeros = zero_angles();
  for (size_t k = 0; k < parts_.size(); ++k) {
    const Part& part = parts_[k];
    if (!part.wall) continue;
    for (const double at : places)
      if (part.wall->domain().u.contains(at)) add_bare(line_on_wall(part, IsoDirection::u, at), view, found);
    const auto corner = std::find_if(parts_.begin(), parts_.end(), [&](const Part& one) {
      return one.before && one.after && *one.before == next_down(part.wall->domain().u.hi);
    });
    for (const double angle : angles) {
      const double v = kTurn.clamp(wrapped(angle + zeros[k], kTurn));
      add_bare(line_on_wall(part, IsoDirection::v, v), view, found);
      if (corner == parts_.end()) continue;
      if (const auto over = line_over_corner(*corner, part, v)) add_bare(*over, view, found);
    }
  }
  return found;
}

}  // namespace lekalo::geometry
