// Loops as in Golovanov 2016, 5.7: side i  +e_1i +e_i -e_2i -e_(i-1),  first end  -e_1k .. -e_11,  second end
// +e_21 .. +e_2k; the other way round for a segment with the region to its right.
#include "geometry/bodies/constructions/swept_body.h"

#include <algorithm>
#include <cmath>

#include "geometry/bodies/primitives/construct.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

// Ends of one segment's line between two neighbours.
struct Joint {
  std::array<int, 2> vertices{-1, -1};  // at the start and at the end of the motion
  int rail = -1;                        // -1 at a pole
};

class Sweeping {
 public:
  explicit Sweeping(const SweptParts& parts) : parts_(parts) {}

  Body build() {
    for (const SweptLoop& loop : parts_.loops) add_sides(loop);
    if (parts_.ends) {
      add_end(0);
      add_end(1);
    }
    if (closed())
      make_shells();
    else
      body_.close_shell();
    measure_tolerances(body_);
    return std::move(body_);
  }

 private:
  struct Segment {
    const SweptSide* side;
    std::array<int, 2> edges{-1, -1};  // at the start and at the end
  };

  bool closed() const { return !parts_.ends; }
  Origin numbered(const char* role, size_t index) const {
    size_t count = 0;
    for (const SweptLoop& loop : parts_.loops) count += loop.sides.size();
    return {"", role, count == 1 ? -1 : static_cast<int>(index)};
  }

  // Without ends nothing joins the faces of a hole to those of the outline.
  void make_shells() {
    int face = 0;
    for (const SweptLoop& loop : parts_.loops) {
      Shell shell;
      for (const SweptSide& side : loop.sides) {
        if (!side.surface) continue;
        body_.faces[face].shell = static_cast<int>(body_.shells.size());
        shell.faces.push_back(face++);
      }
      body_.shells.push_back(std::move(shell));
    }
  }

  void add_sides(const SweptLoop& loop) {
    const size_t count = loop.sides.size();
    std::vector<Joint> joints;
    for (size_t i = 0; i < count; ++i)
      joints.push_back(add_joint(loop.sides[i], loop.sides[(i + count - 1) % count], first_ + i));
    std::vector<Segment>& segments = segments_.emplace_back();
    for (size_t i = 0; i < count; ++i)
      segments.push_back(add_segment(loop.sides[i], joints[i], joints[(i + 1) % count], first_ + i));
    for (size_t i = 0; i < count; ++i)
      if (loop.sides[i].surface) add_side(segments[i], joints[i], joints[(i + 1) % count], loop.left, first_ + i);
    first_ += count;
  }

  Joint add_joint(const SweptSide& side, const SweptSide& before, size_t index) {
    Joint joint;
    const Vec3 start = side.start->point(side.start->domain().lo);
    joint.vertices[0] = body_.add_vertex(start, numbered("start", index));
    const bool pole = !side.rail;
    joint.vertices[1] = pole || closed()
                            ? joint.vertices[0]
                            : body_.add_vertex(side.end->point(side.end->domain().lo), numbered("end", index));
    if (!pole)
      joint.rail = body_.add_edge(side.rail, joint.vertices[0], joint.vertices[1], numbered("rail", index),
                                  &side == &before ? EdgeKind::seam : EdgeKind::regular);
    return joint;
  }

  Segment add_segment(const SweptSide& side, const Joint& lo, const Joint& hi, size_t index) {
    Segment segment{&side};
    if (!side.surface && closed()) return segment;
    const EdgeKind kind = closed() ? EdgeKind::seam : EdgeKind::regular;
    segment.edges[0] = body_.add_edge(side.start, lo.vertices[0], hi.vertices[0], numbered("start", index), kind);
    segment.edges[1] = closed() || !side.surface
                           ? segment.edges[0]
                           : body_.add_edge(side.end, lo.vertices[1], hi.vertices[1], numbered("end", index));
    return segment;
  }

