#include "render/trace/packed_mesh.h"

#include <array>

namespace lekalo::render {

PackedMesh::PackedMesh(const geometry::Mesh& mesh) {
  // The vertices of one point are a chain: the first by point, the next of each.
  constexpr int kNone = -1;
  struct Known {
    std::array<int32_t, 2> attributes;  // of the normal and of the parameters
    int next;
  };
  std::vector<int> first(mesh.points.size(), kNone);
  std::vector<Known> known;
  const auto vertex = [&](const geometry::Mesh::Triangle& triangle, int corner) {
    const int32_t point = triangle.point[corner];
    const std::array<int32_t, 2> attributes{mesh.normals.empty() ? kNone : triangle.normal[corner],
                                            mesh.parameters.empty() ? kNone : triangle.parameter[corner]};
    for (int i = first[point]; i != kNone; i = known[i].next)
      if (known[i].attributes == attributes) return i;
    const int number = static_cast<int>(vertices.size());
    known.push_back({attributes, first[point]});
    first[point] = number;
    PackedVertex& made = vertices.emplace_back();
    made.point = mesh.points[point];
    if (attributes[0] >= 0) made.normal = mesh.normals[attributes[0]];
    if (attributes[1] >= 0) made.parameter = mesh.parameters[attributes[1]];
    return number;
  };
  vertices.reserve(mesh.points.size());
  triangles.reserve(mesh.triangles.size());
  for (const geometry::Mesh::Triangle& triangle : mesh.triangles) {
    PackedTriangle& packed = triangles.emplace_back();
    for (int corner = 0; corner < 3; ++corner) packed.vertex[corner] = static_cast<uint32_t>(vertex(triangle, corner));
    packed.face = triangle.face;
  }
}

geometry::Box3 PackedMesh::bounds() const {
  geometry::Box3 box;
  for (const PackedVertex& vertex : vertices) box.include(vertex.point);
  return box;
}

geometry::Vec3 PackedMesh::outward(int triangle) const {
  const auto& corner = triangles[static_cast<size_t>(triangle)].vertex;
  const geometry::Vec3& a = vertices[corner[0]].point;
  return glm::cross(vertices[corner[1]].point - a, vertices[corner[2]].point - a);
}

}  // namespace lekalo::render
