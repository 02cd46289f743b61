// Closest points and distances of unbounded surfaces, where they are those of a bounded part.
#pragma once

#include <optional>

#include "geometry/queries/closest/distance.h"

namespace lekalo::geometry {

// What of an unbounded plane, cylinder or cone can be nearest to a thing in the box, and a border around; none of
// other surfaces.
SurfacePtr part_near(const Surface& surface, const Box3& box);

// The distance of two unbounded surfaces, each a plane or a circular cylinder without borders; none of others.
std::optional<Distance> unbounded_distance(const Surface& a, const Surface& b);

}  // namespace lekalo::geometry
