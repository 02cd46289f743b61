// What a hit shows, in the space of the leaf that was hit.
#pragma once

#include "render/trace/hierarchy.h"

namespace lekalo::render {

// The point of a hit whose ray, of the unit direction `incoming` in the world, found it at `near` in the space of the
// leaf. `object` and `error`: of Hierarchy::Place; `stretch`: largest of the map from the leaf to the world, 1 without
// one. What belongs to the ray's way (the rounding of its coordinates, the pixel's size) is not in it.
SurfacePoint point_in_leaf(const Leaf& leaf, const Hit& hit, const Vec3& near, const Vec3& incoming, int object,
                           double error, double stretch);

}  // namespace lekalo::render
