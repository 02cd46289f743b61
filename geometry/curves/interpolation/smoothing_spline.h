// Natural and periodic cubic splines that pass by their points for the sake of smoothness (Zavyalov et al. 1985, I.7;
// Reinsch 1967).
#pragma once

#include <optional>

#include "geometry/curves/splines/nurbs_curve.h"

namespace lekalo::geometry {

// Derivatives by t at the ends of an open curve; where none is given r'' = 0.
struct EndTangents {
  std::optional<Vec3> start{}, end{};
};

// Parameters are increasing, one for each point, and when closed one more, the end of the period.
//
// The curve r that makes sum_i w_i |r(t_i) - p_i|^2 + stiffness * integral of |r''|^2 smallest. Weights > 0 (none: all
// 1), stiffness >= 0. Throws FieldError (fields weights, points: at least 3, start_tangent, end_tangent: of a closed
// curve).
NurbsCurve smoothing_spline(std::span<const Vec3> points, std::span<const double> parameters, bool closed,
                            double stiffness, std::span<const double> weights = {}, const EndTangents& ends = {});

// Throws FieldError (field corridor) unless there is one half-width, not negative, for each point.
void check_corridor(std::span<const double> half_widths, size_t points);

// The curve with the smallest integral of |r''|^2 whose coordinates at t_i are each within half_widths[i] >= 0 of those
// of p_i: exact up to rounding. Where a straight line (closed: a point; with both end tangents: a parabola) fits, one.
// Throws FieldError (fields corridor, points, start_tangent, end_tangent).
NurbsCurve corridor_spline(std::span<const Vec3> points, std::span<const double> parameters, bool closed,
                           std::span<const double> half_widths, const EndTangents& ends = {});

}  // namespace lekalo::geometry
