// Where a band runs out into the faces at the end of its edge: it is cut by them, and cuts the edges between.
#include <fmt/format.h>

#include <cmath>

#include "geometry/bodies/blends/crossing.h"
#include "geometry/bodies/blends/surgery.h"
#include "geometry/bodies/topology/entity_names.h"

namespace lekalo::geometry {

double start_on(const Body& body, const HalfEdge& half, const BlendBand& band, double s, double z) {
  const BlendBand::Local p = band.at(s, z);
  return first_approach(*body.edges[half.edge].curve, half.at_end, p.point, p.ds);
}

Vec2 place_on(const Body& body, int face, const HalfEdge& half, double t) {
  for (const int c : body.edges[half.edge].coedges)
    if (face_of(body, c) == face) return Vec2(body.coedges[c].image->point(t));
  throw std::logic_error("an edge of a fan belongs to the faces beside it");
}

int Surgery::vertex_at(const Vec3& point) {
  for (const int vertex : fixed_vertices)
    if (glm::length(draft.vertices[vertex].point - point) <= 1e-9 * size) return vertex;
  return draft.add_vertex(point);
}

void Surgery::end_border(const HalfEdge& half, int side, double at, int vertex) {
  EdgeBlend& one = blend(half);
  one.s[half.at_end][side] = at;
  one.vertices[half.at_end][side] = vertex;
}

void Surgery::trim(const HalfEdge& half, double t, int vertex, int by) {
  EdgeTrim& one = trims[half.edge];
  one.t[half.at_end] = t;
  one.vertices[half.at_end] = vertex;
  one.by = by;
}

namespace {

// The end of a rib between two faces at the vertex.
struct Rib {
  HalfEdge half;
  BandOnCurve at;
  int vertex = -1;
};

}  // namespace

void run_out(Surgery& surgery, const Fan& fan) {
  const Body& body = surgery.body;
  EdgeBlend& blend = surgery.blend(fan.edges[0]);
  const BlendBand& band = blend.band;
  const int edge = fan.edges[0].edge;
  if (fan.edges.size() < 3)
    throw BlendError(edge, "no face ends it: the edge that goes on from it is not blended", false);
  const double s = band.ends()[fan.edges[0].at_end];
  const int after = side_after(fan.edges[0]), before = side_before(fan.edges[0]);
  std::vector<Rib> ribs;
  for (size_t i = 1; i < fan.edges.size(); ++i) {
    const HalfEdge half = fan.edges[i];
    const bool is_first = i == 1, is_last = i + 1 == fan.edges.size();
    const Curve& curve = *body.edges[half.edge].curve;
    const double z = is_first ? after : is_last ? before : 0.5;
    const double t = start_on(body, half, band, s, z);
    const auto met = is_first || is_last ? border_on_curve(band, z, curve, s, t)
                                         : band_on_curve(band, curve, BandOnCurve{s, z, t, Vec3(0)});
    if (!met || met->z < -1e-12 || met->z > 1 + 1e-12)
      throw BlendError(edge, fmt::format("its blend does not meet the edge between {} and {} at its end",
                                         name_of_face(body, fan.faces[i - 1]), name_of_face(body, fan.faces[i])));
    ribs.push_back({half, *met, surgery.draft.add_vertex(met->point)});
    surgery.trim(half, met->t, ribs.back().vertex, edge);
  }
  surgery.end_border(fan.edges[0], after, ribs.front().at.s, ribs.front().vertex);
  surgery.end_border(fan.edges[0], before, ribs.back().at.s, ribs.back().vertex);
  // In the end face i the loop arrives along rib i + 1 and leaves along rib i.
  std::vector<Body::Use>& section = blend.sections[fan.edges[0].at_end];
  for (size_t i = 0; i + 1 < ribs.size(); ++i) {
    const int face = fan.faces[i + 1];
    const Rib &to = ribs[i], &from = ribs[i + 1];
    const std::array<Vec2, 2> places{place_on(body, face, from.half, from.at.t),
                                     place_on(body, face, to.half, to.at.t)};
    const Crossing cross = crossing(band, body.faces[face].surface, {from.at, to.at}, places, surgery.size, edge);
    const int made = surgery.draft.add_edge(cross.curve, from.vertex, to.vertex, surgery.origin(blend, "end"));
    surgery.corners[from.half] = {{made, true, cross.on_face}};
    // From the right (0) to the left (1) side.
    const bool is_rightward = after == 0;
    section.push_back({made, !is_rightward, cross.on_band});
  }
  if (after == 1) std::reverse(section.begin(), section.end());
}

}  // namespace lekalo::geometry
