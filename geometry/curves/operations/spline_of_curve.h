// Cubic splines within a tolerance of a curve (Zavyalov et al. 1985, I.5, II.5).
#pragma once

#include "geometry/curves/splines/nurbs_curve.h"

namespace lekalo::geometry {

struct SplineOfCurveOptions {
  bool by_length = false;  // the parameter is the length of arc from the beginning, not the curve's own
  bool even = false;       // equal steps of the curve's parameter between corners
};

// A composite Hermite curve with points and derivatives of the curve at its knots, nowhere farther from it than the
// tolerance: proved at the same parameters; by length checked at places of each span. Periodic where the
// curve closes smoothly. Throws FieldError (field of) for
// an infinite domain, or, by length, where the curve stops; (field tolerance) for too many spans.
NurbsCurve spline_of_curve(const Curve& curve, double tolerance, const SplineOfCurveOptions& options = {});

}  // namespace lekalo::geometry
