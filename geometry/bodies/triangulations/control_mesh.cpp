#include "geometry/bodies/triangulations/control_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lekalo::geometry {

namespace {

void add_faces(const Fields& f, PolygonMesh& mesh) {
  const auto count = static_cast<int>(mesh.points.size());
  const auto& faces = f.indices("faces");
  std::map<std::pair<int, int>, size_t> sides;
  for (size_t k = 0; k < faces.size(); ++k) {
    const std::vector<int>& corners = faces[k];
    if (corners.size() < 3)
      throw FieldError("faces", fmt::format("face {} has {} corners: three are needed at least", k, corners.size()));
    for (size_t i = 0; i < corners.size(); ++i) {
      const int a = corners[i], b = corners[(i + 1) % corners.size()];
      if (a < 0 || a >= count)
        throw FieldError("faces", fmt::format("face {} names point {}; there are points 0 to {}", k, a, count - 1));
      if (std::count(corners.begin(), corners.end(), a) > 1)
        throw FieldError("faces", fmt::format("face {} has the point {} twice", k, a));
      if (const auto [place, is_new] = sides.try_emplace({a, b}, k); !is_new)
        throw FieldError("faces", fmt::format("faces {} and {} both run from point {} to {}", place->second, k, a, b),
                         "all faces counterclockwise seen from one side, and two at an edge");
    }
    mesh.faces.push_back(corners);
  }
  for (const auto& [side, face] : sides)
    if (!sides.contains({side.second, side.first})) mesh.sharp.insert(PolygonMesh::edge(side.first, side.second));
}

void add_creases(const Fields& f, PolygonMesh& mesh) {
  std::set<std::pair<int, int>> edges;
  for (const std::vector<int>& face : mesh.faces)
    for (size_t i = 0; i < face.size(); ++i) edges.insert(PolygonMesh::edge(face[i], face[(i + 1) % face.size()]));
  if (f.has("creases"))
    for (const std::vector<int>& chain : f.indices("creases"))
      for (size_t i = 0; i + 1 < chain.size(); ++i) {
        const auto edge = PolygonMesh::edge(chain[i], chain[i + 1]);
        if (!edges.contains(edge))
          throw FieldError("creases", fmt::format("there is no edge from point {} to {}", chain[i], chain[i + 1]),
                           "chains of points along edges of the faces");
        mesh.sharp.insert(edge);
      }
  if (f.has("corners"))
    for (const double corner : f.numbers("corners")) {
      if (corner != std::floor(corner) || corner < 0 || corner >= static_cast<double>(mesh.points.size()))
        throw FieldError("corners", fmt::format("there is no point {:g}", corner));
      mesh.corners.insert(static_cast<int>(corner));
    }
  // Where one face alone stands between two sharp edges the border keeps its corner.
  std::map<int, int> faces_at;
  for (const std::vector<int>& face : mesh.faces)
    for (const int v : face) ++faces_at[v];
  for (const auto& [v, count] : faces_at)
    if (count == 1) mesh.corners.insert(v);
}

}  // namespace

PolygonMesh control_mesh(const Fields& f) {
  PolygonMesh mesh;
  mesh.points = f.points("points");
  add_faces(f, mesh);
  add_creases(f, mesh);
  return mesh;
}

}  // namespace lekalo::geometry
