// Functions that blend curves, as splines with their values for the first coordinate.
#include <functional>
#include <span>

#include "geometry/curves/interpolation/hermite_curve.h"
#include "geometry/curves/interpolation/lagrange_curve.h"
#include "geometry/curves/interpolation/spline_curve.h"
#include "geometry/surfaces/nets/boolean_sum.h"

namespace lekalo::geometry {

namespace {

CurvePtr function_of(int degree, std::vector<double> knots, const std::vector<double>& values) {
  NurbsCurveForm form{degree, std::move(knots), {}, {}};
  for (const double x : values) form.points.emplace_back(x, 0, 0, 1);
  return std::make_shared<NurbsCurve>(form);
}

std::vector<double> bezier_knots(int degree, const Interval& range) {
  std::vector<double> knots(degree + 1, range.lo);
  knots.insert(knots.end(), degree + 1, range.hi);
  return knots;
}

CurvePtr shared(NurbsCurve curve) { return std::make_shared<NurbsCurve>(std::move(curve)); }

// A curve through points at nodes, whose first coordinates are values.
using Interpolant = std::function<NurbsCurve(std::span<const Vec3> values)>;

// One function for each node, 1 there and 0 at the others: interpolation is linear in the values. A closed rule's last
// node is the first again.
std::vector<CurvePtr> cardinal(size_t count, const Interpolant& interpolant) {
  std::vector<CurvePtr> functions;
  for (size_t i = 0; i < count; ++i) {
    std::vector<Vec3> values(count, Vec3(0));
    values[i].x = 1;
    functions.push_back(shared(interpolant(values)));
  }
  return functions;
}

// The derivatives of functions at nodes: of what they blend, that at node i is the sum of row i times the values.
std::vector<std::vector<double>> slopes_of(const std::vector<CurvePtr>& functions, const std::vector<double>& nodes) {
  std::vector<std::vector<double>> rows;
  for (const double t : nodes) {
    auto& row = rows.emplace_back();
    for (const CurvePtr& function : functions) row.push_back(function->evaluate(t, 1).d[1].x);
  }
  return rows;
}

// Functions that vanish at all nodes and whose derivative is 1 at one.
std::vector<CurvePtr> slope_functions(const std::vector<double>& nodes) {
  const std::vector<Vec3> zeros(nodes.size(), Vec3(0));
  return cardinal(nodes.size(), [&](std::span<const Vec3> slopes) {
    return hermite_curve({zeros, nodes, false}, slopes);
  });
}

}  // namespace

std::vector<CurvePtr> hermite_functions(const std::vector<double>& nodes, bool closed) {
  return cardinal(nodes.size() - (closed ? 1 : 0), [&](std::span<const Vec3> values) {
    const PointSequence data{values, nodes, closed};
    return hermite_curve(data, estimated_tangents("bessel", data));
  });
}

std::vector<CurvePtr> spline_functions(const std::vector<double>& nodes, bool closed) {
  const SplineEnd natural{EndRule::natural, {}, {}};
  return cardinal(nodes.size() - (closed ? 1 : 0), [&](std::span<const Vec3> values) {
    return closed ? closed_spline_curve(values, nodes, 3) : spline_curve(values, nodes, 3, natural, natural);
  });
}

std::vector<CurvePtr> lagrange_functions(const std::vector<double>& nodes) {
  return cardinal(nodes.size(), [&](std::span<const Vec3> values) { return lagrange_curve(values, nodes); });
}

std::vector<CurvePtr> step_functions(const std::vector<double>& nodes) {
  const std::vector<Vec3> zeros(nodes.size(), Vec3(0));
  return cardinal(nodes.size(), [&](std::span<const Vec3> values) {
    return hermite_curve({values, nodes, false}, zeros);
  });
}

// The sum's own mixed derivative at a node is that of both families less the rule's of the points: what is to be
// added is multiplied by functions whose derivative is 1 at one node. Their curves are zero.
void mean_twists(BooleanSum& sum, const std::vector<double>& at_u, const std::vector<double>& at_v) {
  const size_t m = at_u.size(), n = at_v.size();
  const auto rule_u = slopes_of(sum.along_v.functions, at_u), rule_v = slopes_of(sum.along_u.functions, at_v);
  const auto add = [](Family& family, const std::vector<double>& nodes, const Interval& over) {
    const CurvePtr zero = shared(
        NurbsCurve(NurbsCurveForm{1, {over.lo, over.lo, over.hi, over.hi}, {Vec4(0, 0, 0, 1), Vec4(0, 0, 0, 1)}, {}}));
    for (const CurvePtr& function : slope_functions(nodes)) {
      family.functions.push_back(function);
      family.curves.push_back(zero);
    }
  };
  const auto slope = [](const CurvePtr& curve, double t) { return curve->evaluate(t, 1).d[1]; };
  std::vector<std::vector<Vec3>> twists(m, std::vector<Vec3>(n, Vec3(0)));
  for (size_t j = 0; j < m; ++j)
    for (size_t i = 0; i < n; ++i) {
      Vec3 of_u(0), of_v(0), of_points(0);  // d/dv of s_u, d/du of s_v, the rule's of the points
      for (size_t k = 0; k < m; ++k) of_u += rule_u[j][k] * slope(sum.along_v.curves[k], at_v[i]);
      for (size_t k = 0; k < n; ++k) of_v += rule_v[i][k] * slope(sum.along_u.curves[k], at_u[j]);
      for (size_t k = 0; k < m; ++k)
        for (size_t l = 0; l < n; ++l) of_points += (rule_u[j][k] * rule_v[i][l]) * sum.points[k][l];
      twists[j][i] = 0.5 * (of_u + of_v) - of_points;
    }
  add(sum.along_u, at_v, {at_u.front(), at_u.back()});
  add(sum.along_v, at_u, {at_v.front(), at_v.back()});
  for (auto& row : sum.points) row.resize(2 * n, Vec3(0));
  for (size_t j = 0; j < m; ++j) {
    sum.points.emplace_back(2 * n, Vec3(0));
    for (size_t i = 0; i < n; ++i) sum.points.back()[n + i] = twists[j][i];
  }
}

std::vector<CurvePtr> b_spline_functions(int degree, const std::vector<double>& knots,
                                         const std::vector<double>& weights, int count) {
  const int all = static_cast<int>(knots.size()) - degree - 1;
  std::vector<CurvePtr> functions;
  for (int i = 0; i < count; ++i) {
    NurbsCurveForm form{degree, knots, {}, {}};
    for (int k = 0; k < all; ++k) {
      const double w = weights.empty() ? 1 : weights[k % count];
      form.points.emplace_back(k % count == i ? w : 0, 0, 0, w);
    }
    functions.push_back(std::make_shared<NurbsCurve>(form));
  }
  return functions;
}

// alpha_0^k(x) = x^k/k! (1 - x)^(n+1) sum over j <= n - k of C(n + j, j) x^j, alpha_1^k(x) = (-1)^k alpha_0^k(1 - x), x
// the share of the range. In Bernstein's form x^m (1 - x)^(n+1) (1 - x + x)^(n - m) has the coefficients of the power.
std::vector<CurvePtr> end_functions(int n, const Interval& range) {
  const int degree = 2 * n + 1;
  const auto choose = [](int a, int b) {
    double result = 1;
    for (int i = 1; i <= b; ++i) result = result * (a - b + i) / i;
    return result;
  };
  std::vector<CurvePtr> functions;
  double scale = 1;  // width^k/k!: derivatives are by the parameter of the range
  for (int k = 0; k <= n; ++k) {
    if (k > 0) scale *= range.width() / k;
    std::vector<double> at_start(degree + 1, 0.0);
    for (int j = 0; j <= n - k; ++j) {
      const int m = k + j;
      for (int l = 0; l <= n - m; ++l)
        at_start[m + l] += scale * choose(n + j, j) * choose(n - m, l) / choose(degree, m + l);
    }
    std::vector<double> at_end(at_start.rbegin(), at_start.rend());
    if (k % 2 == 1)
      for (double& x : at_end) x = -x;
    functions.push_back(function_of(degree, bezier_knots(degree, range), at_start));
    functions.push_back(function_of(degree, bezier_knots(degree, range), at_end));
  }
  return functions;
}

CurvePtr one_function(const Interval& range) {
  return function_of(1, {range.lo, range.lo, range.hi, range.hi}, {1, 1});
}

}  // namespace lekalo::geometry
