// A body with voids (Golovanov 2016, 5.4): its outer shell, and the outer shells of other bodies turned inside out.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "geometry/body.h"
#include "geometry/describe.h"
#include "geometry/queries/closest/distance.h"
#include "geometry/queries/closest/position.h"
#include "geometry/queries/contours/body_contours.h"

namespace lekalo::geometry {

namespace {

void refuse(size_t number, const std::string& what, const Vec3& at) {
  throw FieldError("voids", fmt::format("void {} {} at ({:.6g}, {:.6g}, {:.6g})", number, what, at.x, at.y, at.z),
                   "voids lie inside of the body and apart from each other");
}

// Edges and vertices of one on the surface of the other. Seams are smooth places of faces.
void require_edges_apart(const Body& one, const Body& other, size_t number, const std::string& what) {
  for (const Vertex& vertex : one.vertices)
    if (position(vertex.point, other).where == Containment::on) refuse(number, what, vertex.point);
  for (const Edge& edge : one.edges) {
    if (edge.kind != EdgeKind::regular) continue;
    const Distance apart = distance(edge.curve.get(), &other, DistanceMinima::nearest);
    if (!(apart.distance > 0)) refuse(number, what, apart.minima.front().a.point);
  }
}

// Where the surfaces do not meet, one point of a shell tells where all of it lies.
void require_apart(const Body& void_body, size_t number, const Body& other, const std::string& what) {
  const BodyContours found = intersect(void_body, other);
  if (!found.branches.empty()) refuse(number, what, found.branches.front().parts.front().begin);
  if (!found.points.empty()) refuse(number, what, found.points.front().point);
  if (found.coincident) refuse(number, what, void_body.vertices.front().point);
  require_edges_apart(void_body, other, number, what);
  require_edges_apart(other, void_body, number, what);
}

void require(const Vec3& point, size_t number, const Body& other, Containment where, const std::string& what) {
  if (position(point, other).where != where) refuse(number, what, point);
}

const Vec3& point_of(const Body& body, const Shell& shell) {
  const Loop& loop = body.loops[body.faces[shell.faces.front()].loops.front()];
  return body.vertices[body.edges[body.coedges[loop.coedges.front()].edge].start].point;
}

void check_inside(const Body& void_body, size_t number, const Body& body) {
  const char* what = "is not inside of the body";
  require_apart(void_body, number, body, what);
  require(point_of(void_body, void_body.shells[0]), number, body, Containment::inside, what);
  // The body may have voids of its own.
  for (size_t s = 1; s < body.shells.size(); ++s)
    require(point_of(body, body.shells[s]), number, void_body, Containment::outside, "encloses a void of the body");
}

void check_apart(const Body& one, size_t number, const Body& other, size_t other_number) {
  const std::string what = fmt::format("runs into void {}", other_number);
  require_apart(one, number, other, what);
  require(point_of(one, one.shells[0]), number, other, Containment::outside, what);
  require(point_of(other, other.shells[0]), number, one, Containment::outside, what);
}

// The shells of another body, turned to look into it.
void add_turned(const Body& other, size_t number, Body& result) {
  const int first_vertex = static_cast<int>(result.vertices.size()), first_edge = static_cast<int>(result.edges.size()),
            first_shell = static_cast<int>(result.shells.size()), first_face = static_cast<int>(result.faces.size());
  const std::string feature = fmt::format("void.{}", number);
  const auto named = [&](Origin origin) {
    origin.feature = origin.feature.empty() ? feature : feature + "." + origin.feature;
    return origin;
  };
  for (const Vertex& v : other.vertices) {
    result.add_vertex(v.point, named(v.origin));
    result.vertices.back().tolerance = v.tolerance;
  }
  for (const Edge& e : other.edges) {
    result.add_edge(e.curve, first_vertex + e.start, first_vertex + e.end, named(e.origin), e.kind);
    result.edges.back().tolerance = e.tolerance;
  }
  for (const Face& face : other.faces) {
    const int copy = result.add_face(face.surface, !face.forward, named(face.origin), face.trimmed);
    result.faces[copy].shell = first_shell + face.shell;
    for (const int loop : face.loops) {
      std::vector<Body::Use> uses;
      for (const int c : other.loops[loop].coedges) {
        const Coedge& use = other.coedges[c];
        uses.push_back({first_edge + use.edge, !use.forward, use.image});
      }
      std::reverse(uses.begin(), uses.end());
      result.add_loop(copy, uses);
    }
  }
  for (Shell shell : other.shells) {
    for (int& face : shell.faces) face += first_face;
    result.shells.push_back(std::move(shell));
  }
}

Body hollowed(const Fields& f) {
  const Body& body = *f.body("of");
  if (!body.is_closed()) throw FieldError("of", "the body is open: it has no inside", "a closed body");
  std::vector<BodyPtr> voids;
  for (const std::any& one : f.references("voids")) voids.push_back(std::any_cast<BodyPtr>(one));
  for (size_t k = 0; k < voids.size(); ++k)
    if (!voids[k]->is_closed() || voids[k]->shells.size() != 1)
      throw FieldError("voids", fmt::format("void {} is not bounded by one closed shell", k), "a body without voids");
  Body result = body;
  for (size_t k = 0; k < voids.size(); ++k) {
    check_inside(*voids[k], k, body);
    for (size_t j = 0; j < k; ++j) check_apart(*voids[k], k, *voids[j], j);
    add_turned(*voids[k], k, result);
  }
  return result;
}

}  // namespace

TypeDeclaration hollow_body_type() {
  return declare(Category::body, "hollow_body",
                 "A body with voids inside: its shells, and those of the voids turned inside out. Faces of void k are "
                 "called void.k and their names in it.")
      .example("of: { type: box, size: [3, 3, 3] }, voids: { type: box, size: [1, 1, 1], corner: [1, 1, 1] }")
      .field("of", reference({Category::body}), "the body")
      .field("voids", references({Category::body}), "bodies of one shell each, inside of it and apart from each other")
      .built_by([](const Fields& f) -> BodyPtr { return std::make_shared<Body>(hollowed(f)); });
}

}  // namespace lekalo::geometry
