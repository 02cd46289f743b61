// Composite cubic Hermite curves (Golovanov 2016, 2.3.10, 2.14.3; Zavyalov et al. 1985, I.5, II.4).
#pragma once

#include "geometry/curves/interpolation/tangent_estimates.h"
#include "geometry/curves/splines/nurbs_curve.h"

namespace lekalo::geometry {

// The cubic spline of class C^1 through points with given derivatives by t, with double knots. Throws FieldError (field
// tangents) unless there is one for each point.
NurbsCurve hermite_curve(const PointSequence& data, std::span<const Vec3> tangents);

// The quintic spline of class C^2 through points with given first and second derivatives by t, with triple knots.
NurbsCurve hermite_curve(const PointSequence& data, std::span<const Vec3> tangents, std::span<const Vec3> second);

}  // namespace lekalo::geometry
