// Splines in 113 bits, straight from the definition: the Cox-de Boor recursion on Taylor jets (Golovanov 2016, 2.8.12,
// 0/0 = 0), homogeneous sums, one division of jets. Shares nothing with the product but its number types. Beside each
// derivative stands the sum of the absolute values of all terms of its formula, to which rounding errors are compared.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "geometry/numerics/jet.h"
#include "geometry/quad.h"
#include "geometry/surface.h"
#include "support/worst.h"

namespace lekalo::geometry::oracle {

// The last non-empty span that begins at or before t inside the domain (before t at the domain's end).
inline int span_of(int degree, const std::vector<double>& knots, double t) {
  int span = -1;
  for (int i = degree; i + degree + 1 < static_cast<int>(knots.size()); ++i)
    if (knots[i] < knots[i + 1] && (span < 0 || knots[i] <= t)) span = i;
  return span;
}

template <class T>
T basis(int degree, const std::vector<double>& knots, int i, int span, const T& t) {
  if (degree == 0) return T(i == span ? 1 : 0);
  T sum(0);
  const Quad left = Quad(knots[i + degree]) - Quad(knots[i]), right = Quad(knots[i + degree + 1]) - Quad(knots[i + 1]);
  if (left > 0 && i <= span && i + degree - 1 >= span)
    sum += (t - T(Quad(knots[i]))) / T(left) * basis(degree - 1, knots, i, span, t);
  if (right > 0 && i + 1 <= span && i + degree >= span)
    sum += (T(Quad(knots[i + degree + 1])) - t) / T(right) * basis(degree - 1, knots, i + 1, span, t);
  return sum;
}

// Derivative k of N_i with every difference of its formula (2.8.15) made a sum.
inline double absolute_derivative(int k, int degree, const std::vector<double>& knots, int i, int span, double t) {
  if (k == 0) return static_cast<double>(abs(basis(degree, knots, i, span, Quad(t))));
  if (k > degree) return 0;
  double sum = 0;
  const double left = knots[i + degree] - knots[i], right = knots[i + degree + 1] - knots[i + 1];
  if (left > 0 && i <= span && i + degree - 1 >= span)
    sum += degree / left * absolute_derivative(k - 1, degree - 1, knots, i, span, t);
  if (right > 0 && i + 1 <= span && i + degree >= span)
    sum += degree / right * absolute_derivative(k - 1, degree - 1, knots, i + 1, span, t);
  return sum;
}

// A derivative and the sum of absolute terms of each coordinate.
struct Exact {
  Vec3 value;
  Vec3 terms;
};

inline double choose(int n, int k) { return k == 0 ? 1 : choose(n - 1, k - 1) * n / k; }

// Derivatives 0..order (at most 6) of the curve at t in the span (from the right at knots unless told otherwise).
inline std::vector<Exact> curve_derivatives(const NurbsCurveForm& form, double t, int order, int span = -1) {
  using J = Jet<Quad, kMaxCurveOrder>;
  if (span < 0) span = span_of(form.degree, form.knots, t);
  const J x = J::variable(Quad(t));
  J sums[4];
  std::vector<Vec4> terms(order + 1, Vec4(0));
  for (int i = span - form.degree; i <= span; ++i) {
    const J n = basis(form.degree, form.knots, i, span, x);
    for (int axis = 0; axis < 4; ++axis) sums[axis] += n * J(Quad(form.points[i][axis]));
    for (int k = 0; k <= order; ++k)
      terms[k] += absolute_derivative(k, form.degree, form.knots, i, span, t) * glm::abs(form.points[i]);
  }
  std::vector<Exact> result(order + 1);
  const double w = std::abs(static_cast<double>(sums[3].value()));
  for (int axis = 0; axis < 3; ++axis) {
    const J r = sums[axis] / sums[3];
    for (int k = 0; k <= order; ++k) {
      result[k].value[axis] = static_cast<double>(r.derivative(k));
      double sum = terms[k][axis];
      for (int i = 1; i <= k; ++i) sum += choose(k, i) * terms[i].w * result[k - i].terms[axis];
      result[k].terms[axis] = sum / w * (terms[0].w / w);
    }
  }
  return result;
}

// Partial derivatives of total order up to `order` (at most 4), by SurfaceJet::index.
inline std::vector<Exact> surface_derivatives(const NurbsSurfaceForm& form, double u, double v, int order) {
  using J = Jet2<Quad, kMaxSurfaceOrder>;
  const int p = form.degree_u, q = form.degree_v;
  const int span_u = span_of(p, form.knots_u, u), span_v = span_of(q, form.knots_v, v);
  const int count = (order + 1) * (order + 2) / 2;
  J sums[4];
  std::vector<Vec4> terms(count, Vec4(0));
  for (int i = span_u - p; i <= span_u; ++i)
    for (int j = span_v - q; j <= span_v; ++j) {
      const J n = basis(p, form.knots_u, i, span_u, J::u_variable(Quad(u))) *
                  basis(q, form.knots_v, j, span_v, J::v_variable(Quad(v)));
      const Vec4& point = form.points[static_cast<size_t>(i) * form.count_v() + j];
      for (int axis = 0; axis < 4; ++axis) sums[axis] += n * J(Quad(point[axis]));
      for (int a = 0; a <= order; ++a)
        for (int b = 0; a + b <= order; ++b)
          terms[SurfaceJet::index(a, b)] += absolute_derivative(a, p, form.knots_u, i, span_u, u) *
                                            absolute_derivative(b, q, form.knots_v, j, span_v, v) * glm::abs(point);
    }
  std::vector<Exact> result(count);
  const double w = std::abs(static_cast<double>(sums[3].value()));
  for (int axis = 0; axis < 3; ++axis) {
    const J r = sums[axis] / sums[3];
    for (int n = 0; n <= order; ++n)
      for (int b = 0; b <= n; ++b) {
        const int a = n - b, index = SurfaceJet::index(a, b);
        result[index].value[axis] = static_cast<double>(r.derivative(a, b));
        double sum = terms[index][axis];
        for (int s = 0; s <= a; ++s)
          for (int t = 0; t <= b; ++t)
            if (s + t > 0)
              sum += choose(a, s) * choose(b, t) * terms[SurfaceJet::index(s, t)].w *
                     result[SurfaceJet::index(a - s, b - t)].terms[axis];
        result[index].terms[axis] = sum / w * (terms[0].w / w);
      }
  }
  return result;
}

// The error in units of eps times the absolute terms; the largest over the coordinates.
inline double error_in_eps(const Vec3& computed, const Exact& exact) {
  double worst = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double error = std::abs(computed[axis] - exact.value[axis]);
    if (error != 0) worst = tests::worse(worst, error / (2.220446049250313e-16 * exact.terms[axis]));
  }
  return worst;
}

}  // namespace lekalo::geometry::oracle