  void add_side(const Segment& segment, const Joint& lo, const Joint& hi, bool left, size_t index) {
    const SurfacePtr& surface = segment.side->surface;
    const Rectangle d = surface->domain();
    const bool forward = left == !surface->reversed();
    const int face = body_.add_face(surface, forward, numbered("side", index), false);
    std::vector<Body::Use> uses{{segment.edges[0], true, image_line(d.u, {d.u.lo, d.v.lo}, {d.u.hi, d.v.lo})},
                                {rail_or_pole(hi, d.v), true, image_line(d.v, {d.u.hi, d.v.lo}, {d.u.hi, d.v.hi})},
                                {segment.edges[1], false, image_line(d.u, {d.u.lo, d.v.hi}, {d.u.hi, d.v.hi})},
                                {rail_or_pole(lo, d.v), false, image_line(d.v, {d.u.lo, d.v.lo}, {d.u.lo, d.v.hi})}};
    if (!left) {
      std::reverse(uses.begin(), uses.end());
      for (Body::Use& use : uses) use.forward = !use.forward;
    }
    body_.add_loop(face, uses);
  }

  int rail_or_pole(const Joint& joint, const Interval& v) {
    if (joint.rail >= 0) return joint.rail;
    const int vertex = joint.vertices[0];
    return body_.add_edge(point_curve(v, body_.vertices[vertex].point), vertex, vertex, {"", "pole"}, EdgeKind::pole);
  }

  void add_end(int k) {
    const Frame& frame = (*parts_.ends)[k];
    std::vector<CurvePtr> images;
    for (const auto& loop : segments_)
      for (const Segment& segment : loop)
        images.push_back(image_in(frame, k == 0 ? segment.side->start : segment.side->end));
    const int face = add_plane_face(body_, frame, k == 1, {"", k == 0 ? "start" : "end"}, images);
    size_t next = 0;
    for (size_t l = 0; l < segments_.size(); ++l) {
      const bool along = parts_.loops[l].left == (k == 1);
      std::vector<Body::Use> uses;
      for (const Segment& segment : segments_[l]) uses.push_back({segment.edges[k], along, images[next++]});
      if (!along) std::reverse(uses.begin(), uses.end());
      body_.add_loop(face, uses);
    }
  }

  const SweptParts& parts_;
  Body body_;
  std::vector<std::vector<Segment>> segments_;  // of each loop
  size_t first_ = 0;                            // number of the loop's first segment
};

}  // namespace

Body swept_body(const SweptParts& parts) { return Sweeping(parts).build(); }

CurvePtr image_in(const Frame& plane, const CurvePtr& curve) {
  Mat3 linear = glm::transpose(Mat3(plane.x, plane.y, Vec3(0)));
  return transformed(curve, {linear, -(linear * plane.origin)});
}

int add_plane_face(Body& body, const Frame& frame, bool forward, Origin origin, const std::vector<CurvePtr>& images) {
  Box3 box;
  for (const CurvePtr& image : images) box.include(bounds(*image));
  // Lines near an edge still meet the plane.
  const double reach = 0.05 * box.diameter();
  auto plane = std::make_shared<Plane>(
      frame, Rectangle{{box.lo.x - reach, box.hi.x + reach}, {box.lo.y - reach, box.hi.y + reach}});
  return body.add_face(std::move(plane), forward, std::move(origin));
}

void measure_tolerances(Body& body) {
  constexpr int kSamples = 24;
  // What rounding explains.
  const double small = 1e-13 * bounds(body).diameter();
  for (Edge& edge : body.edges) {
    if (edge.kind == EdgeKind::pole) continue;
    double worst = 0;
    for (const CurvePiece& piece : edge.curve->pieces())
      for (int k = 0; k <= kSamples; ++k) {
        const double t = piece.domain.lo + piece.domain.width() * k / kSamples;
        const Vec3 point = edge.curve->point(t);
        for (const int c : edge.coedges) {
          const Vec3 uv = body.coedges[c].image->point(t);
          const Face& face = body.faces[body.loops[body.coedges[c].loop].face];
          worst = std::max(worst, glm::length(face.surface->point(uv.x, uv.y) - point));
        }
      }
    // Between the samples it may be a little more.
    if (worst > small) edge.tolerance = 2 * worst;
  }
}

}  // namespace lekalo::geometry
