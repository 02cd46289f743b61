// The surface on three Bezier curves as a Bezier triangle (Golovanov 2016, 3.10.11 and 3.17.2).
#pragma once

#include "geometry/surfaces/triangles/bezier_triangle.h"

namespace lekalo::geometry {

// Control points of c_1 from p_3 to p_2, c_2 from p_1 to p_3, c_3 from p_2 to p_1, which meet in the corners; of any
// degrees N. The net of degree N + 1, N the highest,
//
//   P_ijk = (i (e3_(N-j) + e2_k - p_1) + j (e1_(N-k) + e3_i - p_2) + k (e2_(N-i) + e1_j - p_3))/(N + 1)
//
// less 4abc times the correction: for c_1(1/2) + c_2(1/2) + c_3(1/2) - p_1 - p_2 - p_3 the surface has quadratic
// precision.
TriangularNet net_on_three_curves(const std::array<std::vector<Vec3>, 3>& curves, const Vec3& correction = Vec3(0));

// The same with that correction.
TriangularNet balanced_net_on_three_curves(const std::array<std::vector<Vec3>, 3>& curves);

}  // namespace lekalo::geometry
