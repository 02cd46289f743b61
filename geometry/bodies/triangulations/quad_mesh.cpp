// New points (Catmull, Clark 1978): of a face the mean f of its corners; of an edge (a + b + f1 + f2) / 4; of a vertex
// of valence n, Q / n + 2 R / n + (n - 3) v / n with the means Q of the face points and R of the middles of the edges.
// On sharp edges the middle, at a vertex between two of them (a + 6 v + b) / 8. In the limit a vertex comes to (n^2 v +
// 4 sum e + sum f) / (n (n + 5)), e its neighbours, f the corners opposite in its faces (Halstead et al. 1993), on a
// crease to (a + 4 v + b) / 6.
#include "geometry/bodies/triangulations/quad_mesh.h"

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

Vec3 ConnectedMesh::limit(int v) const {
  const Vec3& p = point(v);
  switch (rule_at(v)) {
    case Rule::crease: {
      const std::vector<int> ends = crease_neighbours(v);
      return (point(ends[0]) + 4.0 * p + point(ends[1])) / 6.0;
    }
    case Rule::smooth:
      break;
    default:
      return p;
  }
  const double n = static_cast<double>(faces_at_[static_cast<size_t>(v)].size());
  Vec3 sum = n * n * p;
  for (const int other : neighbours_[static_cast<size_t>(v)]) sum += 4.0 * point(other);
  for (const int f : faces_at_[static_cast<size_t>(v)])
    for (int k = 0; k < 4; ++k)
      if (corner(f, k) == v) sum += point(corner(f, k + 2));
  return sum / (n * (n + 5));
}

ConnectedMesh::Refined ConnectedMesh::refined() const {
  Refined result;
  PolygonMesh& fine = result.mesh;
  const auto count = static_cast<int>(mesh_.points.size());
  fine.points.resize(mesh_.points.size());
  std::vector<int> face_points;
  for (const std::vector<int>& corners : mesh_.faces) {
    Vec3 sum(0);
    for (const int v : corners) sum += point(v);
    face_points.push_back(static_cast<int>(fine.points.size()));
    fine.points.push_back(sum / static_cast<double>(corners.size()));
  }
  std::map<std::pair<int, int>, int> edge_points;
  const auto edge_point = [&](int a, int b) {
    const auto [place, is_new] = edge_points.try_emplace(PolygonMesh::edge(a, b), static_cast<int>(fine.points.size()));
    if (!is_new) return place->second;
    Vec3 p = 0.5 * (point(a) + point(b));
    const Side one = side(a, b), other = side(b, a);
    if (is_sharp(a, b)) {
      fine.sharp.insert(PolygonMesh::edge(a, place->second));
      fine.sharp.insert(PolygonMesh::edge(b, place->second));
    } else if (one.face >= 0 && other.face >= 0) {
      const auto of = [&](const Side& s) {
        return fine.points[static_cast<size_t>(face_points[static_cast<size_t>(s.face)])];
      };
      p = 0.5 * p + 0.25 * (of(one) + of(other));
    }
    fine.points.push_back(p);
    return place->second;
  };
  for (int f = 0; f < static_cast<int>(mesh_.faces.size()); ++f) {
    const int n = static_cast<int>(face(f).size());
    result.first_child.push_back(static_cast<int>(fine.faces.size()));
    for (int k = 0; k < n; ++k) {
      const std::array<int, 4> child{corner(f, k), edge_point(corner(f, k), corner(f, k + 1)),
                                     face_points[static_cast<size_t>(f)], edge_point(corner(f, k - 1), corner(f, k))};
      std::vector<int> turned(4);
      for (int j = 0; j < 4; ++j) turned[static_cast<size_t>((k + j) % 4)] = child[static_cast<size_t>(j)];
      fine.faces.push_back(turned);
    }
  }
  fine.corners = mesh_.corners;
  for (int v = 0; v < count; ++v) {
    const auto at = static_cast<size_t>(v);
    const Rule rule = faces_at_[at].empty() ? Rule::corner : rule_at(v);
    if (rule == Rule::crease) {
      const std::vector<int> ends = crease_neighbours(v);
      fine.points[at] = (point(ends[0]) + 6.0 * point(v) + point(ends[1])) / 8.0;
    } else if (rule == Rule::smooth) {
      const auto n = static_cast<double>(faces_at_[at].size());
      Vec3 q(0), r(0);
      for (const int f : faces_at_[at]) q += fine.points[static_cast<size_t>(face_points[static_cast<size_t>(f)])];
      for (const int other : neighbours_[at]) r += 0.5 * (point(v) + point(other));
      fine.points[at] = (q / n + 2.0 * r / n + (n - 3) * point(v)) / n;
    } else {
      fine.points[at] = point(v);
    }
  }
  return result;
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
