// Lines of triangle meshes, as exact as the mesh: borders, creases and outlines along its sides (Golovanov 2016, 8.3),
// sections by planes, and where lines meet its triangles.
#pragma once

#include <vector>

#include "geometry/contour.h"
#include "geometry/mesh.h"
#include "geometry/queries/contours/plane_section.h"
#include "geometry/spatial/box_tree.h"

namespace lekalo::geometry {

enum class MeshLineKind {
  boundary,  // a side of one triangle
  sharp,   // where normals of the corners differ, or triangles meet at more than kCreaseAngle; sides of three and more
  smooth,  // other sides; within a plane those between faces
  silhouette  // smooth sides between a triangle that faces the viewer and one that does not
};

// Triangles that share their normals, as smooth shading has it, have an edge between them all the same if they meet at
// more than this: 30 degrees, radians.
inline constexpr double kCreaseAngle = kPi / 6;

struct MeshLine {
  MeshLineKind kind;
  CurvePtr curve;  // a polyline of sides that follow one another
};

// Points with the same coordinates are one. Sides of triangles in one plane are none. Silhouettes are smooth sides too.
std::vector<MeshLine> mesh_lines(const Mesh& mesh, const ViewOf& view);

// Where a plane goes through the triangles, as polylines with a corner at every side that they pass; sides in the plane
// are among them where a triangle lies below. The normal must not be zero.
std::vector<CurvePtr> plane_section(const Mesh& mesh, const Vec3& origin, const Vec3& normal);

// The triangles of a mesh, found by place.
class MeshTriangles {
 public:
  explicit MeshTriangles(MeshPtr mesh);
  const Box3& bounds() const { return bounds_; }
  // Adds t of all places in the interval where the line meets a triangle; twice at a common side.
  void add_crossings(const Line& line, const Interval& t, std::vector<double>& at) const;

 private:
  MeshPtr mesh_;
  Box3 bounds_;
  BoxTree tree_;
};

}  // namespace lekalo::geometry
