#include "geometry/bodies/local/round_offset.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/bodies/constructions/swept_body.h"
#include "geometry/bodies/local/new_faces.h"
#include "geometry/bodies/primitives/construct.h"
#include "geometry/bodies/topology/entity_names.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/queries/quadrics/conic_image.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"

namespace lekalo::geometry {

namespace {

class Rounding {
 public:
  Rounding(const Body& body, double h, const char* field)
      : new_(body, offset_surfaces(body, std::vector<double>(body.faces.size(), h), field), field),
        old_(new_.old()),
        h_(h),
        field_(field) {}

  Body build() {
    vertices_.assign(2 * old_.coedges.size(), -1);
    sides_.resize(old_.coedges.size());
    for (const Corner& corner : corners_of(old_, std::vector<char>(old_.faces.size(), 0))) add_points(corner);
    for (size_t e = 0; e < old_.edges.size(); ++e) add_edge(static_cast<int>(e));
    for (size_t f = 0; f < old_.faces.size(); ++f) add_face(static_cast<int>(f));
    for (const Strip& strip : strips_) add_strip(strip);
    for (const Corner& corner : corners_of(old_, std::vector<char>(old_.faces.size(), 0))) add_ball(corner);
    body_.close_shell();
    measure_tolerances(body_);
    return std::move(body_);
  }

 private:
  // The use of a new edge by one of the faces that are set off.
  struct SideUse {
    int edge = -1;
    Curve2Ptr image;
  };
  struct Strip {
    int edge;  // the old one
    SurfacePtr surface;
    Vec2 corner[2][2];  // parameters at [side][end]
    int along[2];       // new edges
    Curve2Ptr images[2];
    int arcs[2];  // at the start and the end, from side 0 to side 1
    bool arc_forward[2];
    Curve2Ptr arc_images[2];
  };

  int face_of(int coedge) const { return face_of_coedge(old_, coedge); }
  const Coedge& use(int coedge) const { return old_.coedges[coedge]; }
  std::string name_of_edge(int e) const {
    const std::string text = old_.edges[e].origin.text();
    return text.empty() ? std::to_string(e) : text;
  }

  // The new vertex at an end of an old edge, on the side of one of its uses.
  int& vertex(int coedge, bool at_end) { return vertices_[2 * static_cast<size_t>(coedge) + (at_end ? 1 : 0)]; }

  Vec3 lifted(int coedge, bool at_end) const {
    const Vec2 at = new_.near(coedge, at_end, false);
    return new_.support(face_of(coedge))->point(at.x, at.y);
  }

  bool is_smooth(int e) const { return new_.carrier(e) >= 0 || old_.edges[e].kind != EdgeKind::regular; }

  // One for each run of sectors between sharp edges.
  void add_points(const Corner& corner) {
    const size_t count = corner.sectors.size();
    size_t first = 0;
    for (size_t k = 0; k < count; ++k)
      if (!is_smooth(use(corner.sectors[k].in).edge)) first = k + 1;
    int now = -1;
    for (size_t i = 0; i < count; ++i) {
      const Sector& s = corner.sectors[(first + i) % count];
      const bool starts = use(s.out).forward;
      if (now < 0) now = body_.add_vertex(lifted(s.out, !starts));
      vertex(s.out, !starts) = now;
      vertex(s.in, use(s.in).forward) = now;
      const int e = use(s.in).edge;
      if (old_.edges[e].kind == EdgeKind::pole) vertex(s.in, false) = vertex(s.in, true) = now;
      if (!is_smooth(e)) now = -1;
    }
  }

  Vec3 normal(int coedge, double t) const {
    const Vec3 uv = use(coedge).image->point(t);
    return old_.normal(face_of(coedge), uv.x, uv.y);
  }

  void add_edge(int e) {
    const Edge& old = old_.edges[e];
    const int a = old.coedges[0];
    if (old.kind == EdgeKind::pole) return add_pole(e);
    const int b = coedge_partner(old_, a);
    if (!is_smooth(e)) return add_rounded(e);
    const Vec3 from = body_.vertices[vertex(a, false)].point, to = body_.vertices[vertex(a, true)].point;
    const auto edge = new_.carried_edge(e, from, to);
    if (!edge) refuse(e, "is smooth, but its faces part");
    const int made = body_.add_edge(edge->curve, vertex(a, false), vertex(a, true), old.origin, old.kind);
    sides_[a] = {made, edge->images[0]};
    sides_[b] = {made, edge->images[1]};
  }

