// Triples of numbers as vectors.
#pragma once

#include "geometry/numerics/triple.h"
#include "geometry/vectors.h"

namespace lekalo::geometry {

inline Vec3 vec(const Triple<double>& a) { return {a.x, a.y, a.z}; }

}  // namespace lekalo::geometry
