// What blends are computed on: surfaces of faces and curves of edges, continued beyond these.
#pragma once

#include <array>

#include "geometry/surface.h"

namespace lekalo::geometry {

// A surface of which that of a face is a part, with parameters of its own: the unbounded plane where it is flat, the
// unbounded cylinder where it is round; else its law over a rectangle three times as wide, or where it has none its
// tangents at the border; the surface itself where there is nothing beyond it.
SurfacePtr support_of(const SurfacePtr& surface);

// The parameters of the point of a surface at p, near to a place or, where nothing is found there, anywhere. Throws
// std::invalid_argument where there is no foot point.
Vec2 foot_place_anywhere(const SurfacePtr& surface, const Vec3& p, const Vec2& near);

// A curve continued along its tangents or circles of curvature by lengths beyond its start and end (none where they are
// not positive), with its parameter: lines and circles go on as they are.
CurvePtr guide_beyond(const CurvePtr& curve, const std::array<double, 2>& lengths);

// It ends where it begins, in the same direction.
bool is_closed_smoothly(const Curve& curve);

}  // namespace lekalo::geometry
