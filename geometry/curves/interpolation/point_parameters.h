// Parameters at which a curve passes through given points.
#pragma once

#include <span>
#include <vector>

#include "geometry/describe.h"

namespace lekalo::geometry {

// Increasing parameters t_i, one for each point, and for a closed curve one more, where it comes back to the first:
//   uniform       t_i = i
//   chord_length  t_0 = 0, steps |p_{i+1} - p_i|               (Golovanov 2016, 2.3)
//   centripetal   steps |p_{i+1} - p_i|^(1/2)                   (Lee 1989)
// or those given. Throws FieldError (field points) for too few points (3 when closed), a closed curve whose last point
// repeats the first, and equal neighbours where steps are distances; (field knots) for a wrong number of parameters,
// or ones that do not increase.
std::vector<double> point_parameters(const Knots& knots, std::span<const Vec3> points, bool closed);

// What the field of such knots says of itself.
inline constexpr const char* kPointKnots =
    "parameters of the points (when closed one more: the end of the period), or a rule: uniform, chord_length, "
    "centripetal";

}  // namespace lekalo::geometry
