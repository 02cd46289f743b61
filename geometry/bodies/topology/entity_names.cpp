#include "geometry/bodies/topology/entity_names.h"

#include <fmt/format.h>

namespace lekalo::geometry {

std::string name_of_face(const Body& body, int face) {
  const std::string name = body.faces[face].origin.text();
  return name.empty() ? fmt::format("face {}", face) : name;
}

std::string name_of_edge(const Body& body, int edge) {
  std::string result;
  for (const int c : body.edges[edge].coedges)
    result += (result.empty() ? "" : " and ") + name_of_face(body, face_of(body, c));
  return fmt::format("edge {} between {}", edge, result);
}

}  // namespace lekalo::geometry
