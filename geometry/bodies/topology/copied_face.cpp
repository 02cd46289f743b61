#include "geometry/bodies/topology/copied_face.h"

#include "geometry/transformed.h"

namespace lekalo::geometry {

int copy_face(const Body& from, int face, const Affine& move, Body& into) {
  const Face& old_face = from.faces[face];
  std::vector<int> vertices(from.vertices.size(), -1), edges(from.edges.size(), -1);
  const auto vertex = [&](int v) {
    if (vertices[v] < 0) {
      vertices[v] = into.add_vertex(move.point(from.vertices[v].point), from.vertices[v].origin);
      into.vertices[vertices[v]].tolerance = from.vertices[v].tolerance;
    }
    return vertices[v];
  };
  const auto edge = [&](int e) {
    const Edge& old = from.edges[e];
    if (edges[e] >= 0) return edges[e];
    edges[e] = into.add_edge(transformed(old.curve, move), vertex(old.start), vertex(old.end), old.origin, old.kind);
    into.edges[edges[e]].tolerance = old.tolerance;
    return edges[e];
  };
  const int copy =
      into.add_face(transformed(old_face.surface, move), old_face.forward, old_face.origin, old_face.trimmed);
  for (const int loop : old_face.loops) {
    std::vector<Body::Use> uses;
    for (const int c : from.loops[loop].coedges)
      uses.push_back({edge(from.coedges[c].edge), from.coedges[c].forward, from.coedges[c].image});
    into.add_loop(copy, uses);
  }
  into.faces[copy].shell = static_cast<int>(into.shells.size());
  into.shells.push_back({{copy}, false});
  return copy;
}

Body face_alone(const Body& body, int face) {
  Body result;
  copy_face(body, face, Affine(), result);
  return result;
}

}  // namespace lekalo::geometry
