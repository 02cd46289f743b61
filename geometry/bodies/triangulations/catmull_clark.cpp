// New points (Catmull, Clark 1978): of a face the mean f of its corners; of an edge (a + b + f1 + f2) / 4; of a vertex
// of valence n, Q / n + 2 R / n + (n - 3) v / n with the means Q of the face points and R of the middles of the edges.
// On sharp edges the middle, at a vertex between two of them (a + 6 v + b) / 8. In the limit a vertex comes to (n^2 v +
// 4 sum e + sum f) / (n (n + 5)), e its neighbours, f the corners opposite in its faces (Halstead et al. 1993), on a
// crease to (a + 4 v + b) / 6.
#include "geometry/bodies/triangulations/catmull_clark.h"

#include <algorithm>

namespace lekalo::geometry {

Vec3 catmull_clark_limit(const ConnectedMesh& mesh, int v) {
  using Rule = ConnectedMesh::Rule;
  const Vec3& p = mesh.point(v);
  switch (mesh.rule_at(v)) {
    case Rule::crease: {
      const std::vector<int> ends = mesh.crease_neighbours(v);
      return (mesh.point(ends[0]) + 4.0 * p + mesh.point(ends[1])) / 6.0;
    }
    case Rule::smooth:
      break;
    default:
      return p;
  }
  const double n = static_cast<double>(mesh.faces_at(v).size());
  Vec3 sum = n * n * p;
  for (const int other : mesh.neighbours(v)) sum += 4.0 * mesh.point(other);
  for (const int f : mesh.faces_at(v))
    for (int k = 0; k < 4; ++k)
      if (mesh.corner(f, k) == v) sum += mesh.point(mesh.corner(f, k + 2));
  return sum / (n * (n + 5));
}

RefinedMesh refined_by_catmull_clark(const ConnectedMesh& mesh) {
  using Rule = ConnectedMesh::Rule;
  RefinedMesh result;
  PolygonMesh& fine = result.mesh;
  const auto count = static_cast<int>(mesh.mesh().points.size());
  fine.points.resize(mesh.mesh().points.size());
  std::vector<int> face_points;
  for (const std::vector<int>& corners : mesh.mesh().faces) {
    Vec3 sum(0);
    for (const int v : corners) sum += mesh.point(v);
    face_points.push_back(static_cast<int>(fine.points.size()));
    fine.points.push_back(sum / static_cast<double>(corners.size()));
  }
  std::map<std::pair<int, int>, int> edge_points;
  const auto edge_point = [&](int a, int b) {
    const auto [place, is_new] = edge_points.try_emplace(PolygonMesh::edge(a, b), static_cast<int>(fine.points.size()));
    if (!is_new) return place->second;
    Vec3 p = 0.5 * (mesh.point(a) + mesh.point(b));
    const ConnectedMesh::Side one = mesh.side(a, b), other = mesh.side(b, a);
    if (mesh.is_sharp(a, b)) {
      fine.sharp.insert(PolygonMesh::edge(a, place->second));
      fine.sharp.insert(PolygonMesh::edge(b, place->second));
    } else if (one.face >= 0 && other.face >= 0) {
      const auto of = [&](const ConnectedMesh::Side& s) {
        return fine.points[static_cast<size_t>(face_points[static_cast<size_t>(s.face)])];
      };
      p = 0.5 * p + 0.25 * (of(one) + of(other));
    }
    fine.points.push_back(p);
    return place->second;
  };
  for (int f = 0; f < static_cast<int>(mesh.mesh().faces.size()); ++f) {
    const int n = static_cast<int>(mesh.face(f).size());
    result.first_child.push_back(static_cast<int>(fine.faces.size()));
    for (int k = 0; k < n; ++k) {
      const std::array<int, 4> child{mesh.corner(f, k), edge_point(mesh.corner(f, k), mesh.corner(f, k + 1)),
                                     face_points[static_cast<size_t>(f)],
                                     edge_point(mesh.corner(f, k - 1), mesh.corner(f, k))};
      std::vector<int> turned(4);
      for (int j = 0; j < 4; ++j) turned[static_cast<size_t>((k + j) % 4)] = child[static_cast<size_t>(j)];
      fine.faces.push_back(turned);
    }
  }
  fine.corners = mesh.mesh().corners;
  for (int v = 0; v < count; ++v) {
    const auto at = static_cast<size_t>(v);
    const Rule rule = mesh.faces_at(v).empty() ? Rule::corner : mesh.rule_at(v);
    if (rule == Rule::crease) {
      const std::vector<int> ends = mesh.crease_neighbours(v);
      fine.points[at] = (mesh.point(ends[0]) + 6.0 * mesh.point(v) + mesh.point(ends[1])) / 8.0;
    } else if (rule == Rule::smooth) {
      const auto n = static_cast<double>(mesh.faces_at(v).size());
      Vec3 q(0), r(0);
      for (const int f : mesh.faces_at(v)) q += fine.points[static_cast<size_t>(face_points[static_cast<size_t>(f)])];
      for (const int other : mesh.neighbours(v)) r += 0.5 * (mesh.point(v) + mesh.point(other));
      fine.points[at] = (q / n + 2.0 * r / n + (n - 3) * mesh.point(v)) / n;
    } else {
      fine.points[at] = mesh.point(v);
    }
  }
  return result;
}

PatchNet patch_net(const ConnectedMesh& mesh, int face) {
  constexpr int kAt[4][2] = {{1, 1}, {2, 1}, {2, 2}, {1, 2}}, kOut[4][2] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
  PatchNet net;
  const auto at = [&](int i, int j) -> Vec3& { return net.points[static_cast<size_t>(i * 4 + j)]; };
  // The corner k, moved over sides a and b (none: -1).
  const auto beyond = [&](int k, int a, int b = -1, int sign = 1) -> Vec3& {
    int i = kAt[k][0] + kOut[a][0], j = kAt[k][1] + kOut[a][1];
    if (b >= 0) i += sign * kOut[b][0], j += sign * kOut[b][1];
    return at(i, j);
  };
  const auto q = [&](int k) { return mesh.corner(face, k); };
  const auto sharp = [&](int k) { return mesh.is_sharp(q(k), q(k + 1)); };
  for (int k = 0; k < 4; ++k) at(kAt[k][0], kAt[k][1]) = mesh.point(q(k));
  for (int k = 0; k < 4; ++k) {
    const int next = (k + 1) % 4;
    if (sharp(k)) {
      beyond(k, k) = 2.0 * mesh.point(q(k)) - mesh.point(q(k - 1));
      beyond(next, k) = 2.0 * mesh.point(q(k + 1)) - mesh.point(q(k + 2));
    } else {
      const ConnectedMesh::Side other = mesh.across(face, k);
      beyond(k, k) = mesh.point(mesh.corner(other.face, other.k + 2));
      beyond(next, k) = mesh.point(mesh.corner(other.face, other.k + 3));
    }
  }
  for (int k = 0; k < 4; ++k) {
    const int v = q(k), before = (k + 3) % 4, count = mesh.sharp_edges_at(v);
    const bool is_corner = mesh.mesh().corners.contains(v) || count > 2;
    Vec3& diagonal = beyond(k, before, k);
    bool is_regular;
    if (sharp(k) || sharp(before)) {
      const int over = sharp(k) ? k : before, along = sharp(k) ? before : k;
      diagonal = 2.0 * beyond(k, along) - beyond(k, along, over, -1);
      if (sharp(k) && sharp(before)) {
        is_regular = is_corner;
      } else {
        // Two faces on this side of the crease: the edge beyond the one between them is sharp.
        const ConnectedMesh::Side other = mesh.across(face, along);
        const int far = along == k ? mesh.corner(other.face, other.k + 2) : mesh.corner(other.face, other.k - 1);
        is_regular = !is_corner && count == 2 && mesh.is_sharp(v, far);
      }
    } else {
      const ConnectedMesh::Side other = mesh.across(face, k);
      const ConnectedMesh::Side opposite = mesh.across(other.face, other.k + 1);
      // Once more around comes back over the side before.
      const bool closes =
          opposite.face >= 0 && mesh.across(opposite.face, opposite.k + 1).face == mesh.across(face, before).face;
      is_regular = count == 0 && !is_corner && closes && opposite.face != mesh.across(face, before).face;
      diagonal = is_regular ? mesh.point(mesh.corner(opposite.face, opposite.k + 3))
                            : beyond(k, k) + beyond(k, before) - mesh.point(v);
    }
    if (!is_regular) net.irregular.push_back(k);
  }
  return net;
}

}  // namespace lekalo::geometry
