// Triangles laid out for rays: what a hit needs of a vertex lies in one cache line, so that a hit of a large mesh waits
// for four lines of memory and not for a dozen.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/mesh.h"

namespace lekalo::render {

// A point with one normal and one pair of parameters; where triangles of the Mesh meet in a point with other normals or
// parameters there are several. Zero stands for a normal or for parameters that the Mesh does not have.
struct alignas(64) PackedVertex {
  geometry::Vec3 point{0};
  geometry::Vec3 normal{0};
  geometry::Vec2 parameter{0};
};

struct PackedTriangle {
  uint32_t vertex[3];
  int32_t face;  // Mesh::Triangle::face
};

// The triangles of a Mesh in its order, with the vertices that they use.
struct PackedMesh {
  std::vector<PackedVertex> vertices;
  std::vector<PackedTriangle> triangles;

  explicit PackedMesh(const geometry::Mesh& mesh);
  geometry::Box3 bounds() const;
  // Across a triangle, to the side from which it runs counterclockwise; not of length 1.
  geometry::Vec3 outward(int triangle) const;
  size_t memory() const { return vertices.size() * sizeof(PackedVertex) + triangles.size() * sizeof(PackedTriangle); }
};

using PackedMeshPtr = std::shared_ptr<const PackedMesh>;

}  // namespace lekalo::render
