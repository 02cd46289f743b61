// Bezier surfaces, polynomial and rational (Golovanov 2016, 3.7).
//
//   r(u, v) = sum B_i^m(u) B_j^n(v) w_ij p_ij / sum B_i^m(u) B_j^n(v) w_ij,   0 <= u, v <= 1
//
// They are the NURBS surfaces on the knots 0, .., 0, 1, .., 1, and continue analytically outside their domain.
#pragma once

#include "geometry/surfaces/splines/nurbs_surface.h"

namespace lekalo::geometry {

// points[i][j]: i runs with u, j with v; degrees are one less than the rows and columns, at most kMaxDegree. No
// weights: all 1. Throws FieldError (fields points, weights, domain).
NurbsSurface bezier_surface(const Grid<Vec3>& points, std::span<const double> weights = {},
                            const Rectangle& domain = {{0, 1}, {0, 1}});

}  // namespace lekalo::geometry
