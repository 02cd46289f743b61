// Rational cubic segments with control points p_0 .. p_3 and weights w_0 .. w_3 > 0, and what they are at their ends
// (Korotkij, Studenova 2024, formulas 1 to 6).
//
// With a = p_1 - p_0, b = p_2 - p_1, c = p_3 - p_2 the binormal times the curvature is
//
//   K(0) = 2/3 I_0 a x b / |a|^3,   K(1) = 2/3 I_1 b x c / |c|^3,   I_0 = w_0 w_2 / w_1^2,   I_1 = w_1 w_3 / w_2^2.
//
// The set of points depends on the weights by I_0 and I_1 alone: w_i -> m l^i w_i changes the parameter only. In the
// standard form w_0 = w_3 = 1, w_1 = I_0^(-2/3) I_1^(-1/3), w_2 = I_0^(-1/3) I_1^(-2/3).
#pragma once

#include <array>

#include "geometry/curves/splines/bezier_chain.h"

namespace lekalo::geometry {

struct RationalCubic {
  std::array<Vec3, 4> points{};
  std::array<double, 4> weights{1, 1, 1, 1};

  double start_invariant() const { return weights[0] * weights[2] / (weights[1] * weights[1]); }
  double end_invariant() const { return weights[1] * weights[3] / (weights[2] * weights[2]); }
  // Along the binormal, as long as the curvature; zero where the three points at the end lie on one line. Not defined
  // where the first two coincide.
  Vec3 start_curvature() const;
  Vec3 end_curvature() const;

  BezierSegment bezier() const;
};

// Weights with these invariants, both positive.
enum class CubicWeights {
  standard,    // w_0 = w_3 = 1
  inner_ones,  // w_1 = w_2 = 1, w_0 = I_0, w_3 = I_1
};
std::array<double, 4> weights_of_invariants(double start, double end, CubicWeights form = CubicWeights::standard);

// I_0 of the curvature k > 0 at p_0: 3 k |a|^2 / (2 d), d the distance of p_2 from the line through p_0 and p_1. For
// I_1 the points are counted from the end. Throws FieldError (the field) where d is 0: the curvature there can only be
// 0.
double invariant_of_curvature(double curvature, const Vec3& p0, const Vec3& p1, const Vec3& p2,
                              const std::string& field);

}  // namespace lekalo::geometry
