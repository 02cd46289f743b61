// B-spline basis functions (Golovanov 2016, 2.8; Piegl, Tiller 1997, 2.5).
//
//   N_i^0 = 1 on [t_i, t_{i+1}), else 0
//   N_i^p = (t - t_i)/(t_{i+p} - t_i) N_i^{p-1} + (t_{i+p+1} - t)/(t_{i+p+1} - t_{i+1}) N_{i+1}^{p-1}
//   d/dt N_i^p = p/(t_{i+p} - t_i) N_i^{p-1} - p/(t_{i+p+1} - t_{i+1}) N_{i+1}^{p-1}
//
// Over one non-empty span [t_s, t_{s+1}) only N_{s-p} .. N_s differ from zero, and every denominator that matters
// contains the span: no 0/0 occurs, whatever the multiplicities.
#pragma once

#include <span>

#include "geometry/curve.h"

namespace lekalo::geometry {

// The highest degree of splines: the fixed-size arrays of evaluation are laid out for it. Bezier curves of higher
// degree are numerically useless long before.
inline constexpr int kMaxDegree = 25;

// The non-empty span with knots[s] <= t < knots[s + 1], degree <= s <= last - 1 where knots[degree] and knots[last]
// bound the domain; the first or last non-empty one for t beyond them.
int find_span(int degree, std::span<const double> knots, double t);

// The basis of one span at one parameter, ready for sums over control points and their differences.
//
//   d^k r/dt^k = sum_m values[k][m] P_m^(k),   P_m^(0) = P_{span-p+m},
//   P_m^(k) = factors[k][m] (P_{m+1}^(k-1) - P_m^(k-1)),   m = 0..p-k                     (Golovanov
//   2016, 2.9.5, 2.9.6)
//
// Differences of neighbouring points lose nothing to a distant origin, and a constant coordinate has derivative 0.
struct SpanBasis {
  int degree;
  double values[kMaxCurveOrder + 1][kMaxDegree + 1];   // of degree p - k
  double factors[kMaxCurveOrder + 1][kMaxDegree + 1];  // (p + 1 - k) over a knot difference, k >= 1

  // Derivatives 0..order of the sum over the span's degree + 1 control points, which are overwritten.
  template <class Point>
  void derivatives(Point* points, int order, Point* result) const {
    for (int k = 0; k <= order; ++k) {
      Point sum(0);
      for (int m = 0; m <= degree - k; ++m) {
        if (k > 0) points[m] = factors[k][m] * (points[m + 1] - points[m]);
        sum += values[k][m] * points[m];
      }
      result[k] = sum;
    }
  }
};

// For derivatives up to order (0..kMaxCurveOrder). t may lie outside the span: the functions continue as the
// polynomials of that span.
SpanBasis span_basis(int degree, std::span<const double> knots, int span, double t, int order);

// Derivative k (0..kMaxCurveOrder) of the functions N_{span-degree} .. N_span at t, to result[0..degree].
void basis_derivative(int degree, std::span<const double> knots, int span, double t, int k, std::span<double> result);

}  // namespace lekalo::geometry
