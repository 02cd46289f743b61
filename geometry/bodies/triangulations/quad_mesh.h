// Meshes of polygons that Catmull's and Clark's rules refine (Catmull, Clark 1978; sharp edges: Hoppe et al. 1994).
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
  // What a vertex becomes when faces are divided again and again; all faces around it have four corners. At the end of
  // a single sharp edge nearly so, the nearer the smaller the faces.
  Vec3 limit(int v) const;

  // Each face of n corners in n of four. Child k of face f is face first_child[f] + k; its corner k is that of f.
  struct Refined;
  Refined refined() const;
  // The faces that share a corner with one, which becomes face 0, its corners as they are.
  PolygonMesh around(int f) const;

 private:
  enum class Rule { smooth, crease, corner, border };
  Rule rule_at(int v) const;
  std::vector<int> crease_neighbours(int v) const;

  PolygonMesh mesh_;
  std::map<std::pair<int, int>, Side> sides_;
  std::vector<std::vector<int>> faces_at_, neighbours_;
};

struct ConnectedMesh::Refined {
  PolygonMesh mesh;
  std::vector<int> first_child;
};

// The control points of the bicubic B-spline patch that a face of four corners is in the limit; (i, j) at i * 4 + j,
// i from its corner 0 to corner 1. Where it is none, for the sake of one corner, the point beyond that corner means
// nothing.
struct PatchNet {
  std::array<Vec3, 16> points;
  std::vector<int> irregular;  // corners
};
PatchNet patch_net(const ConnectedMesh& mesh, int face);

}  // namespace lekalo::geometry
