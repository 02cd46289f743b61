// Homogeneous control points and the sign of denominators (Golovanov 2016, 1.4.8, 2.6).
#pragma once

#include <span>
#include <vector>

#include "geometry/vectors.h"

namespace lekalo::geometry {

// (w p, w) for each point; no weights: all 1. Only ratios of weights matter: equal ones become 1, and where the first
// weight is negative all change their sign. Throws FieldError (field weights) when the counts differ or all are zero.
std::vector<Vec4> homogeneous(std::span<const Vec3> points, std::span<const double> weights);

// False when all weights are 1: the curve is polynomial.
bool has_weights(std::span<const Vec4> points);

bool all_weights_positive(std::span<const Vec4> points);

// True when the weight of a Bezier net is positive all over [0, 1] x [0, 1]; false where it vanishes, is negative, or
// comes too near to zero to tell. point (i, j) at points[i * (degree_v + 1) + j]; a curve has degree_v = 0.
bool denominator_positive(int degree_u, int degree_v, std::span<const Vec4> points);

}  // namespace lekalo::geometry
