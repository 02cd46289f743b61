// Elementary bodies (Golovanov 2016, 5.6): closed, outward-oriented, valid. Lengths in scene units; all throw
// std::invalid_argument for dimensions without a body.
#pragma once

#include <vector>

#include "geometry/body.h"

namespace lekalo::geometry {

// Box along the frame's axes from its origin. Faces x_min, x_max, y_min, y_max, z_min, z_max.
Body box(const Frame& frame, const Vec3& size);

Body ball(const Frame& frame, double radius);

// Along z; one radius may be 0, which gives a cone with its apex. Faces start, end, side.
Body frustum(const Frame& frame, double radius, double top_radius, double height);
inline Body cylinder_body(const Frame& frame, double radius, double height) {
  return frustum(frame, radius, radius, height);
}

// Straight arrow along z from the frame's origin: a shaft and a cone whose apex is at the height `length`.
// 0 < radius < head_radius, 0 < head_length < length. Faces start, shaft, back (of the head), head.
Body arrow_body(const Frame& frame, double length, double radius, double head_length, double head_radius);

// 0 < minor_radius < major_radius.
Body torus_body(const Frame& frame, double major_radius, double minor_radius);

// A box whose top face z_max is only `top` long in x (0 <= top), from x_min; 0 gives a ridge. Faces as a box; x_max
// leans.
Body wedge(const Frame& frame, const Vec3& size, double top);

// Over a counterclockwise simple polygon in the frame's plane. Faces start, end, side.k (from corner k to k + 1).
Body prism(const Frame& frame, const std::vector<Vec2>& base, double height);

// Base as for a prism, apex in the frame's coordinates, z > 0. With 0 < top < 1 the part of the pyramid below a plane
// parallel to the base, whose section is `top` times as large as the base. Faces start, side.k, end of a frustum.
Body pyramid(const Frame& frame, const std::vector<Vec2>& base, const Vec3& apex, double top = 0);

}  // namespace lekalo::geometry
