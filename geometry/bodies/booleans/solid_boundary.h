// The boundaries of solids that are put together (shapes/csg.h): the same solid as a body.
#pragma once

#include <string_view>
#include <vector>

#include "geometry/body.h"
#include "geometry/shape.h"

namespace lekalo::geometry {

// Whether a solid is put together of bodies and half-spaces only, so that it has a boundary that can be made.
bool has_boundary(const Shape& shape);

// Made at the first question and kept with the solid; faces are named by their operand. Throws BooleanError,
// std::invalid_argument where has_boundary() is false or an unbounded half-space is left.
BodyPtr boundary_of(const ShapePtr& shape);

// The boundaries of what such a solid is put together of, where it stands; none of a solid that is not put together.
// Throws as boundary_of() does.
std::vector<BodyPtr> operands_of(const ShapePtr& shape);

// What lies behind a plane, which its normal looks away from, as far as a box reaches: a block, its face on the plane
// called z_max.
Body block_behind(const Vec3& through, const Vec3& normal, const Box3& box);

// Types of scenes that make such solids.
bool makes_boundary(std::string_view type);

}  // namespace lekalo::geometry
