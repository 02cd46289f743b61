#include "geometry/bodies/triangulations/connected_mesh.h"

#include <algorithm>

namespace lekalo::geometry {

ConnectedMesh::ConnectedMesh(PolygonMesh mesh) : mesh_(std::move(mesh)) {
  faces_at_.resize(mesh_.points.size());
  neighbours_.resize(mesh_.points.size());
  for (int f = 0; f < static_cast<int>(mesh_.faces.size()); ++f) {
    const int n = static_cast<int>(face(f).size());
    for (int k = 0; k < n; ++k) {
      const int a = corner(f, k), b = corner(f, k + 1);
      sides_[{a, b}] = {f, k};
      faces_at_[static_cast<size_t>(a)].push_back(f);
      for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
        std::vector<int>& list = neighbours_[static_cast<size_t>(from)];
        if (std::find(list.begin(), list.end(), to) == list.end()) list.push_back(to);
      }
    }
  }
}

int ConnectedMesh::corner(int f, int k) const {
  const std::vector<int>& corners = face(f);
  const int n = static_cast<int>(corners.size());
  return corners[static_cast<size_t>(((k % n) + n) % n)];
}

ConnectedMesh::Side ConnectedMesh::side(int a, int b) const {
  const auto found = sides_.find({a, b});
  return found == sides_.end() ? Side{} : found->second;
}

std::vector<int> ConnectedMesh::crease_neighbours(int v) const {
  std::vector<int> result;
  for (const int other : neighbours_[static_cast<size_t>(v)])
    if (is_sharp(v, other)) result.push_back(other);
  return result;
}

int ConnectedMesh::sharp_edges_at(int v) const { return static_cast<int>(crease_neighbours(v).size()); }

ConnectedMesh::Rule ConnectedMesh::rule_at(int v) const {
  const int sharp = sharp_edges_at(v);
  if (mesh_.corners.contains(v) || sharp > 2) return Rule::corner;
  if (sharp == 2) return Rule::crease;
  for (const int other : neighbours_[static_cast<size_t>(v)])
    if (side(v, other).face < 0 || side(other, v).face < 0) return Rule::border;
  return Rule::smooth;
}

PolygonMesh ConnectedMesh::around(int f) const {
  PolygonMesh part;
  std::vector<int> faces{f};
  for (const int v : face(f))
    for (const int other : faces_at_[static_cast<size_t>(v)])
      if (std::find(faces.begin(), faces.end(), other) == faces.end()) faces.push_back(other);
  std::map<int, int> numbers;
  for (const int one : faces) {
    part.faces.emplace_back();
    for (const int v : face(one)) {
      const auto [place, is_new] = numbers.try_emplace(v, static_cast<int>(part.points.size()));
      if (is_new) part.points.push_back(point(v));
      part.faces.back().push_back(place->second);
      if (mesh_.corners.contains(v)) part.corners.insert(place->second);
    }
  }
  for (const int one : faces)
    for (int k = 0; k < static_cast<int>(face(one).size()); ++k) {
      const int a = corner(one, k), b = corner(one, k + 1);
      if (is_sharp(a, b)) part.sharp.insert(PolygonMesh::edge(numbers.at(a), numbers.at(b)));
    }
  // A vertex that has lost sharp edges with its faces keeps its rule.
  for (const auto& [v, number] : numbers)
    if (rule_at(v) == Rule::corner) part.corners.insert(number);
  return part;
}

}  // namespace lekalo::geometry
