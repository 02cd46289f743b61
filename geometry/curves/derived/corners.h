// Corners of curves.
#pragma once

#include <optional>

#include "geometry/curve.h"

namespace lekalo::geometry {

// The first parameter where the direction of the curve changes at once, by more than 1e-6 radians: at a break between
// pieces, or at the seam of a closed curve, which is the end of its domain. Places where the curve rests are none.
std::optional<double> first_corner(const Curve& curve);

}  // namespace lekalo::geometry
