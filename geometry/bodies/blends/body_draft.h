// A body while its faces and edges are replaced: loops are lists of uses, and what no loop uses any more is left out of
// the body that is made of it.
#pragma once

#include "geometry/body.h"

namespace lekalo::geometry {

struct DraftFace {
  SurfacePtr surface;
  bool forward = true;
  bool trimmed = true;
  Origin origin;
  int shell = 0;
  std::vector<std::vector<Body::Use>> loops;  // the outer one first
};

struct BodyDraft {
  std::vector<Vertex> vertices;
  std::vector<Edge> edges;  // their coedges mean nothing
  std::vector<DraftFace> faces;
  std::vector<bool> closed_shells;

  explicit BodyDraft(const Body& body);

  int add_vertex(const Vec3& point, Origin origin = {});
  int add_edge(CurvePtr curve, int start, int end, Origin origin = {}, EdgeKind kind = EdgeKind::regular);

  // Faces keep their numbers but those without loops, edges and vertices that are used their order.
  // `edge_numbers`: the new number of each edge, -1 for those that are left out.
  Body body(std::vector<int>* edge_numbers = nullptr) const;
};

// A box about a curve, from some places: enclosures of polynomials are wide.
Box3 sampled_box(const Curve& curve);

// Makes loops anew of a face's uses that follow one another; the one that encloses most is the outer one. False where
// two uses leave one vertex.
bool chain_loops(const BodyDraft& draft, DraftFace& face);

// Lets a face's surface go on by its own law to its loops, a plane a little farther, so that lines near to an edge
// still meet it. False where there is no such law.
bool reaches_loops(DraftFace& face);

}  // namespace lekalo::geometry
