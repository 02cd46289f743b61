// Creases and steps of surfaces that no parameter line tells of, and meshes that follow them.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "geometry/tessellation/tessellate.h"

namespace lekalo::geometry {

// Where a surface breaks along a segment of its parameter plane: its point (a step) or its normal (a crease) jumps.
struct SurfaceBreak {
  double at;  // part of the segment, 0 to 1
  bool step;
};

// The break that makes up at least a quarter of what point or normal change between the ends; steps first. The ends
// themselves count as they are seen from the segment.
std::optional<SurfaceBreak> find_break(const Surface& surface, const Vec2& from, const Vec2& to);

// The triangles of one surface in a mesh: its last ones, with parameters in its domain.
struct BrokenMesh {
  const Surface& surface;
  double sign;            // of the mesh's normals against the surface's
  size_t first = 0;       // of its triangles
  std::vector<int> over;  // those that breaks may pass
  // Sides between two mesh points that stay whole because others share them.
  std::function<bool(int32_t, int32_t)> is_fixed;
  // Mesh points that are poles: the coordinate that means nothing there, 0 u, 1 v.
  std::map<int32_t, int> poles;
};

// Splits triangles until those over breaks keep the sag as well: sides where the surface breaks on them, others in
// their middle; neighbours with them, so that no cracks open. Points on a crease have a normal for each side, points on
// a step a point, so that the mesh ends on both sides of it. Smooth triangles keep the angle too; across a crease no
// triangle is small enough for that, and the sag decides alone. Throws std::invalid_argument beyond kMaxTriangles.
void split_at_breaks(Mesh& mesh, const BrokenMesh& part, const TessellationTolerance& tolerance);

}  // namespace lekalo::geometry
