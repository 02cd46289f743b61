// Rational Bezier segments of one degree, each beginning where the one before ends, as one NURBS curve.
//
// Segment i has the knots i and i + 1, each `degree` times: the control points are those of the segments, joints taken
// once. All weights of a segment are multiplied by one constant, which changes nothing, so that neighbours agree in the
// weight of their joint (Piegl, Tiller 1997, 5.3).
#pragma once

#include <span>
#include <vector>

#include "geometry/curves/splines/nurbs_curve.h"

namespace lekalo::geometry {

// Homogeneous control points; degree + 1 of them, first and last weight positive.
using BezierSegment = std::vector<Vec4>;

// t runs from 0 to the number of segments; or the ends of the segments are at `breaks`, one more than segments and
// increasing. At least one segment, all of one degree. The last point of a segment is taken for the first of the next.
NurbsCurveForm bezier_chain(std::span<const BezierSegment> segments, std::span<const double> breaks = {});

// The same as a periodic curve: the last segment ends where the first begins, with the weight that it begins with.
NurbsCurve closed_bezier_chain(std::span<const BezierSegment> segments, std::span<const double> breaks = {});

}  // namespace lekalo::geometry
