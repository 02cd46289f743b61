// Where bands meet at a vertex: two that continue each other in a common section, all of a corner in a sphere
// (Golovanov 2016, 6.9: three equal radii at the corner of a box leave the octant of a ball).
#include <fmt/format.h>

#include <cmath>

#include "geometry/bodies/blends/band_meetings.h"
#include "geometry/bodies/blends/supports.h"
#include "geometry/bodies/blends/surgery.h"
#include "geometry/bodies/primitives/construct.h"
#include "geometry/bodies/topology/entity_names.h"
#include "geometry/queries/closest/closest_point.h"
#include "geometry/surfaces/analytic/sphere.h"

namespace lekalo::geometry {

namespace {

constexpr double kTogether = 1e-9;  // of the size

// One of the borders that follow each other from a corner on, seen from there.
struct BorderPart {
  HalfEdge half;
  int side;
};

// The blended edge that continues another at its other end.
std::optional<BorderPart> next_part(Surgery& surgery, const BorderPart& part) {
  const HalfEdge far{part.half.edge, !part.half.at_end};
  const Fan fan = fan_from(surgery.body, far);
  const size_t next = fan.edges.empty() ? 0 : continuation(surgery.body, fan);
  if (next == 0 || !surgery.is_blended(fan.edges[next])) return std::nullopt;
  const HalfEdge& half = fan.edges[next];
  return BorderPart{half, part.side == side_after(far) ? side_before(half) : side_after(half)};
}

// The borders up to where one crosses a smooth edge: the last one, at `met`.
struct WayToEdge {
  std::vector<BorderPart> parts;
  BandOnCurve met;
};
std::optional<WayToEdge> way_to(Surgery& surgery, const BorderPart& first, const HalfEdge& smooth, double near) {
  constexpr size_t kMaxParts = 4;
  const Curve& curve = *surgery.body.edges[smooth.edge].curve;
  WayToEdge way;
  for (std::optional<BorderPart> part = first; part && way.parts.size() < kMaxParts; part = next_part(surgery, *part)) {
    way.parts.push_back(*part);
    const BlendBand& band = surgery.blend(part->half).band;
    const double from = band.ends()[part->half.at_end], to = band.ends()[!part->half.at_end];
    const auto met = border_on_curve(band, part->side, curve, from, near);
    if (!met) continue;
    const double share = (met->s - from) / (to - from);
    if (share > 0 && share < 1) return WayToEdge{way.parts, *met};
  }
  return std::nullopt;
}

// The smooth edge i between two half-edges leaves the corner obliquely: `foot` is its place nearest to the section's
// point, and the border on that side of the section crosses it. Its faces must be of one surface: there is no other
// band beyond.
bool cross_smooth_edge(Surgery& surgery, const Fan& fan, size_t from, size_t i, size_t to, const Vec3& point,
                       double foot) {
  const HalfEdge &smooth = fan.edges[i], &leaving = fan.edges[from], &arriving = fan.edges[to];
  const BlendBand& band = surgery.blend(leaving).band;
  const Vec3 along = band.at(band.ends()[leaving.at_end], side_after(leaving)).ds * (leaving.at_end ? -1.0 : 1.0);
  const bool leaves = glm::dot(surgery.body.edges[smooth.edge].curve->point(foot) - point, along) > 0;
  const auto way = leaves ? way_to(surgery, {leaving, side_after(leaving)}, smooth, foot)
                          : way_to(surgery, {arriving, side_before(arriving)}, smooth, foot);
  if (!way) return false;
  const HalfEdge& beside = leaves ? arriving : leaving;
  Straddle straddle;
  straddle.after = leaves ? arriving : smooth;
  straddle.face = leaves ? fan.faces[i] : fan.faces[from];
  straddle.near = place_on(surgery.body, straddle.face, beside, parameter_of(surgery.body, beside));
  const int vertex = surgery.vertex_at(way->met.point);
  for (size_t k = 0; k < way->parts.size(); ++k) {
    const auto& [half, side] = way->parts[k];
    straddle.is_whole = k + 1 < way->parts.size();
    straddle.s = way->met.s, straddle.vertex = vertex;
    straddle.place = leaves ? static_cast<int>(k) : -static_cast<int>(k);
    surgery.blend(half).straddles[half.at_end][side] = straddle;
  }
  surgery.trim(smooth, way->met.t, vertex, leaving.edge);
  return true;
}

// The smooth edges between two half-edges of a fan end where the borders on either side of them do, or where one of
// these crosses them.
void trim_between(Surgery& surgery, const Fan& fan, size_t from, size_t to, const Vec3& point, int vertex) {
  for (size_t i = fan.next(from); i != to; i = fan.next(i)) {
    const HalfEdge half = fan.edges[i];
    const CurvePtr& curve = surgery.body.edges[half.edge].curve;
    const CurveProjector projector(curve);
    double best = kInfinity, t = 0;
    for (const auto& foot : projector.foot_points(point).foot_points)
      if (foot.distance < best) best = foot.distance, t = foot.t;
    if (best <= kTogether * surgery.size)
      surgery.trim(half, t, vertex, fan.edges[from].edge);
    else if (fan.next(fan.next(from)) != to || !cross_smooth_edge(surgery, fan, from, i, to, point, t))
      throw BlendError(fan.edges[from].edge, "its blend does not end on the smooth edge beside it");
  }
}

// One section as an edge from the right to the left side of a blend; the same seen from another.
int add_section(Surgery& surgery, const HalfEdge& half, double s) {
  EdgeBlend& one = surgery.blend(half);
  const LineOnSurface line = one.band.section(s, true);
  const std::array<int, 2>& ends = one.vertices[half.at_end];
  const int edge = surgery.draft.add_edge(line.curve, ends[0], ends[1], surgery.origin(one, "section"));
  one.sections[half.at_end] = {{edge, true, line.image}};
  return edge;
}

void share_section(Surgery& surgery, const HalfEdge& half, int edge, double s) {
  EdgeBlend& other = surgery.blend(half);
  const Edge& made = surgery.draft.edges[edge];
  const bool forward = made.start == other.vertices[half.at_end][0];
  if (other.band.is_closed()) surgery.draft.edges[edge].kind = EdgeKind::seam;
  const Curve2Ptr image = image_on(other.band.surface(), made.curve, other.band.place(s, 0.5));
  if (!image) throw BlendError(half.edge, "its blend does not end in the section of the next one");
  other.sections[half.at_end] = {{edge, forward, image}};
}

// Where the center of the ball is as far from a face as from those of its band, on the same side.
std::optional<double> center_beside(const Body& body, const EdgeBlend& blend, int face, double s) {
  const BlendBand& band = blend.band;
  const SurfacePtr support = support_of(body.faces[face].surface);
  const Coedge& coedge = body.coedges[body.loops[body.faces[face].loops[0]].coedges[0]];
  const Vec2 somewhere(coedge.image->point(coedge.image->domain().middle()));
  const Vec3 there = body.faces[face].surface->point(somewhere.x, somewhere.y);
  Vec2 near = foot_place_anywhere(support, there, somewhere);
  const double side =
      (glm::dot(support->normal(near.x, near.y), body.normal(face, somewhere.x, somewhere.y)) > 0) == blend.edge.convex
          ? -1
          : 1;
  const auto excess = [&](double at) {
    const Vec3 c = band.center(at);
    near = foot_place_anywhere(support, c, near);
    return side * glm::dot(c - support->point(near.x, near.y), support->normal(near.x, near.y)) - band.radius();
  };
  const double step = 1e-4 * band.range().width();
  // The secant method.
  double a = s, b = s + step, fa = excess(a), fb = excess(b);
  for (int i = 0; i < 60; ++i) {
    if (fb == fa) return std::nullopt;
    const double c = b - fb * (b - a) / (fb - fa);
    a = b, fa = fb, b = c, fb = excess(c);
    if (std::abs(b - a) <= 1e-15 * (std::abs(b) + band.range().width())) return b;
  }
  return std::abs(fb) < 1e-12 * band.radius() ? std::optional(b) : std::nullopt;
}

// A frame in which the directions stay away from the poles and the seam.
Frame frame_for(const Vec3& center, const std::vector<Vec3>& directions) {
  Vec3 middle(0);
  for (const Vec3& d : directions) middle += d;
  Frame best;
  double least = 2;
  constexpr int kTurns = 12;
  const Frame about = frame_about(center, glm::normalize(middle));
  for (int k = 0; k < kTurns; ++k) {
    const double angle = kPi * k / kTurns;
    const Vec3 z = std::cos(angle) * about.x + std::sin(angle) * about.y;
    double nearest = 0;
    for (const Vec3& d : directions) nearest = std::max(nearest, std::abs(glm::dot(d, z)));
    if (nearest < least) least = nearest, best = frame_from(center, z, -about.z);
  }
  return best;
}

}  // namespace

void join(Surgery& surgery, const Fan& fan, size_t other) {
  const HalfEdge &one = fan.edges[0], &two = fan.edges[other];
  const BlendBand &a = surgery.blend(one).band, &b = surgery.blend(two).band;
  const double s = a.ends()[one.at_end], t = b.ends()[two.at_end];
  const std::array<std::array<int, 2>, 2> sides{
      {{side_after(one), side_before(two)}, {side_before(one), side_after(two)}}};
  for (int k = 0; k < 2; ++k) {
    const auto [mine, its] = sides[k];
    const Vec3 p = a.at(s, mine).point;
    if (glm::length(p - b.at(t, its).point) > kTogether * surgery.size)
      throw BlendError(one.edge,
                       fmt::format("it goes on smoothly in {}, but their blends have no section in common",
                                   name_of_edge(surgery.body, two.edge)),
                       false);
    const int vertex = surgery.vertex_at(p);
    surgery.end_border(one, mine, s, vertex);
    surgery.end_border(two, its, t, vertex);
    if (k == 0)
      trim_between(surgery, fan, 0, other, p, vertex);
    else
      trim_between(surgery, fan, other, 0, p, vertex);
  }
  const int edge = add_section(surgery, one, s);
  share_section(surgery, two, edge, t);
}

void run_to_point(Surgery& surgery, const Fan& fan) {
  for (const HalfEdge& half : fan.edges) {
    if (!surgery.is_blended(half)) continue;
    EdgeBlend& one = surgery.blend(half);
    const double s = one.band.ends()[half.at_end];
    for (const int side : {0, 1}) {
      if (glm::length(one.band.at(s, side).point - surgery.body.vertices[fan.vertex].point) > kTogether * surgery.size)
        throw BlendError(half.edge, "it meets edges in a point, but its blend does not end there", false);
      surgery.end_border(half, side, s, fan.vertex);
    }
    const Vec3 point = surgery.body.vertices[fan.vertex].point;
    const int edge = surgery.draft.add_edge(point_curve({0, 1}, point), fan.vertex, fan.vertex,
                                            surgery.origin(one, "point"), EdgeKind::pole);
    one.sections[half.at_end] = {{edge, true, image_line({0, 1}, one.band.place(s, 0), one.band.place(s, 1))}};
  }
}

void round_corner(Surgery& surgery, const Fan& fan) {
  const size_t n = fan.edges.size();
  const EdgeBlend& first = surgery.blend(fan.edges[0]);
  const double radius = first.band.radius();
  // A face that the first band does not touch.
  const auto found = center_beside(surgery.body, first, fan.faces[1], first.band.ends()[fan.edges[0].at_end]);
  if (!found) throw BlendError(fan.edges[0].edge, "no ball touches all faces of the corner at its end");
  const Vec3 center = first.band.center(*found);
  std::vector<double> s(n);
  for (size_t i = 0; i < n; ++i) {
    const BlendBand& band = surgery.blend(fan.edges[i]).band;
    s[i] = band.section_at(center, band.ends()[fan.edges[i].at_end]);
    if (glm::length(band.center(s[i]) - center) > kTogether * surgery.size)
      throw BlendError(fan.edges[i].edge, "one ball does not touch all faces of the corner at its end", false);
  }
  std::vector<Vec3> directions;
  for (size_t i = 0; i < n; ++i) {
    const HalfEdge &half = fan.edges[i], &next = fan.edges[fan.next(i)];
    const Vec3 p = surgery.blend(half).band.at(s[i], side_after(half)).point;
    const int vertex = surgery.draft.add_vertex(p);
    directions.push_back((p - center) / radius);
    surgery.end_border(half, side_after(half), s[i], vertex);
    surgery.end_border(next, side_before(next), s[fan.next(i)], vertex);
  }
  std::vector<Vec3> seen = directions;
  for (size_t i = 0; i < n; ++i) {
    const Vec3 middle = surgery.blend(fan.edges[i]).band.at(s[i], 0.5).point;
    seen.push_back((middle - center) / radius);
  }
  const auto sphere = std::make_shared<SphereSurface>(frame_for(center, seen), radius);
  DraftFace face;
  face.surface = sphere, face.forward = first.edge.convex;
  face.origin = {"", surgery.rule_of(first).role, -1};
  face.shell = surgery.draft.faces[fan.faces[0]].shell;
  std::vector<Body::Use> loop;
  for (size_t i = 0; i < n; ++i) {
    const HalfEdge& half = fan.edges[i];
    const int edge = add_section(surgery, half, s[i]);
    const Curve2Ptr image = image_on(sphere, surgery.draft.edges[edge].curve, Vec2(kPi, 0));
    if (!image) throw BlendError(half.edge, "the ball at its end has no piece between the faces");
    // Counterclockwise about the corner: from the side before the edge to the side after it.
    loop.push_back({edge, side_before(half) == 0, image});
  }
  face.loops = {loop};
  surgery.corner_faces.push_back(std::move(face));
}

}  // namespace lekalo::geometry
