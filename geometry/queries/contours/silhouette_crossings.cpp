#include "geometry/queries/contours/silhouette_crossings.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/curves/operations/curve_sign_changes.h"
#include "geometry/curves/operations/surface_curve.h"
#include "geometry/numerics/root_search.h"
#include "geometry/numerics/triple.h"
#include "geometry/queries/implicit_curves/implicit_equations.h"

namespace lekalo::geometry {

namespace {

// Of the domain: places nearer than this are one, and rounding at the ends of pieces.
constexpr double kSamePlace = 1e-9, kSlack = 1e-12;
// Sine of the angle between the line of sight and the tangent plane that is rounding.
constexpr double kAlong = 1e-11;

// The equation along t; `from` is the eye or the line of sight.
struct SightAlong {
  const Surface& surface;
  const Curve& image;
  bool central;
  Vec3 from;

  SystemValue<double, 1, 1> evaluate(const ParameterPoint<1>& t) const {
    const CurveJet x = image.evaluate(t[0], 1);
    const SurfaceJet s = surface.evaluate(x.d[0].x, x.d[0].y, 2);
    const double u1 = x.d[1].x, v1 = x.d[1].y;
    const Vec3 sight = central ? s.point() - from : from;
    const Vec3 turn = central ? s.du() * u1 + s.dv() * v1 : Vec3(0);
    const Vec3 du1 = s.duu() * u1 + s.duv() * v1, dv1 = s.duv() * u1 + s.dvv() * v1;
    const auto det = [](const Vec3& a, const Vec3& b, const Vec3& c) { return glm::dot(a, glm::cross(b, c)); };
    return {{det(sight, s.du(), s.dv())},
            {{{det(turn, s.du(), s.dv()) + det(sight, du1, s.dv()) + det(sight, s.du(), dv1)}}}};
  }
  // The line of sight is in the tangent plane, to rounding.
  bool vanishes(double t) const {
    const CurveJet x = image.evaluate(t, 0);
    const SurfaceJet s = surface.evaluate(x.d[0].x, x.d[0].y, 1);
    const Vec3 sight = central ? s.point() - from : from, normal = glm::cross(s.du(), s.dv());
    return std::abs(glm::dot(sight, normal)) <= kAlong * glm::length(sight) * glm::length(s.du()) * glm::length(s.dv());
  }
  // The image's enclosure and that of the surface there.
  struct Enclosed {
    CurveEnclosure x;
    SurfaceEnclosure s;
    Triple<Interval> sight, du, dv;
  };
  Enclosed enclosed(const Interval& t, int order) const {
    Enclosed e{image.enclose(t, order - 1), {}, {}, {}, {}};
    e.s = enclose_unwrapped(surface, {range(e.x.d[0], 0), range(e.x.d[0], 1)}, order);
    const Triple<Interval> origin{Interval(from.x), Interval(from.y), Interval(from.z)};
    e.sight = central ? vec(e.s.d(0, 0)) - origin : origin;
    e.du = vec(e.s.d(1, 0)), e.dv = vec(e.s.d(0, 1));
    return e;
  }
  SystemValue<Interval, 1, 1> enclose(const ParameterBox<1>& t) const {
    const auto& [x, s, sight, du, dv] = enclosed(t[0], 2);
    const Interval u1 = range(x.d[1], 0), v1 = range(x.d[1], 1);
    const Triple<Interval> du1 = u1 * vec(s.d(2, 0)) + v1 * vec(s.d(1, 1)),
                           dv1 = u1 * vec(s.d(1, 1)) + v1 * vec(s.d(0, 2));
    Interval slope = dot(sight, cross(du1, dv)) + dot(sight, cross(du, dv1));
    if (central) slope += dot(u1 * du + v1 * dv, cross(du, dv));
    return {{dot(sight, cross(du, dv))}, {{{slope}}}};
  }
  std::array<Interval, 1> values(const ParameterBox<1>& t) const {
    const Enclosed e = enclosed(t[0], 1);
    return {dot(e.sight, cross(e.du, e.dv))};
  }
  static Interval range(const Box3& box, int axis) { return {box.lo[axis], box.hi[axis]}; }
  static Triple<Interval> vec(const Box3& b) { return {range(b, 0), range(b, 1), range(b, 2)}; }
};

constexpr std::array kShares{0.52, 0.013, 0.97, 0.29, 0.78, 0.11, 0.63, 0.41, 0.87};

// A section of a cylinder through its axis, seen along the plane's normal, say: it goes round nowhere, and a search
// would halve all of it down to the smallest boxes.
bool lies_along_silhouette(const SightAlong& system, const Interval& t) {
  return std::all_of(kShares.begin(), kShares.end(),
                     [&](double share) { return system.vanishes(t.lo + share * t.width()); });
}

// Along a line in which the surface has a crease bounds hold for both of its sides, and a search would do the same.
bool is_clear_somewhere(const SightAlong& system, const Interval& t) {
  return std::any_of(kShares.begin(), kShares.end(),
                     [&](double share) { return !system.values({Interval(t.lo + share * t.width())})[0].contains(0); });
}

void add_sign_changes(const SightAlong& system, const Interval& t, std::vector<double>& turns) {
  constexpr int kPlaces = 64;
  const auto value = [&](double x) { return system.evaluate({x}).value[0]; };
  double lo = t.lo, at_lo = value(lo);
  for (int k = 1; k <= kPlaces; ++k) {
    const double hi = k == kPlaces ? t.hi : t.lo + t.width() * k / kPlaces, at_hi = value(hi);
    if ((at_lo < 0) != (at_hi < 0)) {
      double a = lo, b = hi;
      for (double middle = 0.5 * (a + b); a < middle && middle < b; middle = 0.5 * (a + b))
        ((value(middle) < 0) == (at_lo < 0) ? a : b) = middle;
      turns.push_back(a);
    }
    lo = hi, at_lo = at_hi;
  }
}

}  // namespace

void add_silhouette_crossings(const Curve& line, const Surface& surface, const Curve& image, const ViewOf& view,
                              std::vector<double>& turns) {
  const double width = line.domain().width();
  const SightAlong system{surface, image, view.central, view.direction_or_eye};
  RootSearchOptions<1, 1> options;
  options.slack = {kSlack * width};
  options.least = {kSamePlace * width};
  options.max_boxes = 2000;
  const auto search = [&](const Interval& t) {
    if (lies_along_silhouette(system, t)) return;
    if (!is_clear_somewhere(system, t)) return add_sign_changes(system, t, turns);
    const auto found = search_roots<1, 1>(system, ParameterBox<1>{t}, options);
    for (const auto& root : found.isolated) turns.push_back(root[0]);
    for (const auto& open : found.open) add_sign_changes(system, open[0], turns);
  };
  // Over a whole piece bounds hardly ever tell.
  for (const CurvePiece& piece : line.pieces()) {
    const double middle = piece.domain.middle();
    search({piece.domain.lo, middle});
    search({middle, piece.domain.hi});
  }
}

std::vector<double> silhouette_crossings(const Curve& curve, bool closed, const ImplicitFormula& formula,
                                         const ViewOf& view) {
  const ImplicitCondition sight = ImplicitCondition::sight(view);
  return sign_changes(
      curve, closed, [&](const Box3& box) { return sight.enclose(range_of(formula, box), box).value; },
      [&](const Vec3& p) { return sight.at(second_order(formula, p), triple(p)).value; });
}

}  // namespace lekalo::geometry
