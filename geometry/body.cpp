#include "geometry/body.h"

#include <algorithm>
#include <stdexcept>

namespace lekalo::geometry {

std::string Origin::text() const {
  std::string result = feature;
  const auto append = [&](const std::string& part) {
    if (!result.empty()) result.append(1, '.');
    result.append(part);
  };
  if (!role.empty()) append(role);
  if (index >= 0) append(std::to_string(index));
  return result;
}

int Body::add_vertex(const Vec3& point, Origin origin) {
  vertices.push_back({point, 0, std::move(origin)});
  return static_cast<int>(vertices.size()) - 1;
}

int Body::add_edge(CurvePtr curve, int start, int end, Origin origin, EdgeKind kind) {
  Edge edge;
  edge.curve = std::move(curve);
  edge.start = start;
  edge.end = end;
  edge.kind = kind;
  edge.origin = std::move(origin);
  edges.push_back(std::move(edge));
  return static_cast<int>(edges.size()) - 1;
}

int Body::add_face(SurfacePtr surface, bool forward, Origin origin, bool trimmed) {
  Face face;
  face.surface = std::move(surface);
  face.forward = forward;
  face.trimmed = trimmed;
  face.origin = std::move(origin);
  faces.push_back(std::move(face));
  return static_cast<int>(faces.size()) - 1;
}

int Body::add_loop(int face, const std::vector<Use>& uses) {
  const int index = static_cast<int>(loops.size());
  Loop loop;
  loop.face = face;
  for (const Use& use : uses) {
    const int coedge = static_cast<int>(coedges.size());
    coedges.push_back({use.edge, use.forward, index, use.image});
    edges.at(use.edge).coedges.push_back(coedge);
    loop.coedges.push_back(coedge);
  }
  loops.push_back(std::move(loop));
  faces.at(face).loops.push_back(index);
  return index;
}

void Body::close_shell(bool closed) {
  Shell shell;
  shell.closed = closed;
  for (size_t i = 0; i < faces.size(); ++i) {
    shell.faces.push_back(static_cast<int>(i));
    faces[i].shell = 0;
  }
  shells = {std::move(shell)};
}

bool Body::is_closed() const {
  if (faces.empty()) return false;
  return std::all_of(edges.begin(), edges.end(), [&](const Edge& edge) {
    if (edge.kind == EdgeKind::pole) return edge.coedges.size() == 1;
    return edge.coedges.size() == 2 && coedges[edge.coedges[0]].forward != coedges[edge.coedges[1]].forward;
  });
}

int Body::euler_characteristic() const {
  const auto real_edges =
      std::count_if(edges.begin(), edges.end(), [](const Edge& edge) { return edge.kind != EdgeKind::pole; });
  const int f = static_cast<int>(faces.size()), e = static_cast<int>(real_edges), v = static_cast<int>(vertices.size()),
            l = static_cast<int>(loops.size());
  return f - e + v + (f - l);
}

Vec3 Body::normal(int face, double u, double v) const {
  const Vec3 n = faces[face].surface->normal(u, v);
  return faces[face].forward ? n : -n;
}

namespace {

// The box of a face: of the part of its surface over the loops' rectangle, in small parts because enclosures of large
// ones are wide. A flat face lies in the hull of its edges, which the caller adds.
void include_face(const Body& body, const Face& face, Box3& box) {
  if (!face.trimmed) {
    box.include(bounds(*face.surface));
    return;
  }
  Box3 plane;
  for (int loop : face.loops)
    for (int coedge : body.loops[loop].coedges) plane.include(bounds(*body.coedges[coedge].image));
  if (plane.empty()) return;
  Rectangle all{{plane.lo.x, plane.hi.x}, {plane.lo.y, plane.hi.y}};
  // Boxes are a little wide.
  const Rectangle domain = face.surface->domain();
  const Periods periods = face.surface->periods();
  if (periods.u == 0) all.u = intersect(all.u, domain.u);
  if (periods.v == 0) all.v = intersect(all.v, domain.v);
  const SurfaceEnclosure whole = face.surface->enclose(all, 2);
  const auto vanishes = [](const Box3& b) { return b.lo == Vec3(0) && b.hi == Vec3(0); };
  if (vanishes(whole.d(2, 0)) && vanishes(whole.d(1, 1)) && vanishes(whole.d(0, 2))) return;
  constexpr int kParts = 8;
  for (int i = 0; i < kParts; ++i) {
    for (int j = 0; j < kParts; ++j) {
      const double du = all.u.width() / kParts, dv = all.v.width() / kParts;
      const Rectangle part{{all.u.lo + i * du, i + 1 == kParts ? all.u.hi : all.u.lo + (i + 1) * du},
                           {all.v.lo + j * dv, j + 1 == kParts ? all.v.hi : all.v.lo + (j + 1) * dv}};
      box.include(face.surface->enclose(part, 0).d(0, 0));
    }
  }
}

}  // namespace

Box3 bounds(const Body& body) {
  Box3 box;
  for (const Face& face : body.faces) include_face(body, face, box);
  for (const Edge& edge : body.edges)
    if (edge.kind != EdgeKind::pole) box.include(bounds(*edge.curve));
  for (const Vertex& vertex : body.vertices) box.include(vertex.point);
  return box;
}

Box3 bounds(const Body& body, int face) {
  Box3 box;
  include_face(body, body.faces[face], box);
  for (int loop : body.faces[face].loops)
    for (int coedge : body.loops[loop].coedges) box.include(bounds(*body.edges[body.coedges[coedge].edge].curve));
  return box;
}

}  // namespace lekalo::geometry