  void add_pole(int e) {
    const Edge& old = old_.edges[e];
    const int a = old.coedges[0];
    const Vec3 at = body_.vertices[vertex(a, false)].point, was = old_.vertices[old.start].point;
    if (std::abs(glm::length(at - was) - h_) > 1e-9 * new_.size())
      throw FieldError(field_, fmt::format("the face {} ends in a tip", new_.name(face_of(a))), "joints: extended");
    const int made = body_.add_edge(point_curve(old.curve->domain(), at), vertex(a, false), vertex(a, false),
                                    old.origin, EdgeKind::pole);
    sides_[a] = {made, use(a).image};
  }

  [[noreturn]] void refuse(int e, const char* what) const {
    throw FieldError(field_, fmt::format("the edge {} {}", name_of_edge(e), what),
                     "joints: extended, or a convex body with straight and circular edges");
  }

  void add_rounded(int e) {
    const Edge& old = old_.edges[e];
    const int a = old.coedges[0], b = old.coedges[1];
    const Interval t = old.curve->domain();
    const Vec3 m = normal(a, t.lo), n = normal(b, t.lo);
    const Vec3 along = (use(a).forward ? 1.0 : -1.0) * old.curve->evaluate(t.lo, 1).d[1];
    if (!(glm::dot(glm::cross(m, along), n) < 0)) refuse(e, "is concave, or opens as far as it can");
    Strip strip = strip_of(e, m, n);
    strip.edge = e;
    for (const int k : {0, 1}) {
      const int c = k == 0 ? a : b;
      const EdgeSide on_strip{strip.surface, std::nullopt, {strip.corner[k][0], strip.corner[k][1]}};
      const Vec3 from = body_.vertices[vertex(c, false)].point, to = body_.vertices[vertex(c, true)].point;
      const auto edge = parameter_edge({on_strip, new_.side_of(c)}, from, to, new_.size());
      if (!edge) refuse(e, "has an angle that changes along it");
      strip.along[k] = body_.add_edge(edge->curve, vertex(c, false), vertex(c, true), old.origin);
      strip.images[k] = edge->images[0];
      sides_[c] = {strip.along[k], edge->images[1]};
    }
    for (const int end : {0, 1}) add_arc(strip, end, vertex(a, end == 1), vertex(b, end == 1));
    strips_.push_back(std::move(strip));
  }

  // Of radius h about the edge, from the normal m to n.
  Strip strip_of(int e, const Vec3& m, const Vec3& n) const {
    const Edge& old = old_.edges[e];
    const Interval t = old.curve->domain();
    const Vec3 from = old.curve->point(t.lo), to = old.curve->point(t.hi);
    const Vec3 turn = glm::normalize(glm::cross(m, n));
    const double angle = std::atan2(glm::length(glm::cross(m, n)), glm::dot(m, n));
    Strip strip{};
    strip.arcs[0] = strip.arcs[1] = -1;
    if (const auto circle = even_circle(*old.curve, new_.size())) {
      const Frame& frame = circle->frame();
      const auto minor = [&](const Vec3& x) { return std::atan2(glm::dot(x, frame.z), glm::dot(x, frame.x)); };
      const double lo = minor(m);
      const double hi = lo + std::remainder(minor(n) - lo, kTwoPi);
      const Interval u = circle->domain();
      strip.surface = std::make_shared<TorusSurface>(frame, circle->radius(), h_,
                                                     Rectangle{u, {std::min(lo, hi), std::max(lo, hi)}});
      for (const int end : {0, 1}) {
        strip.corner[0][end] = {end == 0 ? u.lo : u.hi, lo};
        strip.corner[1][end] = {end == 0 ? u.lo : u.hi, hi};
      }
      return strip;
    }
    const double length = glm::length(to - from);
    for (int k = 1; k < 8; ++k)
      if (glm::length(glm::cross(old.curve->point(t.lo + t.width() * k / 8) - from, to - from)) >
          1e-12 * new_.size() * length)
        refuse(e, "is neither straight nor a circle");
    const bool up = glm::dot(turn, to - from) > 0;
    const Frame frame = frame_from(up ? from : to, (up ? 1.0 : -1.0) * (to - from), m);
    strip.surface = std::make_shared<CylinderSurface>(frame, h_, length, Rectangle{{0, angle}, {0, 1}});
    for (const int end : {0, 1}) {
      const double v = (end == 0) == up ? 0 : 1;
      strip.corner[0][end] = {0, v};
      strip.corner[1][end] = {angle, v};
    }
    return strip;
  }

