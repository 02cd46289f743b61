// Polylines (Golovanov 2016, 2.3.1): r(t) = (1 - w) p_i + w p_{i+1} for i <= t < i + 1, w = t - i.
//
// A polyline is the NURBS curve of degree 1 on integer knots (Golovanov 2016, 2.14). The derivative jumps at the
// points; there it is that of the following side. A closed polyline is periodic.
#pragma once

#include "geometry/curves/splines/nurbs_curve.h"

namespace lekalo::geometry {

// t runs from 0 to the number of sides. Throws FieldError (field points) for fewer than 2 points (3 when closed) or
// equal neighbours.
NurbsCurve polyline(std::span<const Vec3> points, bool closed = false);

}  // namespace lekalo::geometry
