// B-spline curves by what they shall be at given parameters.
#pragma once

#include <span>

#include "geometry/curves/splines/nurbs_curve.h"

namespace lekalo::geometry {

// Open, with these inner knots between lo and hi, clamped there; throws as SplineAxis does.
SplineAxis clamped_axis(int degree, double lo, double hi, std::span<const double> inner);
// Periodic, with all knots of one period; the domain begins at the first.
SplineAxis periodic_axis(int degree, std::span<const double> knots, double period);

// The derivative of order 0 (the point itself) to kMaxCurveOrder at a parameter of the domain.
struct SplineCondition {
  double t = 0;
  int order = 0;
  Vec3 value{0};
};

// The polynomial spline on the axis that fulfils as many conditions as it has distinct control points: a banded system
// (cyclic for a periodic axis), solved with pivoting. At the upper end of the domain derivatives are those from the
// left, elsewhere those from the right. Throws FieldError (field points) where no spline, or more than one, does.
NurbsCurve spline_with(SplineAxis axis, std::span<const SplineCondition> conditions);

}  // namespace lekalo::geometry
