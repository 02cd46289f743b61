// Bezier points of one knot span by blossoming.
//
// The polynomial piece of a B-spline over the span [t_i, t_{i+1}) has a polar form f(x_1, ..., x_p), symmetric and
// affine in each argument, with f(t, ..., t) = r(t). The de Boor recursion with one argument at each level evaluates
// it, and the Bezier points over [a, b] are f(a, .., a, b, .., b) with j times b (Ramshaw 1989; Golovanov
// 2016, 2.10, 2.11). This is knot insertion to full multiplicity without intermediate knot vectors: it needs no special
// cases for clamped, unclamped and multiple knots, because every denominator contains the span.
#pragma once

#include <span>

#include "geometry/vectors.h"

namespace lekalo::geometry {

// Writes the degree + 1 Bezier points over [a, b] of the span i (t_i < t_{i+1}, degree <= i) to result[0],
// result[stride],
// ...; reads the control points points[(i - degree) * stride], ... [a, b] need not lie inside the span.
void bezier_points(int degree, std::span<const double> knots, int span, const Vec4* points, int stride, double a,
                   double b, Vec4* result, int result_stride);

}  // namespace lekalo::geometry
