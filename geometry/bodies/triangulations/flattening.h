// Parameters of triangulated sheets: mean value coordinates (Floater 2003).
#pragma once

#include <span>
#include <vector>

#include "geometry/tessellation/triangulation.h"

namespace lekalo::geometry {

// The points of the border of a sheet in order, the sheet on its left. Throws std::invalid_argument unless the
// triangles make one sheet without holes.
std::vector<int> border_of_sheet(std::span<const Vec3> points, const std::vector<IndexTriangle>& triangles);

// Parameters of all points where those of the border are given, in its order: each inner point is a mean of its
// neighbours. Where the border runs round a convex region no triangle is turned over.
std::vector<Vec2> flattened(std::span<const Vec3> points, const std::vector<IndexTriangle>& triangles,
                            const std::vector<int>& border, const std::vector<Vec2>& border_uv);

// The border at distances as in space round the unit circle, from (1, 0) on.
std::vector<Vec2> flattened_to_circle(std::span<const Vec3> points, const std::vector<IndexTriangle>& triangles);

// The same round the unit square, the corners at these places of the border; the first is (0, 0).
std::vector<Vec2> flattened_to_square(std::span<const Vec3> points, const std::vector<IndexTriangle>& triangles,
                                      const std::vector<int>& border, const std::array<size_t, 4>& corners);

}  // namespace lekalo::geometry
