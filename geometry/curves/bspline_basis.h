// B-spline basis functions (Golovanov 2016, 2.8; Piegl, Tiller 1997, 2.5).
//
//   N_i^0 = 1 on [t_i, t_{i+1}), else 0
//   N_i^p = (t - t_i)/(t_{i+p} - t_i) N_i^{p-1} + (t_{i+p+1} - t)/(t_{i+p+1} - t_{i+1}) N_{i+1}^{p-1}
//   d/dt N_i^p = p/(t_{i+p} - t_i) N_i^{p-1} - p/(t_{i+p+1} - t_{i+1}) N_{i+1}^{p-1}
//
// Over one non-empty span [t_s, t_{s+1}) only N_{s-p} .. N_s differ from zero, and every denominator that matters
// contains the span: no 0/0 occurs, whatever the multiplicities.
#pragma once

#include <array>
#include <span>

#include "geometry/curve.h"

namespace lekalo::geometry {

// The highest degree of splines: the fixed-size arrays of evaluation are laid out for it. Bezier curves of higher
// degree are numerically useless long before.
inline constexpr int kMaxDegree = 25;

// d[k][j] is the derivative k of N_{span-degree+j}, j = 0..degree; rows 0..order are set.
struct BasisDerivatives {
  std::array<std::array<double, kMaxDegree + 1>, kMaxCurveOrder + 1> d;
};

// The non-empty span with knots[s] <= t < knots[s + 1], degree <= s <= last - 1 where knots[degree] and knots[last]
// bound the domain; the first or last non-empty one for t beyond them.
int find_span(int degree, std::span<const double> knots, double t);

// All basis functions that do not vanish on the span, with derivatives up to order (0..kMaxCurveOrder). t may lie
// outside the span: the functions continue as the polynomials of that span.
void basis_derivatives(int degree, std::span<const double> knots, int span, double t, int order,
                       BasisDerivatives& result);

}  // namespace lekalo::geometry
