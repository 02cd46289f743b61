// Projections of curves on surfaces (Golovanov 2016, 4.6; capability 4.6d): the solution at the beginning is chosen
// among all, then followed.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/curves/on_surfaces/projected_image.h"
#include "geometry/curves/operations/surface_curve.h"
#include "geometry/describe.h"
#include "geometry/numerics/chebyshev.h"
#include "geometry/queries/closest/closest_point.h"
#include "geometry/queries/rays/line_intersections.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

using Part = PolynomialCurve::Part;
constexpr int kNodes = static_cast<int>(PolynomialCurve::kTerms);

// The polynomials are this near to the solution, of the size: Newton's iteration needs one step.
constexpr double kModelError = 1e-11;
// Parts that are not divided, of the domain.
constexpr double kNarrowest = 1e-9;

class Tracing {
 public:
  Tracing(const ProjectionEquations& equations, const Interval& range)
      : equations_(equations), range_(range), domain_(equations.surface().domain()) {
    const Periods periods = closed_periods(equations.surface());
    period_[0] = periods.u;
    period_[1] = periods.v;
    for (const SurfacePiece& piece : equations.surface().pieces()) {
      lines_[0].push_back(piece.domain.u.lo);
      lines_[1].push_back(piece.domain.v.lo);
    }
    for (auto& lines : lines_) {
      std::sort(lines.begin(), lines.end());
      lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
    }
  }

  std::vector<Part> run(const Vec2& start) {
    place_ = start;
    for (const CurvePiece& piece : equations_.curve().pieces()) {
      const Interval t = intersect(piece.domain, range_);
      if (!t.empty() && t.width() > 0) trace(t);
    }
    return std::move(parts_);
  }

 private:
  const Surface& surface() const { return equations_.surface(); }
  const Interval& side(int axis) const { return axis == 0 ? domain_.u : domain_.v; }

  void trace(const Interval& t) {
    if (t.width() <= kNarrowest * range_.width()) refuse_jump(t.lo);
    const Vec2 before = place_;
    Part part;
    double at = 0;
    switch (add_part(t, part, at)) {
      case Outcome::good:
        parts_.push_back(part);
        return;
      case Outcome::divide:
        place_ = before;
        at = t.middle();
        break;
      case Outcome::crosses:
        place_ = before;
        break;
    }
    trace({t.lo, at});
    trace({at, t.hi});
  }

  [[noreturn]] void refuse_jump(double t) const {
    const char* why = equations_.is_along_normals() ? "the curve meets a centre of curvature of the surface, or a pole"
                                                    : "the direction touches the surface";
    throw FieldError("of", fmt::format("the projection jumps at t = {:.6g}: there {}", t, why),
                     "project a shorter part of the curve: range");
  }

  enum class Outcome { good, divide, crosses };

  // The polynomial through the solutions in Chebyshev's points; moves place_ to the end. Where the solution passes over
  // a line of the surface on which derivatives may jump, `at` is there.
  Outcome add_part(const Interval& t, Part& part, double& at) {
    std::array<Vec3, kNodes> values;
    double previous = t.lo;
    const auto go_on = [&](double to) {
      const auto next = advance(previous, to);
      if (next) place_ = *next, previous = to;
      return next.has_value();
    };
    const Vec2 first = place_;
    for (int j = kNodes - 1; j >= 0; --j) {
      if (!go_on(t.middle() + 0.5 * t.width() * chebyshev_point(j, kNodes))) return Outcome::divide;
      values[j] = Vec3(place_, 0);
    }
    if (!go_on(t.hi)) return Outcome::divide;
    part = {t, 2 / t.width(), powers_of_chebyshev(chebyshev_coefficients(values))};
    check_inside(t, part);
    if (const auto crossing = first_crossing(t, first, part)) {
      at = *crossing;
      return Outcome::crosses;
    }
    for (const double x : {-0.999, -0.55, -0.15, 0.35, 0.8, 0.999}) {
      const Vec2 model(part.value(x));
      const auto there = equations_.solve(t.middle() + 0.5 * t.width() * x, model);
      if (!there || !(distance(model, *there) <= kModelError * equations_.size())) return Outcome::divide;
    }
    return Outcome::good;
  }

