// Bodies under affine maps: geometry is mapped, parameter curves stay as they are.
#include <algorithm>
#include <cmath>

#include "geometry/body.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

Body transformed(const Body& body, const Affine& map) {
  if (map.is_identity()) return body;
  Body result = body;
  // The longest that a unit vector can become bounds how far tolerances grow: at most the Frobenius norm.
  double growth = 0;
  for (int k = 0; k < 3; ++k) growth += glm::dot(map.linear[k], map.linear[k]);
  growth = std::sqrt(growth);
  for (Vertex& vertex : result.vertices) {
    vertex.point = map.point(vertex.point);
    vertex.tolerance *= growth;
  }
  for (Edge& edge : result.edges) {
    edge.curve = transformed(edge.curve, map);
    edge.tolerance *= growth;
  }
  const bool mirrored = map.determinant() < 0;
  for (Face& face : result.faces) {
    face.surface = transformed(face.surface, map);
    // In a mirror r_u x r_v turns inward, and a loop with the face on its left gets it on its right.
    if (mirrored) face.forward = !face.forward;
  }
  if (mirrored) {
    for (Loop& loop : result.loops) std::reverse(loop.coedges.begin(), loop.coedges.end());
    for (Coedge& coedge : result.coedges) coedge.forward = !coedge.forward;
  }
  return result;
}

}  // namespace lekalo::geometry
