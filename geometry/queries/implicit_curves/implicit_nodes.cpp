#include "geometry/queries/implicit_curves/implicit_nodes.h"

#include "geometry/queries/implicit_curves/implicit_equations.h"

namespace lekalo::geometry {

namespace {

// Of the region's diameter: half sides of cubes that are tried.
constexpr double kReaches[] = {0.05, 0.02, 0.007, 2e-3, 5e-4, 1e-4};
constexpr int kMaxBoxes = 4096, kMaxBoxesOfCone = 400;

// F = level and grad F = 0 for x, y, z.
struct SingularPoint {
  const ImplicitFormula& formula;

  SystemValue<Interval, 3, 4> enclose(const ParameterBox<3>& x) const {
    return value_of(range_of(formula, {{x[0].lo, x[1].lo, x[2].lo}, {x[0].hi, x[1].hi, x[2].hi}}).over);
  }
  SystemValue<double, 3, 4> evaluate(const ParameterPoint<3>& x) const {
    return value_of(second_order(formula, {x[0], x[1], x[2]}));
  }
  template <class S>
  static SystemValue<S, 3, 4> value_of(const SecondOrder<S>& f) {
    const Triple<S>& g = f.gradient;
    return {{f.value, g.x, g.y, g.z}, {{{g.x, g.y, g.z}, {f.xx, f.xy, f.xz}, {f.xy, f.yy, f.yz}, {f.xz, f.yz, f.zz}}}};
  }
};

// The silhouette in a cube about a node, on the two faces across an axis, by two coordinates of w.
struct SilhouetteOfCone {
  const ImplicitRange& range;
  Triple<Interval> sight;  // over the cube
  const SecondOrder<double>& at_node;
  Triple<double> sight_at_node;
  bool central;
  int axis;

  SystemValue<Interval, 2, 2> enclose(const ParameterBox<2>& x) const {
    return value_of(range.over, sight, x[0], x[1], central);
  }
  SystemValue<double, 2, 2> evaluate(const ParameterPoint<2>& x) const {
    return value_of(at_node, sight_at_node, x[0], x[1], false);
  }
  template <class S>
  SystemValue<S, 2, 2> value_of(const SecondOrder<S>& f, const Triple<S>& s, const S& a, const S& b, bool turns) const {
    const auto by_axis = [&](const S& first, const S& second, const S& third) {
      return axis == 0   ? Triple<S>{first, second, third}
             : axis == 1 ? Triple<S>{third, first, second}
                         : Triple<S>{second, third, first};
    };
    const Triple<S> w = by_axis(S(1), a, b), e_a = by_axis(S(0), S(1), S(0)), e_b = by_axis(S(0), S(0), S(1));
    const Triple<S> slope = f.second(w), across = f.second(s);
    SystemValue<S, 2, 2> result{{S(0.5) * dot(w, slope), dot(w, across)},
                                {{{dot(e_a, slope), dot(e_b, slope)}, {dot(e_a, across), dot(e_b, across)}}}};
    // The sight from an eye turns along with the place.
    if (turns) result.derivative[1][0] += dot(e_a, f.gradient), result.derivative[1][1] += dot(e_b, f.gradient);
    return result;
  }
};

bool is_known(const ImplicitFormula& formula, const ViewOf& view, const Vec3& node, double reach) {
  const Box3 cube = Box3{node, node}.inflated(reach);
  const ImplicitRange range = range_of(formula, cube);
  const SecondOrder<double> at_node = second_order(formula, node);
  const Vec3& v = view.direction_or_eye;
  const Triple<Interval> sight = view.central ? triple(cube) - triple(v) : triple(Box3{v, v});
  const Triple<double> sight_at_node = triple(view.central ? node - v : v);
  for (int axis = 0; axis < 3; ++axis) {
    RootSearchOptions<2, 2> options;
    options.least = {1e-3, 1e-3};
    options.slack = {1e-9, 1e-9};
    options.max_boxes = kMaxBoxesOfCone;
    const SilhouetteOfCone cone{range, sight, at_node, sight_at_node, view.central, axis};
    const auto found = search_roots<2, 2>(cone, {Interval(-1, 1), Interval(-1, 1)}, options);
    if (!found.complete || !found.open.empty()) return false;
  }
  return true;
}

}  // namespace

std::vector<ImplicitNode> implicit_nodes(const ImplicitFormula& formula, double size, const ViewOf& view,
                                         const Box3& box) {
  if (formula.smoothness() != Expression::Smoothness::smooth) return {};
  RootSearchOptions<3, 4> options;
  options.max_boxes = kMaxBoxes;
  options.least.fill(1e-6 * size);
  options.slack.fill(1e-9 * size);
  // What rounding makes of the values; the gradient's in all directions alike.
  const Vec3 p = box.center() + 0.3 * box.size();
  const SecondOrder<Interval> rounding =
      SecondOrder<Interval>::of(formula.with_second(Interval(p.x), Interval(p.y), Interval(p.z)));
  options.tolerance[0] = 4 * rounding.value.width();
  const Triple<Interval>& g = rounding.gradient;
  for (int k = 1; k < 4; ++k) options.tolerance[k] = 4 * std::max({g.x.width(), g.y.width(), g.z.width()});
  const ParameterBox<3> domain{{{box.lo.x, box.hi.x}, {box.lo.y, box.hi.y}, {box.lo.z, box.hi.z}}};
  const auto found = search_roots<3, 4>(SingularPoint{formula}, domain, options);
  if (!found.complete) return {};
  std::vector<ImplicitNode> nodes;
  for (const ParameterPoint<3>& x : found.isolated) {
    const Vec3 point(x[0], x[1], x[2]);
    for (const double reach : kReaches)
      if (is_known(formula, view, point, reach * size)) {
        nodes.push_back({point, reach * size});
        break;
      }
  }
  return nodes;
}

}  // namespace lekalo::geometry
