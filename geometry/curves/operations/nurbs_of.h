// Any curve as a NURBS form with an affine parameter: exactly where there is one, else fitted.
#pragma once

#include "geometry/curve.h"

namespace lekalo::geometry {

struct NurbsOfCurve {
  NurbsCurveForm form;   // clamped, without maps
  bool exact = true;     // the same points; a parameter that knots cannot express becomes the rational one
  double deviation = 0;  // of a fit: the largest distance from the curve at the same parameter that was seen
};

// The part of the curve over `part`, inside its domain. A fit is of degree 5 and takes the curve's points and first two
// derivatives at its knots, which are halved until nothing farther than `tolerance` (a length) is seen between them;
// where the curve is smooth the fit is of class C2. Throws std::invalid_argument for an infinite range, and where the
// tolerance is not reached.
NurbsOfCurve nurbs_of(const Curve& curve, const Interval& part, double tolerance);

}  // namespace lekalo::geometry
