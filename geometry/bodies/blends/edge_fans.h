// Edges and faces around a vertex of a body, in order.
#pragma once

#include <vector>

#include "geometry/body.h"

namespace lekalo::geometry {

// One end of an edge.
struct HalfEdge {
  int edge = -1;
  bool at_end = false;
  auto operator<=>(const HalfEdge&) const = default;
};

// Counterclockwise seen from outside, from one half-edge on: faces[i] lies between edges[i] and the next, where its
// loop arrives along the next and leaves along edges[i]. Pole edges are left out.
struct Fan {
  int vertex = -1;
  std::vector<HalfEdge> edges;
  std::vector<int> faces;
  size_t next(size_t i) const { return (i + 1) % edges.size(); }
  size_t before(size_t i) const { return (i + edges.size() - 1) % edges.size(); }
};

// Empty where the faces around the vertex are not all of a closed fan.
Fan fan_from(const Body& body, const HalfEdge& first);

int vertex_of(const Body& body, const HalfEdge& half);
// Unit, away from the vertex.
Vec3 direction_of(const Body& body, const HalfEdge& half);
double parameter_of(const Body& body, const HalfEdge& half);

}  // namespace lekalo::geometry
