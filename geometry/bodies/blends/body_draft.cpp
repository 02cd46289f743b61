#include "geometry/bodies/blends/body_draft.h"

namespace lekalo::geometry {

BodyDraft::BodyDraft(const Body& body) : vertices(body.vertices), edges(body.edges) {
  for (const Face& face : body.faces) {
    DraftFace draft{face.surface, face.forward, face.trimmed, face.origin, face.shell, {}};
    for (const int loop : face.loops) {
      draft.loops.emplace_back();
      for (const int c : body.loops[loop].coedges) {
        const Coedge& use = body.coedges[c];
        draft.loops.back().push_back({use.edge, use.forward, use.image});
      }
    }
    faces.push_back(std::move(draft));
  }
  for (const Shell& shell : body.shells) closed_shells.push_back(shell.closed);
}

int BodyDraft::add_vertex(const Vec3& point, Origin origin) {
  vertices.push_back({point, 0, std::move(origin)});
  return static_cast<int>(vertices.size()) - 1;
}

int BodyDraft::add_edge(CurvePtr curve, int start, int end, Origin origin, EdgeKind kind) {
  Edge edge;
  edge.curve = std::move(curve), edge.start = start, edge.end = end, edge.kind = kind, edge.origin = std::move(origin);
  edges.push_back(std::move(edge));
  return static_cast<int>(edges.size()) - 1;
}

Body BodyDraft::body(std::vector<int>* edge_numbers) const {
  Body result;
  std::vector<char> is_used(edges.size(), 0), has_edge(vertices.size(), 0);
  for (const DraftFace& face : faces)
    for (const auto& loop : face.loops)
      for (const Body::Use& use : loop) is_used[use.edge] = 1;
  for (size_t e = 0; e < edges.size(); ++e)
    if (is_used[e]) has_edge[edges[e].start] = has_edge[edges[e].end] = 1;
  std::vector<int> vertex(vertices.size(), -1), edge(edges.size(), -1);
  for (size_t v = 0; v < vertices.size(); ++v) {
    if (!has_edge[v]) continue;
    vertex[v] = result.add_vertex(vertices[v].point, vertices[v].origin);
    result.vertices.back().tolerance = vertices[v].tolerance;
  }
  for (size_t e = 0; e < edges.size(); ++e) {
    if (!is_used[e]) continue;
    const Edge& old = edges[e];
    edge[e] = result.add_edge(old.curve, vertex[old.start], vertex[old.end], old.origin, old.kind);
    result.edges.back().tolerance = old.tolerance;
  }
  if (edge_numbers) *edge_numbers = edge;
  for (const bool closed : closed_shells) result.shells.push_back({{}, closed});
  for (const DraftFace& face : faces) {
    if (face.loops.empty()) continue;
    const int f = result.add_face(face.surface, face.forward, face.origin, face.trimmed);
    result.faces[f].shell = face.shell;
    result.shells[face.shell].faces.push_back(f);
    for (const auto& loop : face.loops) {
      std::vector<Body::Use> uses;
      for (const Body::Use& use : loop) uses.push_back({edge[use.edge], use.forward, use.image});
      result.add_loop(f, uses);
    }
  }
  return result;
}

}  // namespace lekalo::geometry
