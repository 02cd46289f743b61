// Where a band runs out into the faces at the end of its edge: it is cut by them, and cuts the edges between.
#include <fmt/format.h>

#include <cmath>

#include "geometry/bodies/blends/band_meetings.h"
#include "geometry/bodies/blends/surgery.h"
#include "geometry/bodies/topology/entity_names.h"
#include "geometry/curves/splines/polynomial_approximation.h"

namespace lekalo::geometry {

namespace {

constexpr double kAgree = 1e-13;

// The end of a rib between two faces at the vertex.
struct Rib {
  HalfEdge half;
  BandOnCurve at;
  int vertex = -1;
};

double guess_on(const Body& body, const HalfEdge& half, const BlendBand& band, double s, double z) {
  const BlendBand::Local p = band.at(s, z);
  return first_approach(*body.edges[half.edge].curve, half.at_end, p.point, p.ds);
}

// The image on the end face of the rib's point.
Vec2 place_on(const Body& body, int face, const HalfEdge& half, double t) {
  for (const int c : body.edges[half.edge].coedges)
    if (face_of(body, c) == face) return Vec2(body.coedges[c].image->point(t));
  throw std::logic_error("an edge of a fan belongs to the faces beside it");
}

struct Crossing {
  CurvePtr curve;
  Curve2Ptr on_band, on_face;
};

// A section of the band, where the face is across it.
std::optional<Crossing> straight_crossing(const BlendBand& band, const Surface& face, const SurfacePtr& surface,
                                          double s, double from, double to, const std::function<Vec2(double)>& place,
                                          double size) {
  for (const double share : {0.25, 0.5, 0.75}) {
    const double z = from + share * (to - from);
    const Vec2 at = place(z);
    if (glm::length(face.point(at.x, at.y) - band.at(s, z).point) > kAgree * size) return std::nullopt;
  }
  const LineOnSurface line = line_between(band.surface(), band.place(s, from), band.place(s, to));
  const Curve2Ptr image = image_on(surface, line.curve, place(0.5 * (from + to)));
  if (!image) return std::nullopt;
  return Crossing{line.curve, line.image, image};
}

// The band's lines z = const against the face, between two ribs; the parameter runs from 0 to 1 with z from `from` to
// `to`.
Crossing crossing(const BlendBand& band, const SurfacePtr& face, const std::array<BandOnCurve, 2>& ends,
                  const std::array<Vec2, 2>& places, double size, int edge) {
  const double from = ends[0].z, to = ends[1].z;
  constexpr int kNodes = 32;
  std::vector<BandOnSurface> nodes(kNodes + 1);
  nodes[0] = {ends[0].s, places[0]};
  const auto z_at = [&](double x) { return from + x * (to - from); };
  for (int k = 1; k <= kNodes; ++k) {
    BandOnSurface near = nodes[k - 1];
    if (k > 1) near.s += nodes[k - 1].s - nodes[k - 2].s, near.place += nodes[k - 1].place - nodes[k - 2].place;
    const auto found = line_on_surface(band, z_at(static_cast<double>(k) / kNodes), *face, near);
    if (!found) throw BlendError(edge, "the blend does not meet the face at the end of the edge all across");
    nodes[k] = *found;
  }
  if (glm::length(face->point(nodes.back().place.x, nodes.back().place.y) - ends[1].point) > 1e-9 * size)
    throw BlendError(edge, "the blend leaves the face at the end of the edge");
  const auto at = [&](double x) {
    const int k = std::clamp(static_cast<int>(x * kNodes), 0, kNodes - 1);
    const double w = x * kNodes - k;
    const BandOnSurface near{nodes[k].s + w * (nodes[k + 1].s - nodes[k].s),
                             glm::mix(nodes[k].place, nodes[k + 1].place, w)};
    const auto found = line_on_surface(band, z_at(x), *face, near);
    return found ? *found : near;
  };
  if (std::abs(ends[0].s - ends[1].s) <= 1e-12 * band.range().width()) {
    const auto place = [&](double z) { return at((z - from) / (to - from)).place; };
    if (auto straight = straight_crossing(band, *face, face, ends[0].s, from, to, place, size)) return *straight;
  }
  const std::vector<Interval> whole{{0, 1}};
  const auto curve =
      polynomial_approximation([&](double x) { return band.at(at(x).s, z_at(x)).point; }, whole, kAgree * size);
  const Vec2 here = band.place(ends[0].s, from), there = band.place(ends[1].s, to);
  const double parameters = glm::length(here) + glm::length(there - here);
  const auto on_band = polynomial_approximation([&](double x) { return Vec3(band.place(at(x).s, z_at(x)), 0); }, whole,
                                                kAgree * parameters);
  const auto on_face = polynomial_approximation([&](double x) { return Vec3(at(x).place, 0); }, whole,
                                                kAgree * (glm::length(places[0]) + glm::length(places[1] - places[0])));
  if (!curve || !on_band || !on_face)
    throw BlendError(edge, "the blend does not cross the face at the end of the edge smoothly");
  return {curve, on_band, on_face};
}

}  // namespace

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
    const double t = guess_on(body, half, band, s, z);
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
