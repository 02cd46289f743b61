#include "geometry/bodies/blends/edge_fans.h"

#include <algorithm>

namespace lekalo::geometry {

namespace {

HalfEdge leaving(const Coedge& coedge) { return {coedge.edge, !coedge.forward}; }
HalfEdge arriving(const Coedge& coedge) { return {coedge.edge, coedge.forward}; }

// The coedge that leaves the vertex along a half-edge.
int coedge_along(const Body& body, const HalfEdge& half) {
  for (const int c : body.edges[half.edge].coedges)
    if (leaving(body.coedges[c]) == half) return c;
  return -1;
}

int coedge_before(const Body& body, int coedge) {
  const std::vector<int>& loop = body.loops[body.coedges[coedge].loop].coedges;
  const size_t at = static_cast<size_t>(std::find(loop.begin(), loop.end(), coedge) - loop.begin());
  return loop[(at + loop.size() - 1) % loop.size()];
}

}  // namespace

Fan fan_from(const Body& body, const HalfEdge& first) {
  Fan fan;
  fan.vertex = vertex_of(body, first);
  HalfEdge half = first;
  do {
    const int out = coedge_along(body, half);
    if (out < 0 || fan.edges.size() > body.edges.size() * 2) return {};
    int in = coedge_before(body, out);
    while (in != out && body.edges[body.coedges[in].edge].kind == EdgeKind::pole) in = coedge_before(body, in);
    fan.edges.push_back(half);
    fan.faces.push_back(body.loops[body.coedges[out].loop].face);
    half = arriving(body.coedges[in]);
  } while (half != first);
  return fan;
}

int vertex_of(const Body& body, const HalfEdge& half) {
  const Edge& edge = body.edges[half.edge];
  return half.at_end ? edge.end : edge.start;
}

double parameter_of(const Body& body, const HalfEdge& half) {
  const Interval t = body.edges[half.edge].curve->domain();
  return half.at_end ? t.hi : t.lo;
}

Vec3 direction_of(const Body& body, const HalfEdge& half) {
  const Vec3 d = body.edges[half.edge].curve->evaluate(parameter_of(body, half), 1).d[1];
  return (half.at_end ? -1.0 : 1.0) * glm::normalize(d);
}

}  // namespace lekalo::geometry
