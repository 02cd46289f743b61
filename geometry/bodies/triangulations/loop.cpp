// New points (Loop 1987): of an edge a b between the triangles a b c and b a d, (3 a + 3 b + c + d) / 8; of a vertex
// with n neighbours e, (1 - n B) v + B sum e,
//
//   B = (5/8 - (3/8 + cos(2 pi / n) / 4)^2) / n
//
// On sharp edges the middle, at a vertex between two of them (a + 6 v + b) / 8. In the limit a vertex comes to
// v + (sum e - n v) / (n + 3 / (8 B)), on a crease to (a + 4 v + b) / 6. Where each corner has six triangles a triangle
// is a quartic box spline of its corners and the nine points around them; its Bezier points are sums of those with
// whole and half twelfths (Lai 1992; Stam 1998). Beside a crease the points beyond it are a + b - c.
#include "geometry/bodies/triangulations/loop.h"

#include <algorithm>
#include <cmath>

namespace lekalo::geometry {

namespace {

using Rule = ConnectedMesh::Rule;

double vertex_weight(double n) {
  const double c = 3.0 / 8 + std::cos(2 * kPi / n) / 4;
  return (5.0 / 8 - c * c) / n;
}

Vec3 sum_of_neighbours(const ConnectedMesh& mesh, int v) {
  Vec3 sum(0);
  for (const int other : mesh.neighbours(v)) sum += mesh.point(other);
  return sum;
}

Vec3 new_vertex(const ConnectedMesh& mesh, int v) {
  const Vec3& p = mesh.point(v);
  const Rule rule = mesh.faces_at(v).empty() ? Rule::corner : mesh.rule_at(v);
  if (rule == Rule::crease) {
    const std::vector<int> ends = mesh.crease_neighbours(v);
    return (mesh.point(ends[0]) + 6.0 * p + mesh.point(ends[1])) / 8.0;
  }
  if (rule != Rule::smooth) return p;
  const auto n = static_cast<double>(mesh.neighbours(v).size());
  return p + vertex_weight(n) * (sum_of_neighbours(mesh, v) - n * p);
}

int opposite(const ConnectedMesh& mesh, const ConnectedMesh::Side& side) { return mesh.corner(side.face, side.k + 2); }

Vec3 new_edge_point(const ConnectedMesh& mesh, int a, int b) {
  const Vec3 ends = mesh.point(a) + mesh.point(b);
  const ConnectedMesh::Side one = mesh.side(a, b), other = mesh.side(b, a);
  if (mesh.is_sharp(a, b) || one.face < 0 || other.face < 0) return 0.5 * ends;
  return (3.0 * ends + mesh.point(opposite(mesh, one)) + mesh.point(opposite(mesh, other))) / 8.0;
}

// The vertices around a corner of a triangle, counterclockwise, as far as the next sharp edges.
struct Fan {
  std::vector<int> points;
  size_t next = 0;  // number of the triangle's next corner among them
  bool is_closed = false;
};

Fan fan_at(const ConnectedMesh& mesh, int face, int k) {
  const int v = mesh.corner(face, k), next = mesh.corner(face, k + 1);
  Fan fan{{next, mesh.corner(face, k + 2)}};
  while (!mesh.is_sharp(v, fan.points.back())) {
    const ConnectedMesh::Side side = mesh.side(v, fan.points.back());
    if (side.face < 0) return fan;
    const int other = opposite(mesh, side);
    fan.is_closed = other == next;
    if (fan.is_closed) return fan;
    fan.points.push_back(other);
  }
  while (!mesh.is_sharp(v, fan.points.front())) {
    const ConnectedMesh::Side side = mesh.side(fan.points.front(), v);
    if (side.face < 0) return fan;
    fan.points.insert(fan.points.begin(), opposite(mesh, side));
    ++fan.next;
  }
  return fan;
}

// The six points around a regular corner from the next one on, with those beyond a crease.
std::array<Vec3, 6> ring_at(const ConnectedMesh& mesh, int face, int k) {
  const Fan fan = fan_at(mesh, face, k);
  const Vec3& v = mesh.point(mesh.corner(face, k));
  std::vector<Vec3> points;
  for (const int p : fan.points) points.push_back(mesh.point(p));
  if (!fan.is_closed) {
    points.push_back(v + points[3] - points[2]);
    points.push_back(v + points[0] - points[1]);
  }
  std::array<Vec3, 6> ring;
  for (size_t i = 0; i < 6; ++i) ring[i] = points[(fan.next + i) % 6];
  return ring;
}

// Twelve times the share of a corner in the Bezier point with the index i at it and j, k at the others.
double share_of_corner(int i, int j, int k) {
  constexpr double kOnSide[] = {1, 2, 4, 6, 6};
  const int least = std::min(j, k);
  if (least == 0) return kOnSide[i];
  return i == 2 ? 5 : i == 1 ? 3 : least == 1 ? 1.5 : 2;
}

// The same of the point beyond a side, i and j at the ends of the side, k at the corner opposite.
double share_beyond(int i, int j, int k) {
  constexpr double kOnSide[] = {1, 1.5, 2, 1.5, 1};
  return k == 0 ? kOnSide[i] : k == 1 && i + j == 3 ? 0.5 : 0;
}

void add_shares(TriangularNet& net, const Vec3& point, const std::array<int, 3>& order,
                double (*share)(int, int, int)) {
  size_t at = 0;
  each_index(4, [&](int i, int j, int k) {
    const int index[] = {i, j, k};
    net.points[at++] += Vec4(share(index[order[0]], index[order[1]], index[order[2]]) / 12 * point, 0);
  });
}

// The Bezier point with the index i at corner `a` and 4 - i at corner `b`.
Vec4& on_side(TriangularNet& net, int a, int b, int i) {
  int index[3] = {0, 0, 0};
  index[a] = i, index[b] = 4 - i;
  return net.points[static_cast<size_t>(net.index(index[0], index[1]))];
}

// Both sides at the corner go on to its limit, as cubics.
void end_in(TriangularNet& net, int corner, const Vec3& limit) {
  const Vec4 end(limit, 1);
  on_side(net, corner, (corner + 1) % 3, 4) = end;
  for (const int other : {(corner + 1) % 3, (corner + 2) % 3}) {
    const auto p = [&](int i) -> Vec4& { return on_side(net, corner, other, i); };
    p(3) = Vec4(Vec3(end + 6.0 * p(2) - 4.0 * p(1) + p(0)) / 4.0, 1);
  }
}

}  // namespace

RefinedMesh refined_by_loop(const ConnectedMesh& mesh) {
  RefinedMesh result;
  PolygonMesh& fine = result.mesh;
  const auto count = static_cast<int>(mesh.mesh().points.size());
  for (int v = 0; v < count; ++v) fine.points.push_back(new_vertex(mesh, v));
  fine.corners = mesh.mesh().corners;
  std::map<std::pair<int, int>, int> edge_points;
  const auto edge_point = [&](int a, int b) {
    const auto [place, is_new] = edge_points.try_emplace(PolygonMesh::edge(a, b), static_cast<int>(fine.points.size()));
    if (!is_new) return place->second;
    fine.points.push_back(new_edge_point(mesh, a, b));
    if (mesh.is_sharp(a, b))
      for (const int end : {a, b}) fine.sharp.insert(PolygonMesh::edge(end, place->second));
    return place->second;
  };
  for (const std::vector<int>& face : mesh.mesh().faces) {
    result.first_child.push_back(static_cast<int>(fine.faces.size()));
    const int ab = edge_point(face[0], face[1]), bc = edge_point(face[1], face[2]), ca = edge_point(face[2], face[0]);
    fine.faces.push_back({face[0], ab, ca});
    fine.faces.push_back({ab, face[1], bc});
    fine.faces.push_back({ca, bc, face[2]});
    fine.faces.push_back({bc, ca, ab});
  }
  return result;
}

Vec3 loop_limit(const ConnectedMesh& mesh, int v) {
  const Vec3& p = mesh.point(v);
  const Rule rule = mesh.rule_at(v);
  if (rule == Rule::crease) {
    const std::vector<int> ends = mesh.crease_neighbours(v);
    return (mesh.point(ends[0]) + 4.0 * p + mesh.point(ends[1])) / 6.0;
  }
  if (rule != Rule::smooth) return p;
  const auto n = static_cast<double>(mesh.neighbours(v).size());
  return p + (sum_of_neighbours(mesh, v) - n * p) / (n + 3 / (8 * vertex_weight(n)));
}

bool is_regular_for_loop(const ConnectedMesh& mesh, int v) {
  const int sharp = mesh.sharp_edges_at(v);
  if (mesh.mesh().corners.contains(v) || (sharp != 0 && sharp != 2)) return false;
  for (const int f : mesh.faces_at(v)) {
    const std::vector<int>& face = mesh.face(f);
    const auto k = static_cast<int>(std::find(face.begin(), face.end(), v) - face.begin());
    const Fan fan = fan_at(mesh, f, k);
    if (fan.is_closed != (sharp == 0) || fan.points.size() != (sharp == 0 ? 6 : 4)) return false;
  }
  return true;
}

TriangularNet loop_net(const ConnectedMesh& mesh, int face) {
  TriangularNet net{4, std::vector<Vec4>(TriangularNet::count(4), Vec4(0, 0, 0, 1))};
  const auto outer_share = [](int i, int j, int) { return i == 4 ? 1.0 : i == 3 && j == 1 ? 0.5 : 0.0; };
  std::vector<int> irregular;
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3, last = (k + 2) % 3, v = mesh.corner(face, k), w = mesh.corner(face, next);
    add_shares(net, mesh.point(v), {k, next, last}, share_of_corner);
    const Vec3 beyond = mesh.is_sharp(v, w) ? mesh.point(v) + mesh.point(w) - mesh.point(mesh.corner(face, last))
                                            : mesh.point(opposite(mesh, mesh.across(face, k)));
    add_shares(net, beyond, {k, next, last}, share_beyond);
    if (!is_regular_for_loop(mesh, v)) {
      irregular.push_back(k);
      continue;
    }
    const std::array<Vec3, 6> ring = ring_at(mesh, face, k);
    add_shares(net, ring[3], {k, last, next}, outer_share);
    add_shares(net, ring[4], {k, next, last}, outer_share);
  }
  for (const int k : irregular) end_in(net, k, loop_limit(mesh, mesh.corner(face, k)));
  return net;
}

}  // namespace lekalo::geometry
