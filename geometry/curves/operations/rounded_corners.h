// Curves whose corners are rounded (Zavyalov et al. 1985, II.5).
#pragma once

#include "geometry/curves/splines/nurbs_curve.h"

namespace lekalo::geometry {

// The curve with a cubic in place of each corner, from about `zone` before it along the curve to as much behind it,
// with the tangents there: of class C1; that of a closed curve at its seam too. The parameter is the curve's own up to
// the first corner, afterwards in the measure that keeps the speed. Throws FieldError (field of) for a curve that is
// not a NURBS curve in its own parameter, or stops at a corner; (field zone) where zones of corners overlap.
NurbsCurve rounded_corners(const Curve& curve, double zone);

}  // namespace lekalo::geometry
