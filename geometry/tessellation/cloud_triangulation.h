// Triangles between measured points of a surface in space.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/tessellation/triangulation.h"

namespace lekalo::geometry {

struct CloudOptions {
  int neighbours = 16;         // edges join points each of which is among so many nearest ones of the other
  double longest = kInfinity;  // edge
  int largest_hole = 8;        // with so many sides holes are closed
};

struct CloudTriangulation {
  std::vector<Vec3> normals;  // unit, of the points
  std::vector<IndexTriangle> triangles;
};

// The greedy triangulation of a surface: edges by increasing length, each kept that crosses none kept before in the
// plane of the normals there; around each point they are in order, and faces are what they enclose. So the triangles
// make an oriented surface, closed or with borders: faces with more sides than holes have that are closed. Throws
// std::invalid_argument, with a place, where the points do not make one.
CloudTriangulation triangulation_of_cloud(std::span<const Vec3> points, const CloudOptions& options = {});

}  // namespace lekalo::geometry
