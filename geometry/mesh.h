// Triangle meshes: shared points, per-corner normals and parameters (Golovanov 2016, 8.6).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/vectors.h"

namespace lekalo::geometry {

// Triangles index points, and synchronously normals and parameters where those arrays are not empty. Across a crease
// two normals stand for one point, so normals have their own indices.
class Mesh {
 public:
  std::vector<Vec3> points;
  std::vector<Vec3> normals;     // unit
  std::vector<Vec2> parameters;  // (u, v) of the surface a vertex lies on, or texture coordinates
  struct Triangle {
    std::array<int32_t, 3> point;
    std::array<int32_t, 3> normal{-1, -1, -1};
    std::array<int32_t, 3> parameter{-1, -1, -1};
    int32_t face = 0;  // face of the body, or group of the file, that it belongs to
  };
  std::vector<Triangle> triangles;
};

using MeshPtr = std::shared_ptr<const Mesh>;

// Of the points that triangles use.
Box3 bounds(const Mesh& mesh);

// How triangles share their sides.
struct MeshSides {
  size_t count = 0;
  size_t free = 0;     // of one triangle
  size_t turned = 0;   // of two triangles, one of which is turned: both run the same way
  size_t crowded = 0;  // of more than two
  double length = 0;   // of all, each once
  bool closed() const { return free + turned + crowded == 0; }
};
MeshSides sides(const Mesh& mesh);

// Every side of a triangle is a side of exactly one other triangle, in the opposite direction: no cracks, no free
// borders, consistent orientation.
bool is_closed(const Mesh& mesh);

// Every triangle its own plane's normal.
void set_flat_normals(Mesh& mesh);

// Normals of corners as the mean of the meeting triangles' normals weighted by their angles (Thuerrner, Wuethrich
// 1998). Triangles that meet in a side at more than the crease angle (radians) do not share normals along it; pi: all
// do.
void set_smooth_normals(Mesh& mesh, double crease_angle = kPi);

// The mesh under an affine map; a negative determinant turns the triangles round so that outside stays outside.
Mesh transformed(const Mesh& mesh, const Affine& map);

}  // namespace lekalo::geometry
