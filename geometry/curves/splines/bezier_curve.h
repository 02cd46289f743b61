// Bezier curves, polynomial and rational (Golovanov 2016, 2.4, 2.6).
//
//   r(t) = sum B_i^n(t) w_i p_i / sum B_i^n(t) w_i,   B_i^n = C(n, i) t^i (1 - t)^(n-i),   t in [0, 1]
//
// A Bezier curve is the NURBS curve on the knots 0 (n + 1 times), 1 (n + 1 times), with one difference: it continues
// analytically outside its domain.
#pragma once

#include "geometry/curves/splines/nurbs_curve.h"

namespace lekalo::geometry {

// Degree = points - 1, at most kMaxDegree. No weights: all 1.
// Throws FieldError (fields points, weights, domain).
NurbsCurve bezier_curve(std::span<const Vec3> points, std::span<const double> weights = {},
                        const Interval& domain = {0, 1});

}  // namespace lekalo::geometry
