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

// Values at increasing coarse knots, from the first parameter to the last (closed: the end of the period), by parabolas
// that are the nearest to the points between the knots beside, the ends of that range included. One for each knot but
// the last of a closed curve. Throws FieldError (field spans) where a range has fewer than 3 points (Zavyalov et al.
// 1985, II.5).
std::vector<Vec3> local_means(const PointSequence& data, std::span<const double> knots);

}  // namespace lekalo::geometry
