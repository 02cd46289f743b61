// Functions that blend curves, as splines with their values for the first coordinate.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/surfaces/nets/boolean_sum.h"

namespace lekalo::geometry {

namespace {

CurvePtr function_of(int degree, std::vector<double> knots, const std::vector<double>& values) {
  NurbsCurveForm form{degree, std::move(knots), {}, {}};
  for (const double x : values) form.points.emplace_back(x, 0, 0, 1);
  return std::make_shared<NurbsCurve>(form);
}

std::vector<double> clamped(int degree, const std::vector<double>& nodes, int multiplicity) {
  std::vector<double> knots(degree + 1, nodes.front());
  for (size_t i = 1; i + 1 < nodes.size(); ++i) knots.insert(knots.end(), multiplicity, nodes[i]);
  knots.insert(knots.end(), degree + 1, nodes.back());
  return knots;
}

// The C1 cubic with these values and derivatives at the nodes.
CurvePtr hermite(const std::vector<double>& nodes, const std::vector<double>& values,
                 const std::vector<double>& derivatives) {
  std::vector<double> points{values.front()};
  for (size_t i = 0; i + 1 < nodes.size(); ++i) {
    const double h = (nodes[i + 1] - nodes[i]) / 3;
    points.push_back(values[i] + h * derivatives[i]);
    points.push_back(values[i + 1] - h * derivatives[i + 1]);
  }
  points.push_back(values.back());
  return function_of(3, clamped(3, nodes, 2), points);
}

// Weights of three values in the derivative at the middle one of the parabola through them.
std::array<double, 3> three_point(double a, double b, double c) {
  const double before = b - a, after = c - b, all = c - a;
  return {-after / (before * all), (after - before) / (before * after), before / (after * all)};
}

// Derivatives at the nodes as a matrix over the values.
Eigen::MatrixXd derivative_rule(const std::vector<double>& nodes, bool closed) {
  const int n = static_cast<int>(nodes.size()) - 1;
  Eigen::MatrixXd rule = Eigen::MatrixXd::Zero(n + 1, n + 1);
  if (n == 1) {
    const double slope = 1 / (nodes[1] - nodes[0]);
    rule << -slope, slope, -slope, slope;
    return rule;
  }
  for (int i = 1; i < n; ++i) {
    const auto weights = three_point(nodes[i - 1], nodes[i], nodes[i + 1]);
    for (int k = 0; k < 3; ++k) rule(i, i - 1 + k) = weights[k];
  }
  if (closed) {
    const auto weights = three_point(nodes[0] - (nodes[n] - nodes[n - 1]), nodes[0], nodes[1]);
    for (const int end : {0, n}) rule(end, n - 1) += weights[0], rule(end, 0) += weights[1], rule(end, 1) += weights[2];
    return rule;
  }
  // q_0 = 3/2 (p_1 - p_0)/h - q_1/2: no second derivative at the end.
  const auto natural = [&](int end, int next, double h) {
    rule.row(end) = -0.5 * rule.row(next);
    rule(end, next) += 1.5 / h;
    rule(end, end) -= 1.5 / h;
  };
  natural(0, 1, nodes[1] - nodes[0]);
  natural(n, n - 1, nodes[n - 1] - nodes[n]);
  return rule;
}

// The same of C2 splines: continuity of the second derivative, none at the ends (or the same at both).
Eigen::MatrixXd smooth_rule(const std::vector<double>& nodes, bool closed) {
  const int n = static_cast<int>(nodes.size()) - 1;
  if (n == 1) return derivative_rule(nodes, false);
  Eigen::MatrixXd left = Eigen::MatrixXd::Zero(n + 1, n + 1), right = left;
  // q_(i-1)/h + 2 q_i (1/h + 1/k) + q_(i+1)/k = 3 (p_i - p_(i-1))/h^2 + 3 (p_(i+1) - p_i)/k^2
  const auto joint = [&](int row, int before, int at, int after, double h, double k) {
    left(row, before) += 1 / h, left(row, at) += 2 / h + 2 / k, left(row, after) += 1 / k;
    right(row, before) -= 3 / (h * h), right(row, at) += 3 / (h * h) - 3 / (k * k), right(row, after) += 3 / (k * k);
  };
  for (int i = 1; i < n; ++i) joint(i, i - 1, i, i + 1, nodes[i] - nodes[i - 1], nodes[i + 1] - nodes[i]);
  if (closed) {
    joint(0, n - 1, 0, 1, nodes[n] - nodes[n - 1], nodes[1] - nodes[0]);
    left(n, n) = 1, left(n, 0) = -1;
  } else {
    const auto natural = [&](int end, int next, double h) {
      left(end, end) = 2, left(end, next) = 1;
      right(end, next) = 3 / h, right(end, end) = -3 / h;
    };
    natural(0, 1, nodes[1] - nodes[0]);
    natural(n, n - 1, nodes[n - 1] - nodes[n]);
  }
  return left.partialPivLu().solve(right);
}

std::vector<CurvePtr> cardinal(const std::vector<double>& nodes, const Eigen::MatrixXd& rule, bool closed) {
  const int n = static_cast<int>(nodes.size()) - 1;
  std::vector<CurvePtr> functions;
  for (int i = 0; i < n + (closed ? 0 : 1); ++i) {
    Eigen::VectorXd values = Eigen::VectorXd::Zero(n + 1);
    values(i) = 1;
    if (closed && i == 0) values(n) = 1;
    // Of a closed rule the last node's column is that of the first.
    Eigen::VectorXd once = values;
    if (closed) once(n) = 0;
    const Eigen::VectorXd slopes = rule * once;
    functions.push_back(hermite(nodes, {values.begin(), values.end()}, {slopes.begin(), slopes.end()}));
  }
  return functions;
}

}  // namespace

std::vector<CurvePtr> hermite_functions(const std::vector<double>& nodes, bool closed) {
  return cardinal(nodes, derivative_rule(nodes, closed), closed);
}

// The sum's own mixed derivative at a node is that of both families less the rule's of the points: what is to be
// added is multiplied by functions whose derivative is 1 at one node. Their curves are zero.
void mean_twists(BooleanSum& sum, const std::vector<double>& at_u, const std::vector<double>& at_v) {
  const size_t m = at_u.size(), n = at_v.size();
  const auto rule_u = derivative_rule(at_u, false), rule_v = derivative_rule(at_v, false);
  const auto add = [](Family& family, const std::vector<double>& nodes, const Interval& over) {
    for (size_t k = 0; k < nodes.size(); ++k) {
      std::vector<double> slopes(nodes.size(), 0.0);
      slopes[k] = 1;
      family.functions.push_back(hermite(nodes, std::vector<double>(nodes.size(), 0.0), slopes));
      family.curves.push_back(std::make_shared<NurbsCurve>(
          NurbsCurveForm{1, {over.lo, over.lo, over.hi, over.hi}, {Vec4(0, 0, 0, 1), Vec4(0, 0, 0, 1)}, {}}));
    }
  };
  const auto slope = [](const CurvePtr& curve, double t) { return curve->evaluate(t, 1).d[1]; };
  std::vector<std::vector<Vec3>> twists(m, std::vector<Vec3>(n, Vec3(0)));
  for (size_t j = 0; j < m; ++j)
    for (size_t i = 0; i < n; ++i) {
      Vec3 of_u(0), of_v(0), of_points(0);  // d/dv of s_u, d/du of s_v, the rule's of the points
      for (size_t k = 0; k < m; ++k) of_u += rule_u(j, k) * slope(sum.along_v.curves[k], at_v[i]);
      for (size_t k = 0; k < n; ++k) of_v += rule_v(i, k) * slope(sum.along_u.curves[k], at_u[j]);
      for (size_t k = 0; k < m; ++k)
        for (size_t l = 0; l < n; ++l) of_points += (rule_u(j, k) * rule_v(i, l)) * sum.points[k][l];
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

std::vector<CurvePtr> spline_functions(const std::vector<double>& nodes, bool closed) {
  return cardinal(nodes, smooth_rule(nodes, closed), closed);
}

// In Bernstein's form over the whole range: coefficient k is the polar form at k times the end.
std::vector<CurvePtr> lagrange_functions(const std::vector<double>& nodes) {
  const int n = static_cast<int>(nodes.size()) - 1;
  const Interval range(nodes.front(), nodes.back());
  std::vector<CurvePtr> functions;
  for (int i = 0; i <= n; ++i) {
    // Multiplied out factor by factor: (t - t_j)/(t_i - t_j) is linear.
    std::vector<double> points{1};
    for (int j = 0; j <= n; ++j) {
      if (j == i) continue;
      const double lo = (range.lo - nodes[j]) / (nodes[i] - nodes[j]),
                   hi = (range.hi - nodes[j]) / (nodes[i] - nodes[j]);
      const int degree = static_cast<int>(points.size());
      std::vector<double> product(degree + 1, 0);
      for (int k = 0; k < degree; ++k) {
        product[k] += points[k] * lo * (degree - k) / degree;
        product[k + 1] += points[k] * hi * (k + 1) / degree;
      }
      points = std::move(product);
    }
    functions.push_back(function_of(n, clamped(n, {range.lo, range.hi}, 1), points));
  }
  return functions;
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
    functions.push_back(function_of(degree, clamped(degree, {range.lo, range.hi}, 1), at_start));
    functions.push_back(function_of(degree, clamped(degree, {range.lo, range.hi}, 1), at_end));
  }
  return functions;
}

CurvePtr one_function(const Interval& range) {
  return function_of(1, {range.lo, range.lo, range.hi, range.hi}, {1, 1});
}

}  // namespace lekalo::geometry
