// Triangles between measured points of a surface in space.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/tessellation/triangulation.h"

namespace lekalo::geometry {

struct CloudOptions {
  double longest = kInfinity;  // edge
  int largest_hole = 8;        // with so many sides holes are closed, 3 at least
};

// The greedy triangulation of a surface: edges by increasing length, each kept that crosses none kept before in the
// plane of the normals there; around each point they are in order, and faces are what they enclose. So the triangles
// make an oriented surface, closed or with borders: faces with more sides than holes have that are closed. Throws
// std::invalid_argument, with a place, where the points do not make one.
std::vector<IndexTriangle> triangulation_of_cloud(std::span<const Vec3> points, const CloudOptions& options = {});

}  // namespace lekalo::geometry
