// Meshes of polygons that rules of subdivision refine, with sharp edges (Hoppe et al. 1994).
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "geometry/vectors.h"

namespace lekalo::geometry {

// Faces counterclockwise seen from outside. A sharp edge stays a crease, a corner where it is. Every edge has two faces
// or is sharp; those of a part that is cut out may have one.
struct PolygonMesh {
  std::vector<Vec3> points;
  std::vector<std::vector<int>> faces;
  std::set<std::pair<int, int>> sharp;  // of points, the smaller number first
  std::set<int> corners;

  static std::pair<int, int> edge(int a, int b) { return {std::min(a, b), std::max(a, b)}; }
};

// A mesh with what lies beside what.
class ConnectedMesh {
 public:
  explicit ConnectedMesh(PolygonMesh mesh);

  const PolygonMesh& mesh() const { return mesh_; }
  const Vec3& point(int i) const { return mesh_.points[static_cast<size_t>(i)]; }
  const std::vector<int>& face(int f) const { return mesh_.faces[static_cast<size_t>(f)]; }
  int corner(int f, int k) const;  // by number, counted round and round
  bool is_sharp(int a, int b) const { return mesh_.sharp.contains(PolygonMesh::edge(a, b)); }

  // The face that has the side from a to b, and the number of that side in it.
  struct Side {
    int face = -1, k = 0;
  };
  Side side(int a, int b) const;
  Side across(int f, int k) const { return side(corner(f, k + 1), corner(f, k)); }

  int sharp_edges_at(int v) const;
  // smooth: also the end of a single sharp edge; crease: between two of them; border: where faces were left out.
  enum class Rule { smooth, crease, corner, border };
  Rule rule_at(int v) const;
  const std::vector<int>& neighbours(int v) const { return neighbours_[static_cast<size_t>(v)]; }
  const std::vector<int>& faces_at(int v) const { return faces_at_[static_cast<size_t>(v)]; }
  // Those over sharp edges.
  std::vector<int> crease_neighbours(int v) const;

  // The faces that share a corner with one, which becomes face 0, its corners as they are.
  PolygonMesh around(int f) const;

 private:
  PolygonMesh mesh_;
  std::map<std::pair<int, int>, Side> sides_;
  std::vector<std::vector<int>> faces_at_, neighbours_;
};

// A mesh after one step of subdivision: the children of face f begin at first_child[f].
struct RefinedMesh {
  PolygonMesh mesh;
  std::vector<int> first_child;
};

}  // namespace lekalo::geometry
