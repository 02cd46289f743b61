// The same NURBS curve with more knots or a higher degree (Golovanov 2016, 2.6, 2.11); a periodic one stays periodic.
#pragma once

#include <span>

#include "geometry/curves/splines/nurbs_curve.h"

namespace lekalo::geometry {

// Knots inside the domain, each put in `times` times; one that stands twice in the list twice as often. Throws
// FieldError (fields of, at) for a curve without a NURBS form, a parameter outside, and a knot too many.
NurbsCurve with_inserted_knots(const CurvePtr& curve, std::span<const double> at, int times = 1);

// Of this degree; none: one more than the curve's. Throws FieldError (fields of, degree) for a lower one.
NurbsCurve with_degree(const CurvePtr& curve, std::optional<int> degree = {});

}  // namespace lekalo::geometry
