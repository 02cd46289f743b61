#include "geometry/bodies/topology/edge_selection.h"

#include <fmt/format.h>

#include <array>

#include "geometry/bodies/topology/entity_names.h"
#include "geometry/bodies/topology/selection.h"

namespace lekalo::geometry {

namespace {

constexpr double kSmooth = 1e-6;  // sine between normals
}  // namespace

bool is_sharp(const Body& body, int edge) {
  const Edge& e = body.edges[edge];
  if (e.kind != EdgeKind::regular || e.coedges.size() != 2) return false;
  const Interval t = e.curve->domain();
  for (const double share : {0.13, 0.5, 0.87}) {
    std::array<Vec3, 2> normals;
    for (int k = 0; k < 2; ++k) {
      const Vec2 at(body.coedges[e.coedges[k]].image->point(t.lo + share * t.width()));
      normals[k] = body.normal(face_of(body, e.coedges[k]), at.x, at.y);
    }
    if (glm::length(normals[0] - normals[1]) > kSmooth) return true;
  }
  return false;
}

FieldType edge_selector() {
  return group(
      {{"between", texts().count(2, 2), "names of two faces, or families of faces, that meet in them", false, {}},
       {"of_face", text(), "the face, or family of faces, to which they belong", false, {}},
       {"parallel", direction(), "their direction", false, {}},
       {"named", texts(), "their own names", false, {}}});
}

std::vector<int> selected_edges(const Body& body, const Fields& fields) {
  Selector selector;
  const auto texts_of = [&](const char* field) {
    return fields.has(field) ? fields.get<std::vector<std::string>>(field) : std::vector<std::string>();
  };
  selector.names = texts_of("named");
  selector.between = texts_of("between");
  if (fields.has("of_face")) selector.of_face = {fields.text("of_face")};
  if (fields.has("parallel")) selector.parallel = fields.vec3("parallel");
  std::vector<int> edges;
  try {
    edges = select(body, Element::edge, selector);
  } catch (const FieldError& error) {
    throw FieldError("edges", error.what(), error.hint);
  }
  std::erase_if(edges, [&](int e) { return !is_sharp(body, e); });
  if (!edges.empty()) return edges;
  if (!selector.between.empty())
    throw FieldError("edges",
                     fmt::format("no sharp edge is between '{}' and '{}'", selector.between[0], selector.between[1]),
                     "faces that meet in one, or are there blends already?");
  throw FieldError("edges", "no sharp edge of the body is meant", "`lekalo measure --topology` lists its edges");
}

}  // namespace lekalo::geometry
