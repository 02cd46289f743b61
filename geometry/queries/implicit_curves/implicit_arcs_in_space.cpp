#include "geometry/queries/implicit_curves/implicit_arc_collector.h"

namespace lekalo::geometry {

using namespace implicit_arc;

namespace {

// Unknowns x, y, z.
struct InSpace {
  static constexpr int kUnknowns = 3;
  static constexpr bool kThreadSafe = true;
  const ImplicitFormula& formula;
  const std::vector<ImplicitSide>& sides;
  const ImplicitRegion& region;
  const ImplicitCondition& condition;
  const Box3& searched;
  std::span<const ImplicitNode> nodes;
  std::array<double, 2> errors = errors_of_values();

  // Most boxes hold nothing of the surface, which the formula alone tells.
  bool holds_none(const ParameterBox<3>& x) const {
    const Interval value = formula.enclose(box_of(x));
    return value.lo > errors[0] || value.hi < -errors[0];
  }
  SystemValue<Interval, 3, 2> enclose(const ParameterBox<3>& x) const {
    const Box3 box = box_of(x);
    // What lies next to a node is known: nothing is searched in its cube, and in one of half the size curves end.
    const bool is_at_node = in_cube(box, 1);
    if (is_at_node && in_cube(box, 0.5)) return {{Interval(kNowhere), Interval(0)}, {}};
    const ImplicitRange range = range_of(formula, box);
    const auto second = condition.enclose(range, box);
    const auto& g = range.over.gradient;
    // Beyond a ball or a side nothing is wanted; curves that lead there are followed all the same.
    const bool is_outside = is_at_node || (region.is_ball && region.misses(box)) || !may_hold(sides, box);
    return {{is_outside ? Interval(kNowhere) : range.over.value, second.value},
            {{{g.x, g.y, g.z}, {second.gradient.x, second.gradient.y, second.gradient.z}}}};
  }
  SystemValue<double, 3, 2> evaluate(const ParameterPoint<3>& x) const {
    const Vec3 p = point(x);
    const SecondOrder<double> f = second_order(formula, p);
    const auto second = condition.at(f, triple(p));
    return {{f.value, second.value},
            {{{f.gradient.x, f.gradient.y, f.gradient.z}, {second.gradient.x, second.gradient.y, second.gradient.z}}}};
  }
  SystemValue<double, 3, 2> evaluate_middle(const ParameterBox<3>& box) const { return evaluate(middle<3>(box)); }
  std::array<double, 3> extents(const ParameterBox<3>& box) const { return widths<3>(box); }
  Vec3 motion(const ParameterPoint<3>&, const ParameterPoint<3>& by) const { return {by[0], by[1], by[2]}; }
  Vec3 point(const ParameterPoint<3>& x) const { return {x[0], x[1], x[2]}; }
  std::array<double, 2> rounding() const { return errors; }

 private:
  static Box3 box_of(const ParameterBox<3>& x) { return {{x[0].lo, x[1].lo, x[2].lo}, {x[0].hi, x[1].hi, x[2].hi}}; }
  std::array<double, 2> errors_of_values() const {
    return {rounding_in(searched, [&](const Vec3& p) { return thin(formula, p).value.width(); }),
            rounding_in(searched, [&](const Vec3& p) {
              return condition.at(thin(formula, p), triple(Box3{p, p})).value.width();
            })};
  }
  bool in_cube(const Box3& box, double share) const {
    for (const ImplicitNode& node : nodes) {
      const Box3 cube = Box3{node.point, node.point}.inflated(share * node.reach);
      if (cube.contains(box.lo) && cube.contains(box.hi)) return true;
    }
    return false;
  }
};

// The surface is seen edge-on all over: its formula does not depend on the place along any line of sight.
bool vanishes(const ImplicitFormula& formula, const ImplicitCondition& sight, const Box3& box) {
  const Interval slope = sight.enclose(range_of(formula, box), box).value;
  return slope.lo == 0 && slope.hi == 0;
}

}  // namespace

ImplicitArcs implicit_arcs(const ImplicitBranch& branch, const ImplicitRegion& region,
                           const ImplicitCondition& condition, const Box3& box, size_t but_side) {
  ImplicitBranch asked = branch;
  if (but_side < asked.sides.size()) asked.sides.erase(asked.sides.begin() + static_cast<std::ptrdiff_t>(but_side));
  const ImplicitFormula& formula = *asked.formula;
  std::vector<ImplicitNode> nodes;
  if (const auto view = condition.view()) {
    if (vanishes(formula, condition, box)) return {};
    nodes = implicit_nodes(formula, region.box.diameter(), *view, box);
  }
  const ParameterBox<3> domain{{{box.lo.x, box.hi.x}, {box.lo.y, box.hi.y}, {box.lo.z, box.hi.z}}};
  ImplicitArcs all;
  const auto search = [&](const ImplicitBranch& one, const ImplicitCondition& with) {
    const InSpace system{formula, one.sides, region, with, box, nodes};
    ImplicitArcs found = Collector(one, region, with, nodes).find(system, domain);
    all.arcs.insert(all.arcs.end(), found.arcs.begin(), found.arcs.end());
    all.complete = all.complete && found.complete;
  };
  if (!condition.formula()) {
    search(asked, condition);
    return all;
  }
  for (const ImplicitBranch& other : implicit_branches(*condition.formula(), box, condition.to_formula())) {
    ImplicitBranch both = asked;
    both.sides.insert(both.sides.end(), other.sides.begin(), other.sides.end());
    if (other.formula->smoothness() != Expression::Smoothness::smooth) all.complete = false;
    search(both, ImplicitCondition::other(*other.formula, condition.to_formula()));
  }
  return all;
}

ImplicitArcs implicit_arcs(const ImplicitFormula& formula, const ImplicitRegion& region,
                           const ImplicitCondition& condition, const Box3& box) {
  ImplicitArcs all;
  for (const ImplicitBranch& branch : implicit_branches(formula, box)) {
    const ImplicitArcs found = implicit_arcs(branch, region, condition, box, branch.sides.size());
    all.arcs.insert(all.arcs.end(), found.arcs.begin(), found.arcs.end());
    all.complete = all.complete && found.complete;
  }
  return all;
}

}  // namespace lekalo::geometry