  // About the old vertex; two strips that end in the same arc share it.
  void add_arc(Strip& strip, int end, int from, int to) {
    const LineOnSurface arc = line_on_surface(strip.surface, strip.corner[0][end], strip.corner[1][end], new_.size());
    const auto found = arcs_.find({from, to});
    const auto back = arcs_.find({to, from});
    if (found != arcs_.end() || back != arcs_.end()) {
      const bool forward = found != arcs_.end();
      const int known = forward ? found->second : back->second;
      strip.arcs[end] = known;
      strip.arc_forward[end] = forward;
      const Vec2 *a = &strip.corner[0][end], *b = &strip.corner[1][end];
      strip.arc_images[end] = image_line(body_.edges[known].curve->domain(), forward ? *a : *b, forward ? *b : *a);
      for (const int other : {0, 1})
        if (other != end && strip.arcs[other] == known) body_.edges[known].kind = EdgeKind::seam;
      return;
    }
    strip.arcs[end] = body_.add_edge(arc.curve, from, to, {"", "arc", static_cast<int>(arcs_.size())});
    arcs_[{from, to}] = strip.arcs[end];
    strip.arc_forward[end] = true;
    strip.arc_images[end] = arc.image;
  }

  void add_face(int f) {
    const Face& old = old_.faces[f];
    std::vector<std::vector<Body::Use>> loops;
    std::vector<CurvePtr> images;
    for (const int l : old.loops) {
      loops.emplace_back();
      for (const int c : old_.loops[l].coedges) {
        loops.back().push_back({sides_[c].edge, use(c).forward, sides_[c].image});
        images.push_back(sides_[c].image);
      }
    }
    const bool outward = outward_side(old) > 0;
    const int face = new_.plane(f) ? add_plane_face(body_, *new_.plane(f), outward, old.origin, images)
                                   : body_.add_face(new_.support(f), old.forward, old.origin, old.trimmed);
    for (const auto& loop : loops) body_.add_loop(face, loop);
  }

  void add_strip(const Strip& s) {
    const int face = body_.add_face(s.surface, true, old_.edges[s.edge].origin, false);
    std::vector<Body::Use> uses{{s.arcs[0], s.arc_forward[0], s.arc_images[0]},
                                {s.along[1], true, s.images[1]},
                                {s.arcs[1], !s.arc_forward[1], s.arc_images[1]},
                                {s.along[0], false, s.images[0]}};
    const Vec2 a = s.corner[1][0] - s.corner[0][0], b = s.corner[0][1] - s.corner[0][0];
    if (a.x * b.y - a.y * b.x < 0) {
      std::reverse(uses.begin(), uses.end());
      for (Body::Use& u : uses) u.forward = !u.forward;
    }
    body_.add_loop(face, uses);
  }

  // Between the arcs of three edges or more.
  void add_ball(const Corner& corner) {
    std::vector<std::pair<int, bool>> arcs;
    Vec3 sum(0);
    for (const Sector& s : corner.sectors) {
      const int c = s.in, e = use(c).edge;
      if (is_smooth(e)) continue;
      const int other = coedge_partner(old_, c);
      const int from = vertex(c, use(c).forward), to = vertex(other, use(c).forward);
      sum += body_.vertices[from].point - old_.vertices[corner.vertex].point;
      const auto found = arcs_.find({from, to});
      arcs.emplace_back(found != arcs_.end() ? found->second : arcs_.at({to, from}), found != arcs_.end());
    }
    if (arcs.size() < 3) return;
    const Vec3 center = old_.vertices[corner.vertex].point;
    const Frame about = frame_about(center, glm::normalize(sum));
    // The poles lie far from the patch.
    const Frame frame{center, about.z, about.x, about.y};
    const auto sphere = std::make_shared<SphereSurface>(frame, h_, Rectangle{{-kPi, kPi}, {-kPi / 2, kPi / 2}});
    const int face = body_.add_face(sphere, true, {"", "vertex", corner.vertex});
    std::vector<Body::Use> uses;
    for (const auto& [edge, forward] : arcs) {
      const Curve& curve = *body_.edges[edge].curve;
      const auto circle = even_circle(curve, new_.size());
      const Conic conic{Conic::Kind::ellipse, circle->frame().origin, h_ * circle->frame().x, h_ * circle->frame().y};
      uses.push_back({edge, forward, std::make_shared<ConicImage>(*canonical(sphere), conic, circle->domain())});
    }
    body_.add_loop(face, uses);
  }

  const NewFaces new_;
  const Body& old_;
  double h_;
  const char* field_;
  std::vector<int> vertices_;   // of each old coedge: at the start and the end of its edge
  std::vector<SideUse> sides_;  // of each old coedge
  std::vector<Strip> strips_;
  std::map<std::pair<int, int>, int> arcs_;  // by their new vertices
  Body body_;
};

}  // namespace

Body round_offset(const Body& body, double h, const char* field) { return Rounding(body, h, field).build(); }

}  // namespace lekalo::geometry
