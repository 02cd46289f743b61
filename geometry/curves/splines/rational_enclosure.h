// Certified boxes around rational polynomial pieces and their derivatives up to the fourth.
//
// The homogeneous curve (A, w) over [a, b] is brought to Bezier form; the convex hull of its points bounds it. With all
// weights positive the projected points bound r = A/w just as tightly; else r is the quotient of two intervals. For the
// derivatives the origin is first moved to the middle c of the box of r (A~ = A - c w, r~ = r - c), so that
//
//   r' = (A~' - w' r~)/w,   r'' = (A~'' - 2 w' r' - w'' r~)/w,   and so on by Leibniz's rule
//
// loses only a term of the size of the box. Rounding is covered by a slack on each Bezier point, a sum of control
// points with weights that are not negative and sum up to 1: in proportion to the largest coordinate.
#pragma once

#include <span>

#include "geometry/surface.h"

namespace lekalo::geometry {

// Adds to the boxes of `result` the point and derivatives up to order (0..4) over t, a part of the span
// [knots[span], knots[span + 1]]. points[span - degree .. span] are its control points; `rational` false says that all
// weights are 1.
void enclose_span(int degree, std::span<const double> knots, int span, std::span<const Vec4> points, bool rational,
                  const Interval& t, int order, CurveEnclosure& result);

// The same for a surface; point (i, j) at points[i * count_v + j].
void enclose_spans(const NurbsSurfaceForm& form, int span_u, int span_v, bool rational, const Rectangle& box, int order,
                   SurfaceEnclosure& result);

}  // namespace lekalo::geometry