  // In space, where both are near.
  double distance(const Vec2& a, const Vec2& b) const {
    const SurfaceJet s = surface().evaluate(b.x, b.y, 1);
    return glm::length((a.x - b.x) * s.du() + (a.y - b.y) * s.dv());
  }

  // From place_ at t0 to the solution at t1, if it is where the derivatives say.
  std::optional<Vec2> advance(double t0, double t1) const {
    constexpr double kNearby = 0.2;  // of the way
    const auto slope = equations_.series(t0, place_, 1);
    const Vec2 by = (t1 - t0) * Vec2(slope[0].c[1], slope[1].c[1]);
    if (!std::isfinite(by.x) || !std::isfinite(by.y)) return std::nullopt;
    const auto next = equations_.solve(t1, place_ + by);
    if (!next) return std::nullopt;
    const double room = std::max(kNearby * distance(place_ + by, place_), 1e-9 * equations_.size());
    if (!(distance(place_ + by, *next) <= room)) return std::nullopt;
    if (equations_.is_along_normals() && !equations_.is_nearest(t1, *next)) return std::nullopt;
    return next;
  }

  // Places in a step: its nodes and its end, in order.
  static double node(int i) { return i < kNodes ? chebyshev_point(kNodes - 1 - i, kNodes) : 1.0; }

  // The first t at which a condition holds that does not at t.lo; the parts of a part between which it begins to.
  template <class Condition>
  std::optional<double> first_time(const Interval& t, const Part& part, const Condition& condition) const {
    double lo = -1;
    for (int i = 0; i <= kNodes; ++i) {
      double hi = node(i);
      if (!condition(solution(t, part, hi))) {
        lo = hi;
        continue;
      }
      for (int time = 0; time < 60; ++time) {
        const double middle = 0.5 * (lo + hi);
        (condition(solution(t, part, middle)) ? hi : lo) = middle;
      }
      return t.middle() + 0.5 * t.width() * hi;
    }
    return std::nullopt;
  }
  Vec2 solution(const Interval& t, const Part& part, double x) const {
    const Vec2 model(part.value(x));
    return equations_.solve(t.middle() + 0.5 * t.width() * x, model).value_or(model);
  }

  void check_inside(const Interval& t, const Part& part) const {
    for (int axis = 0; axis < 2; ++axis) {
      const Interval& range = side(axis);
      if (period_[axis] > 0 || !(range.width() < kInfinity)) continue;
      const double room = 1e-9 * range.width();
      const auto out =
          first_time(t, part, [&](const Vec2& x) { return x[axis] < range.lo - room || x[axis] > range.hi + room; });
      if (!out) continue;
      const DegenerateEdges edges = surface().degenerate_edges();
      const bool above = solution(t, part, part.local(*out))[axis] > range.middle();
      if (axis == 0 ? (above ? edges.u_max : edges.u_min) : (above ? edges.v_max : edges.v_min))
        throw FieldError("of", fmt::format("the projection meets a pole of the surface at t = {:.6g}", *out),
                         "project a part of the curve (range), or a curve beside it");
      throw FieldError("of", fmt::format("the projection leaves the surface at t = {:.6g}", *out),
                       "project a shorter part of the curve (range), or widen the surface");
    }
  }

  std::optional<double> first_crossing(const Interval& t, const Vec2& first, const Part& part) const {
    std::optional<double> result;
    for (int axis = 0; axis < 2; ++axis) {
      const Interval& range = side(axis);
      for (const double line : lines_[axis]) {
        const double period = period_[axis];
        if (period == 0 && line == range.lo) continue;
        // The image of the line next to the beginning, and those beside it.
        const double turns = period > 0 ? std::round((first[axis] - line) / period) : 0;
        for (int k = period > 0 ? -1 : 0; k <= (period > 0 ? 1 : 0); ++k) {
          const double at = line + (turns + k) * period;
          const double room = 1e-12 * range.width();
          if (std::abs(first[axis] - at) <= room) continue;
          const bool above = first[axis] > at;
          const auto time =
              first_time(t, part, [&](const Vec2& x) { return above ? x[axis] < at - room : x[axis] > at + room; });
          if (time && *time < t.hi - 1e-9 * range_.width() && *time > t.lo + 1e-9 * range_.width() &&
              (!result || *time < *result))
            result = time;
        }
      }
    }
    return result;
  }

