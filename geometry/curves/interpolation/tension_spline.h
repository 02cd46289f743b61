// Interpolating splines between the cubic and the polyline (Zavyalov et al. 1985, I.6; Spath 1969).
#pragma once

#include <optional>

#include "geometry/curves/interpolation/tangent_estimates.h"
#include "geometry/curves/splines/nurbs_curve.h"

namespace lekalo::geometry {

// The rational C2 spline through points with a tension >= 0 for each span: all 0 the cubic spline, large ones near to
// the sides of the polygon. Ends without a tangent (dr/dt) are natural, r'' = 0; a closed curve has none. Throws
// FieldError (field tension).
NurbsCurve tension_spline(const PointSequence& data, std::span<const double> tensions,
                          const std::optional<Vec3>& start_tangent = {}, const std::optional<Vec3>& end_tangent = {});

// Tensions, at least those given, with which each coordinate is convex over spans where its data are (second
// differences of one sign at both ends) and monotone where a span and those beside it, or the given tangent, are.
std::vector<double> shape_keeping_tensions(const PointSequence& data, std::vector<double> tensions,
                                           const std::optional<Vec3>& start_tangent = {},
                                           const std::optional<Vec3>& end_tangent = {});

}  // namespace lekalo::geometry
