#include "geometry/numerics/jet2.h"
#include "geometry/queries/implicit_curves/implicit_arc_collector.h"

namespace lekalo::geometry {

using namespace implicit_arc;

namespace {

// Unknowns x and y of a plane.
struct OnPlane {
  static constexpr int kUnknowns = 2;
  const ImplicitFormula& formula;
  const std::vector<ImplicitSide>& sides;
  const ImplicitRegion& region;
  const Frame& plane;

  template <class T>
  T coordinate(int axis, const T& x, const T& y) const {
    return x * plane.x[axis] + y * plane.y[axis] + plane.origin[axis];
  }
  template <class T>
  T value(const T& x, const T& y) const {
    return formula(coordinate(0, x, y), coordinate(1, x, y), coordinate(2, x, y));
  }
  SystemValue<Interval, 2, 1> enclose(const ParameterBox<2>& x) const {
    Box3 box;
    for (int k = 0; k < 3; ++k) {
      const Interval along = coordinate(k, x[0], x[1]);
      box.lo[k] = along.lo, box.hi[k] = along.hi;
    }
    SystemValue<Interval, 2, 1> result;
    using J = Jet2<Interval, 2>;
    const J over = value(J::u_variable(x[0]), J::v_variable(x[1]));
    // Beyond the region and the sides nothing is wanted; curves that lead there are followed all the same.
    const bool is_outside = region.misses(box) || !may_hold(sides, box);
    result = {{is_outside ? Interval(kNowhere) : over.c[0]}, {{{over.c[1], over.c[2]}}}};
    if (is_outside || formula.smoothness() != Expression::Smoothness::smooth) return result;
    // As in range_of().
    using Slope = Jet2<Interval, 1>;
    const Interval m[] = {x[0].middle(), x[1].middle()}, u = x[0] - m[0], v = x[1] - m[1];
    const Slope at = value(Slope::u_variable(m[0]), Slope::v_variable(m[1]));
    const auto tighten = [](Interval& wide, const Interval& other) {
      const Interval common = intersect(wide, other);
      if (!common.empty()) wide = common;
    };
    tighten(result.derivative[0][0], at.c[1] + Interval(2) * over.c[3] * u + over.c[4] * v);
    tighten(result.derivative[0][1], at.c[2] + over.c[4] * u + Interval(2) * over.c[5] * v);
    tighten(result.value[0],
            at.c[0] + at.c[1] * u + at.c[2] * v + over.c[3] * sqr(u) + over.c[4] * u * v + over.c[5] * sqr(v));
    return result;
  }
  SystemValue<double, 2, 1> evaluate(const ParameterPoint<2>& x) const {
    using J = Jet2<double, 1>;
    const J at = value(J::u_variable(x[0]), J::v_variable(x[1]));
    return {{at.c[0]}, {{{at.c[1], at.c[2]}}}};
  }
  SystemValue<double, 2, 1> evaluate_middle(const ParameterBox<2>& box) const { return evaluate(middle<2>(box)); }
  std::array<double, 2> extents(const ParameterBox<2>& box) const { return widths<2>(box); }
  Vec3 motion(const ParameterPoint<2>&, const ParameterPoint<2>& by) const {
    const auto [x, y] = by;
    return x * plane.x + y * plane.y;
  }
  Vec3 point(const ParameterPoint<2>& x) const { return plane.point({x[0], x[1], 0}); }
  std::array<double, 1> rounding() const {
    return {rounding_in(region.box, [&](const Vec3& p) { return thin(formula, p).value.width(); })};
  }
};

}  // namespace

ImplicitArcs implicit_arcs(const ImplicitFormula& formula, const ImplicitRegion& region, const Frame& plane,
                           const Interval& x, const Interval& y) {
  const ImplicitCondition condition = ImplicitCondition::plane(plane.origin, plane.z);
  ImplicitArcs all;
  for (const ImplicitBranch& branch : implicit_branches(formula, region.box)) {
    const OnPlane system{*branch.formula, branch.sides, region, plane};
    const ImplicitArcs found = Collector(branch, region, condition, {}).find(system, {x, y});
    all.arcs.insert(all.arcs.end(), found.arcs.begin(), found.arcs.end());
    all.complete = all.complete && found.complete;
  }
  return all;
}

}  // namespace lekalo::geometry
