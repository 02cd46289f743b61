// Interpolating polynomials (Golovanov 2016, 2.3.2 to 2.3.6, 2.14 b; Zavyalov et al. 1985, I.1).
#pragma once

#include "geometry/curves/interpolation/spline_curve.h"

namespace lekalo::geometry {

// The polynomial curve of the lowest degree through points at increasing parameters, with derivatives by t at some of
// them: a single Bezier piece over the parameters. Throws FieldError (fields points, tangents) for a degree above
// kMaxDegree.
NurbsCurve lagrange_curve(std::span<const Vec3> points, std::span<const double> parameters,
                          std::span<const PointTangent> tangents = {});

}  // namespace lekalo::geometry
