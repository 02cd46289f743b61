// The entities of a body by the names that they got from its construction, and what holds them together.
#include <fmt/format.h>

#include <set>
#include <unordered_set>

#include "command.h"
#include "geometry/bodies/local/fillet_chains.h"
#include "geometry/bodies/topology/characteristics.h"
#include "geometry/bodies/topology/selection.h"
#include "geometry/body.h"
#include "geometry/queries/contours/analytic/elementary_surface.h"
#include "geometry/queries/differential/roundness.h"
#include "geometry/queries/quadrics/conic_of_curve.h"
#include "measure.h"

namespace lekalo::command {

namespace {

using geometry::Body;
using geometry::Mesh;
using geometry::Vec3;

ordered_json name_or_null(const geometry::Origin& origin) {
  const std::string text = origin.text();
  return text.empty() ? ordered_json(nullptr) : ordered_json(text);
}

const char* kind_name(geometry::EdgeKind kind) {
  return kind == geometry::EdgeKind::seam ? "seam" : kind == geometry::EdgeKind::pole ? "pole" : "regular";
}

// What a surface or a curve is, in a word.
const char* shape_of(const geometry::SurfacePtr& surface) {
  using Kind = geometry::CanonicalSurface::Kind;
  const auto known = geometry::elementary_surface(surface);
  if (!known) return surface->as_nurbs() ? "spline" : "surface";
  switch (known->kind) {
    case Kind::plane:
      return "plane";
    case Kind::cone:
      return known->widening == 0 ? "cylinder" : "cone";
    case Kind::ellipsoid:
      return known->scale() ? "sphere" : "ellipsoid";
    case Kind::torus:
      return "torus";
    case Kind::saddle:
      return "saddle";
    case Kind::paraboloid:
      return "paraboloid";
    default:
      return "hyperboloid";
  }
}

const char* shape_of(const geometry::Curve& curve) {
  constexpr int kSamples = 16;
  constexpr double kStraight = 1e-12;  // of the length
  const geometry::Interval t = curve.domain();
  const Vec3 begin = curve.point(t.lo), chord = curve.point(t.hi) - begin;
  bool straight = true;
  for (int k = 1; k < kSamples && straight; ++k) {
    const Vec3 off = curve.point(t.lo + t.width() * k / kSamples) - begin;
    straight = glm::length(glm::cross(off, chord)) <= kStraight * glm::dot(chord, chord);
  }
  if (straight && glm::dot(chord, chord) > 0) return "line";
  if (geometry::is_round(curve)) return "circle";
  if (const auto conic = geometry::conic_of(curve)) return geometry::name(conic->kind).data();
  return curve.as_nurbs() ? "spline" : "curve";
}

// The loops of a face, the outer one first: the uses of edges in their order, with the face on the left.
ordered_json coedges_of(const Body& body, const geometry::Face& face) {
  ordered_json loops = ordered_json::array();
  for (int loop : face.loops) {
    ordered_json uses = ordered_json::array();
    for (int coedge : body.loops[loop].coedges)
      uses.push_back({{"edge", body.coedges[coedge].edge}, {"forward", body.coedges[coedge].forward}});
    loops.push_back(std::move(uses));
  }
  return loops;
}

ordered_json faces_of(const Body& body) {
  ordered_json faces = ordered_json::array();
  for (size_t i = 0; i < body.faces.size(); ++i) {
    const geometry::Face& face = body.faces[i];
    std::set<int> edges;
    for (int loop : face.loops)
      for (int coedge : body.loops[loop].coedges) edges.insert(body.coedges[coedge].edge);
    faces.push_back({{"index", i},
                     {"name", name_or_null(face.origin)},
                     {"surface", shape_of(face.surface)},
                     {"shell", face.shell},
                     {"loops", face.loops.size()},
                     {"edges", edges},
                     {"forward", face.forward},
                     {"coedges", coedges_of(body, face)}});
  }
  return faces;
}

ordered_json edges_of(const Body& body) {
  ordered_json edges = ordered_json::array();
  for (size_t i = 0; i < body.edges.size(); ++i) {
    const geometry::Edge& edge = body.edges[i];
    std::set<int> faces;
    for (int coedge : edge.coedges) faces.insert(body.loops[body.coedges[coedge].loop].face);
    edges.push_back({{"index", i},
                     {"name", name_or_null(edge.origin)},
                     {"kind", kind_name(edge.kind)},
                     {"curve", edge.kind == geometry::EdgeKind::pole ? "point" : shape_of(*edge.curve)},
                     {"start", edge.start},
                     {"end", edge.end},
                     {"faces", faces},
                     {"tolerance", edge.tolerance}});
  }
  return edges;
}

// Of each connected part of the body's faces.
ordered_json characteristics_of(const Body& body) {
  ordered_json parts = ordered_json::array();
  for (const geometry::ShellCharacteristics& part : geometry::characteristics(body)) {
    ordered_json one{{"faces", part.faces},       {"edges", part.edges},
                     {"vertices", part.vertices}, {"loops", part.loops},
                     {"borders", part.borders},   {"euler_characteristic", part.euler_characteristic},
                     {"manifold", part.manifold}, {"orientable", part.orientable}};
    one["connectivity"] = part.manifold ? ordered_json(part.connectivity) : ordered_json(nullptr);
    one["genus"] = part.genus ? ordered_json(*part.genus) : ordered_json(nullptr);
    one["volume"] = part.volume ? ordered_json(*part.volume) : ordered_json(nullptr);
    one["kind"] = !part.volume ? "open" : *part.volume > 0 ? "outer" : "inner";
    if (part.borders == 0 && !part.volume) one["kind"] = "closed";
    parts.push_back(std::move(one));
  }
  return parts;
}

std::string name_of(const char* kind, int index, const geometry::Origin& origin) {
  const std::string text = origin.text();
  return text.empty() ? fmt::format("{} {}", kind, index) : text;
}

ordered_json non_manifold_of(const Body& body) {
  const geometry::NonManifold found = geometry::non_manifold_places(body);
  ordered_json out{{"edges", ordered_json::array()}, {"vertices", ordered_json::array()}};
  for (const int e : found.edges) out["edges"].push_back(name_of("edge", e, body.edges[e].origin));
  for (const int v : found.vertices) out["vertices"].push_back(name_of("vertex", v, body.vertices[v].origin));
  return out;
}

// Fillets by their shape, chain by chain.
ordered_json fillets_of(const Body& body) {
  ordered_json out = ordered_json::array();
  const auto names = [&](const std::vector<int>& faces) {
    ordered_json list = ordered_json::array();
    for (const int face : faces) list.push_back(geometry::name_of(body, geometry::Element::face, face));
    return list;
  };
  for (const geometry::FilletChain& chain : geometry::fillet_chains(body)) {
    ordered_json between = ordered_json::array();
    for (const auto& pair : chain.between) between.push_back(names({pair[0], pair[1]}));
    out.push_back({{"radius", chain.radius},
                   {"convex", chain.convex},
                   {"faces", names(chain.faces)},
                   {"corners", names(chain.corners)},
                   {"between", std::move(between)}});
  }
  return out;
}

ordered_json body_topology(const Body& body) {
  ordered_json out;
  const std::vector<geometry::Violation> violations = body.violations();
  out["valid"] = violations.empty();
  out["closed"] = body.is_closed();
  out["euler_characteristic"] = body.euler_characteristic();
  out["shells"] = body.shells.size();
  out["loops"] = body.loops.size();
  out["characteristics"] = characteristics_of(body);
  out["non_manifold"] = non_manifold_of(body);
  out["fillets"] = fillets_of(body);
  out["faces"] = faces_of(body);
  out["edges"] = edges_of(body);
  ordered_json vertices = ordered_json::array();
  for (size_t i = 0; i < body.vertices.size(); ++i) {
    const geometry::Vertex& vertex = body.vertices[i];
    vertices.push_back({{"index", i},
                        {"name", name_or_null(vertex.origin)},
                        {"point", to_json(vertex.point)},
                        {"tolerance", vertex.tolerance}});
  }
  out["vertices"] = std::move(vertices);
  out["violations"] = ordered_json::array();
  for (const geometry::Violation& violation : violations)
    out["violations"].push_back({{"condition", violation.condition}, {"entity", violation.entity}});
  return out;
}

ordered_json mesh_topology(const Mesh& mesh) {
  std::unordered_set<int32_t> points;
  for (const Mesh::Triangle& triangle : mesh.triangles) points.insert(triangle.point.begin(), triangle.point.end());
  const geometry::MeshSides sides = geometry::sides(mesh);
  ordered_json out;
  out["closed"] = sides.closed();
  out["euler_characteristic"] = static_cast<int64_t>(points.size()) - static_cast<int64_t>(sides.count) +
                                static_cast<int64_t>(mesh.triangles.size());
  out["points"] = points.size();
  out["sides"] = sides.count;
  put_open_sides(out, sides);
  out["triangles"] = mesh.triangles.size();
  out["length_of_sides"] = sides.length;
  return out;
}

std::string name_text(const ordered_json& entity) {
  return entity["name"].is_null() ? "-" : entity["name"].get<std::string>();
}

std::string numbers_text(const ordered_json& numbers) {
  std::string text;
  for (const auto& number : numbers) text += fmt::format("{}{}", text.empty() ? "" : " ", number.get<int>());
  return text;
}

std::string names_text(const ordered_json& names) {
  return fmt::format("{}", fmt::join(names.get<std::vector<std::string>>(), ", "));
}

char sign(const ordered_json& forward) { return forward.get<bool>() ? '+' : '-'; }

// "loop +0 +3 -1 -2, loop -4": the edges with the direction in which the loop runs along them.
std::string loops_text(const ordered_json& loops) {
  std::string text;
  for (const auto& loop : loops) {
    text += text.empty() ? "loop" : ", loop";
    for (const auto& use : loop) text += fmt::format(" {}{}", sign(use["forward"]), use["edge"].get<int>());
  }
  return text;
}

std::string counted(size_t number, const char* one, const char* many) {
  return fmt::format("{} {}", number, number == 1 ? one : many);
}

void print_characteristics(const ordered_json& part) {
  fmt::print("{} shell of {}, {}, {}, {}: H {}", part["kind"].get<std::string>(),
             counted(part["faces"], "face", "faces"), counted(part["edges"], "edge", "edges"),
             counted(part["vertices"], "vertex", "vertices"), counted(part["loops"], "loop", "loops"),
             part["euler_characteristic"].get<int>());
  if (!part["connectivity"].is_null()) fmt::print(", connectivity {}", part["connectivity"].get<int>());
  if (!part["genus"].is_null()) fmt::print(", genus {}", part["genus"].get<int>());
  if (part["borders"] > 0) fmt::print(", {}", counted(part["borders"], "border", "borders"));
  fmt::print("{}\n", part["orientable"].get<bool>() ? "" : ", one-sided");
}

}  // namespace

void put_open_sides(ordered_json& out, const geometry::MeshSides& sides) {
  out["free_sides"] = sides.free;
  out["turned_sides"] = sides.turned;
  out["crowded_sides"] = sides.crowded;
}

ordered_json topology(const std::string& name, const render::Entity& entity) {
  ordered_json out;
  out["name"] = name;
  if (const auto* body = std::get_if<geometry::BodyPtr>(&entity)) {
    out["kind"] = "body";
    out.update(body_topology(**body));
  } else if (const auto* mesh = std::get_if<geometry::MeshPtr>(&entity)) {
    out["kind"] = "mesh";
    out.update(mesh_topology(**mesh));
  } else {
    throw UsageError(fmt::format("'{}' is neither a body nor a mesh: it has no topology", name));
  }
  return out;
}

void print_topology(const ordered_json& found) {
  const bool is_body = found["kind"] == "body";
  fmt::print("{} '{}': {}{}\n", found["kind"].get<std::string>(), found["name"].get<std::string>(),
             found["closed"].get<bool>() ? "closed" : "not closed",
             !is_body                     ? ""
             : found["valid"].get<bool>() ? ", valid"
                                          : ", NOT VALID");
  fmt::print("Euler characteristic {}\n", found["euler_characteristic"].get<int>());
  if (!is_body) {
    fmt::print("{} points, {} sides, {} triangles\n", found["points"].get<size_t>(), found["sides"].get<size_t>(),
               found["triangles"].get<size_t>());
    if (!found["closed"].get<bool>())
      fmt::print("{} sides of one triangle, {} of two that are turned differently, {} of more than two\n",
                 found["free_sides"].get<size_t>(), found["turned_sides"].get<size_t>(),
                 found["crowded_sides"].get<size_t>());
    return;
  }
  for (const auto& violation : found["violations"])
    fmt::print("violated: {}: {}\n", violation["condition"].get<std::string>(), violation["entity"].get<std::string>());
  for (const auto& part : found["characteristics"]) print_characteristics(part);
  for (const char* kind : {"edges", "vertices"})
    for (const auto& place : found["non_manifold"][kind]) fmt::print("not manifold at {}\n", place.get<std::string>());
  for (const auto& chain : found["fillets"])
    fmt::print("{} fillet of radius {:.6g}: {}{}\n", chain["convex"].get<bool>() ? "convex" : "concave",
               chain["radius"].get<double>(), names_text(chain["faces"]),
               chain["corners"].empty() ? "" : ", corners " + names_text(chain["corners"]));
  fmt::print("{}, {}\n{}\n", counted(found["shells"], "shell", "shells"), counted(found["loops"], "loop", "loops"),
             counted(found["faces"].size(), "face", "faces"));
  for (const auto& face : found["faces"])
    fmt::print("  {:<3} {:<16} {:<9} {} {}\n", face["index"].get<int>(), name_text(face),
               face["surface"].get<std::string>(), sign(face["forward"]), loops_text(face["coedges"]));
  fmt::print("{}\n", counted(found["edges"].size(), "edge", "edges"));
  for (const auto& edge : found["edges"])
    fmt::print("  {:<3} {:<16} {:<8} {:<9} vertices {} {}, faces {}\n", edge["index"].get<int>(), name_text(edge),
               edge["kind"].get<std::string>(), edge["curve"].get<std::string>(), edge["start"].get<int>(),
               edge["end"].get<int>(), numbers_text(edge["faces"]));
  fmt::print("{}\n", counted(found["vertices"].size(), "vertex", "vertices"));
  for (const auto& vertex : found["vertices"]) {
    const auto& p = vertex["point"];
    fmt::print("  {:<3} {:<16} {}\n", vertex["index"].get<int>(), name_text(vertex), digits(Vec3(p[0], p[1], p[2])));
  }
}

}  // namespace lekalo::command