  const ProjectionEquations& equations_;
  const Interval range_;
  const Rectangle domain_;
  double period_[2] = {0, 0};
  std::vector<double> lines_[2];  // on which pieces of the surface begin
  Vec2 place_{0};
  std::vector<Part> parts_;
};

// The nearest foot point of a point.
Vec2 nearest_foot(const Vec3& point, const Surface& surface, double t) {
  SurfaceFootPoints foot_points;
  try {
    foot_points = project(point, surface);
  } catch (const std::invalid_argument& error) {
    throw FieldError("onto", error.what());
  }
  if (!foot_points.regions.empty())
    throw FieldError("of", fmt::format("at t = {:.6g} many points of the surface are equally near", t),
                     "begin elsewhere: range");
  for (const SurfaceFootPoint& foot_point : foot_points.foot_points)
    if (foot_point.kind == FootPointKind::minimum) return {foot_point.u, foot_point.v};
  throw FieldError("of", fmt::format("no normal of the surface leads to the curve's beginning, t = {:.6g}", t),
                   "project a part of the curve (range), or widen the surface");
}

Vec2 chosen_hit(const Vec3& point, const Vec3& direction, const SurfacePtr& surface, int number, double t) {
  const std::vector<SurfaceHit> hits = LineIntersector(surface).all_hits({point, direction}, {0, kInfinity});
  if (number >= static_cast<int>(hits.size()))
    throw FieldError(
        hits.empty() ? "direction" : "hit",
        fmt::format("seen along the direction from the curve's beginning, t = {:.6g}, there {} of the surface", t,
                    hits.empty()       ? std::string("is nothing")
                    : hits.size() == 1 ? std::string("is one point")
                                       : fmt::format("are {} points", hits.size())),
        hits.empty() ? "turn the direction round, or project a part of the curve: range" : "the first is number 0");
  return {hits[number].u, hits[number].v};
}

}  // namespace

TypeDeclaration projected_curve_type() {
  return declare(
             Category::curve, "projected_curve",
             "Projection of a curve on a surface, with the curve's parameter: to the nearest point at its beginning, "
             "and to the foot of a normal that goes on from there; or along a direction.")
      .example("of: { type: segment, from: [1, 0, 2], to: [0, 1, 2] }, onto: { type: sphere_surface, radius: 1 }")
      .field("of", reference({Category::curve}), "the curve")
      .field("onto", reference({Category::surface}), "the surface")
      .optional("direction", direction(), "projects along it, not along normals")
      .field("hit", integer().at_least(0),
             "with a direction: which of the surface's points is taken, counted from the curve's beginning along the "
             "direction",
             "0")
      .optional("range", range(), "of the curve's parameter: the part that is projected")
      .built_by([](const Fields& f) {
        const CurvePtr curve = f.curve("of");
        const SurfacePtr surface = f.surface("onto");
        Interval range = curve->domain();
        if (f.has("range")) {
          if (!range.contains(f.range("range")))
            throw FieldError("range", fmt::format("the curve's domain is [{:.6g}, {:.6g}]", range.lo, range.hi));
          range = f.range("range");
        }
        if (!(range.width() < kInfinity)) throw FieldError("of", "the curve is unbounded", "give it a range");
        if (f.given("hit") && !f.has("direction"))
          throw FieldError("hit", "'hit' is of projections along a direction", "leave it out, or give 'direction'");
        std::optional<Vec3> direction;
        if (f.has("direction")) direction = f.vec3("direction");
        auto equations = std::make_shared<ProjectionEquations>(curve, surface, direction);
        const Vec3 begin = curve->point(range.lo);
        const Vec2 start = direction ? chosen_hit(begin, *direction, surface, f.integer("hit"), range.lo)
                                     : nearest_foot(begin, *surface, range.lo);
        std::vector<Part> parts = Tracing(*equations, range).run(start);
        return SurfaceCurve(surface, std::make_shared<ProjectedImage>(equations, PolynomialCurve(std::move(parts))));
      });
}

}  // namespace lekalo::geometry
