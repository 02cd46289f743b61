// The point of a curve that is farthest along a vector: the farthest of its samples, and from there to the maximum.
#pragma once

#include "geometry/curve.h"

namespace lekalo::geometry {

Vec3 farthest_point(const Curve& curve, const Vec3& along);

}  // namespace lekalo::geometry
