#include "geometry/queries/implicit_curves/implicit_equations.h"

namespace lekalo::geometry {

namespace {

// Both hold what is looked for; where the formula has no value in all of the box they need not meet.
Interval both(const Interval& a, const Interval& b) {
  const Interval common = intersect(a, b);
  return common.empty() ? a : common;
}

Interval coordinate(const Box3& box, int axis) { return {box.lo[axis], box.hi[axis]}; }

}  // namespace

Triple<double> triple(const Vec3& v) { return {v.x, v.y, v.z}; }
Triple<Interval> triple(const Box3& box) { return {coordinate(box, 0), coordinate(box, 1), coordinate(box, 2)}; }

SecondOrder<double> second_order(const ImplicitFormula& formula, const Vec3& p) {
  return SecondOrder<double>::of(formula.with_second(p.x, p.y, p.z));
}

ImplicitRange range_of(const ImplicitFormula& formula, const Box3& box) {
  const Triple<Interval> x = triple(box);
  ImplicitRange range;
  range.over = SecondOrder<Interval>::of(formula.with_second(x.x, x.y, x.z));
  range.over.value = formula.enclose(box);  // squares are squares there
  range.middle = {Interval(x.x.middle()), Interval(x.y.middle()), Interval(x.z.middle())};
  range.off = x - range.middle;
  range.is_smooth = formula.smoothness() == Expression::Smoothness::smooth;
  if (!range.is_smooth) return range;
  const auto& m = range.middle;
  range.at_middle = formula.with_gradient(m.x, m.y, m.z);
  const Gradient<Interval>& at = range.at_middle;
  SecondOrder<Interval>& over = range.over;
  const Triple<Interval>& u = range.off;
  const Triple<Interval> turn = over.second(u), slope{at.c[1], at.c[2], at.c[3]};
  const Interval bend = over.xx * sqr(u.x) + over.yy * sqr(u.y) + over.zz * sqr(u.z) +
                        Interval(2) * (over.xy * u.x * u.y + over.xz * u.x * u.z + over.yz * u.y * u.z);
  over.value = both(over.value, at.c[0] + dot(slope, u) + Interval(0.5) * bend);
  over.gradient = {both(over.gradient.x, slope.x + turn.x), both(over.gradient.y, slope.y + turn.y),
                   both(over.gradient.z, slope.z + turn.z)};
  return range;
}

ImplicitCondition::Value<Interval> ImplicitCondition::enclose(const ImplicitRange& range, const Box3& box) const {
  Value<Interval> value = at(range.over, triple(box));
  if (!range.is_smooth) return value;
  SecondOrder<Interval> middle;
  middle.value = range.at_middle.c[0];
  middle.gradient = {range.at_middle.c[1], range.at_middle.c[2], range.at_middle.c[3]};
  value.value = both(value.value, at(middle, range.middle).value + dot(value.gradient, range.off));
  return value;
}

}  // namespace lekalo::geometry
