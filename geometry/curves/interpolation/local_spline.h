// Cubic splines whose control points are made of few neighbouring points, without a system of equations (Zavyalov et
// al. 1985, I.9).
#pragma once

#include "geometry/curves/interpolation/tangent_estimates.h"
#include "geometry/curves/splines/nurbs_curve.h"

namespace lekalo::geometry {

// order 2: near the points and smoother than they are (91). order 4: cubics are reproduced; far nearer to the points of
// smooth curves (92). Knots are the parameters, extended by equal steps. Throws FieldError (field points) for fewer
// points than the order, 3 at least.
NurbsCurve local_spline(const PointSequence& data, int order);

// The points after so many passes of r(t_i) in place of p_i, each of them followed by a step back into the corridor of
// half_widths (none: no corridor) about the first points, in each coordinate (96).
std::vector<Vec3> smoothed_points(const PointSequence& data, int order, int passes,
                                  std::span<const double> half_widths);

}  // namespace lekalo::geometry
