#include "geometry/bodies/blends/blending.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/bodies/blends/supports.h"
#include "geometry/bodies/blends/surgery.h"
#include "geometry/bodies/constructions/swept_body.h"
#include "geometry/bodies/topology/entity_names.h"
#include "geometry/curves/operations/curve_part.h"
#include "geometry/describe.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/derived/extended.h"

namespace lekalo::geometry {

namespace {

constexpr double kTogether = 1e-9;  // of the size: how far edges may be from their faces

// Looked at in some places: enclosures of polynomials are wide.
Box3 sampled_box(const Curve& image) {
  constexpr int kSamples = 32;
  Box3 box;
  for (const CurvePiece& piece : image.pieces())
    for (int k = 0; k <= kSamples; ++k) box.include(image.point(piece.domain.lo + piece.domain.width() * k / kSamples));
  return box;
}

class Blending {
 public:
  Blending(const Body& body, const std::vector<BlendRequest>& requests, Corners corners)
      : body_(body), corners_(corners), surgery_{body, rules_, BodyDraft(body), bounds(body).diameter(), {}, {}, {},
                                                 {},   {}} {
    const std::vector<BlendEdge> edges = blend_edges(body, requests, rules_);
    for (size_t i = 0; i < edges.size(); ++i) surgery_.blend_of[edges[i].edge] = i;
    for (const BlendEdge& edge : edges) surgery_.blends.push_back({edge, band_of(edge), {}, {}, {}});
  }

  Stage run() {
    meet_vertices();
    trim_edges();
    retrace_loops();
    add_bands();
    widen_faces();
    Stage stage;
    stage.body = surgery_.draft.body(&stage.edges);
    measure_tolerances(stage.body);
    check(stage.body);
    return stage;
  }

 private:
  BlendBand band_of(const BlendEdge& edge) const {
    const BlendRule& rule = rules_[edge.rule];
    const double size = 4 * std::max(rule.sizes[0](0.5), rule.sizes[1](0.5));
    std::array<double, 2> reach{size, size};
    for (const bool at_end : {false, true}) {
      const Fan fan = fan_from(body_, {edge.edge, at_end});
      const size_t next = fan.edges.empty() ? 0 : continuation(body_, fan);
      if (next > 0 && surgery_.is_blended(fan.edges[next])) reach[at_end] = 0;
    }
    try {
      return BlendBand(body_, edge, rule, reach);
    } catch (const FieldError& error) {
      throw BlendError(edge.edge, error.what());
    }
  }

  void meet_vertices() {
    std::set<HalfEdge> done;
    for (const EdgeBlend& blend : surgery_.blends)
      for (const bool at_end : {false, true}) {
        const HalfEdge half{blend.edge.edge, at_end};
        if (done.count(half)) continue;
        const Fan fan = fan_from(body_, half);
        if (fan.edges.empty()) throw BlendError(half.edge, "the faces around its end do not close", false);
        for (const HalfEdge& other : fan.edges)
          if (surgery_.is_blended(other)) done.insert(other);
        meet_vertex(fan);
      }
  }

  void meet_vertex(const Fan& fan) {
    const size_t count = static_cast<size_t>(std::count_if(
        fan.edges.begin(), fan.edges.end(), [&](const HalfEdge& half) { return surgery_.is_blended(half); }));
    if (count == 1) return run_out(surgery_, fan);
    const size_t next = continuation(body_, fan);
    if (count == 2 && next > 0 && surgery_.is_blended(fan.edges[next])) return join(surgery_, fan, next);
    if (fan.edges.size() == count && corners_ == Corners::round && is_one_ball(fan)) return round_corner(surgery_, fan);
    if (fan.edges.size() == 3 && is_of_one_side(fan)) return mitre(surgery_, fan);
    throw BlendError(fan.edges[0].edge, "blends that meet at its end in this way are not known", false);
  }

  bool is_of_one_side(const Fan& fan) {
    bool convex = false, concave = false;
    for (const HalfEdge& half : fan.edges)
      if (surgery_.is_blended(half)) (surgery_.blend(half).edge.convex ? convex : concave) = true;
    return convex != concave;
  }

  bool is_one_ball(const Fan& fan) {
    const EdgeBlend& first = surgery_.blend(fan.edges[0]);
    return std::all_of(fan.edges.begin(), fan.edges.end(), [&](const HalfEdge& half) {
      const EdgeBlend& one = surgery_.blend(half);
      return one.band.is_ball() && one.band.radius() == first.band.radius() && one.edge.convex == first.edge.convex;
    });
  }

  void trim_edges() {
    for (const auto& [e, trim] : surgery_.trims) {
      Edge& edge = surgery_.draft.edges[e];
      const Interval old = edge.curve->domain();
      const double lo = trim.t[0].value_or(old.lo), hi = trim.t[1].value_or(old.hi);
      if (!(hi - lo > 1e-9 * old.width()))
        throw BlendError(trim.by, fmt::format("nothing is left of {} beside it", name_of_edge(body_, e)));
      const double speed = glm::length(edge.curve->evaluate(old.middle(), 1).d[1]);
      whole_[e] = guide_beyond(edge.curve, {(old.lo - lo) * speed * 1.5, (hi - old.hi) * speed * 1.5});
      edge.curve = std::make_shared<CurvePart>(whole_[e], Interval(lo, hi));
      for (int k = 0; k < 2; ++k)
        if (trim.vertices[k] >= 0) (k == 0 ? edge.start : edge.end) = trim.vertices[k];
    }
  }

  Curve2Ptr trimmed_image(const Body::Use& use, const SurfacePtr& surface) const {
    const Interval part = surgery_.draft.edges[use.edge].curve->domain(), old = use.image->domain();
    if (old.contains(part)) return std::make_shared<CurvePart>(use.image, part);
    const Curve2Ptr image =
        image_on(surface, surgery_.draft.edges[use.edge].curve, Vec2(use.image->point(old.clamp(part.middle()))));
    if (!image) throw BlendError(use.edge, "it does not go on in its faces as far as the blend needs it");
    return image;
  }

  void retrace_loops() {
    for (size_t b = 0; b < surgery_.blends.size(); ++b) borders_.push_back(borders_of(surgery_.blends[b]));
    for (size_t f = 0; f < body_.faces.size(); ++f) {
      DraftFace& face = surgery_.draft.faces[f];
      bool changed = false;
      for (auto& loop : face.loops) {
        std::vector<Body::Use> uses;
        for (const Body::Use& use : loop) {
          const auto blended = surgery_.blend_of.find(use.edge);
          if (blended != surgery_.blend_of.end()) {
            uses.push_back(border_use(blended->second, use, face.surface));
            changed = true;
          } else if (surgery_.trims.count(use.edge)) {
            uses.push_back({use.edge, use.forward, trimmed_image(use, face.surface)});
            changed = true;
          } else {
            uses.push_back(use);
          }
          const auto corner = surgery_.corners.find({use.edge, use.forward});
          if (corner != surgery_.corners.end()) uses.insert(uses.end(), corner->second.begin(), corner->second.end());
        }
        loop = std::move(uses);
      }
      if (changed) face.trimmed = true;
    }
  }

  // Edges along the right and the left border of a band, in the direction of its edge, with images on the band.
  std::array<Body::Use, 2> borders_of(const EdgeBlend& blend) {
    std::array<Body::Use, 2> result;
    for (int side = 0; side < 2; ++side) {
      const double from = blend.s[0][side], to = blend.s[1][side];
      if (!(to - from > 1e-9 * blend.band.range().width()))
        throw BlendError(blend.edge.edge, "nothing is left of its blend between those at its ends");
      const LineOnSurface line = blend.band.border(side, from, to);
      const int edge = surgery_.draft.add_edge(line.curve, blend.vertices[0][side], blend.vertices[1][side],
                                               surgery_.origin(blend, side == 0 ? "right" : "left"));
      result[side] = {edge, true, line.image};
    }
    return result;
  }

  Body::Use border_use(size_t b, const Body::Use& old, const SurfacePtr& surface) const {
    const Body::Use& border = borders_[b][old.forward ? 1 : 0];
    const CurvePtr& curve = surgery_.draft.edges[border.edge].curve;
    const Vec2 beside(old.image->point(old.image->domain().middle()));
    const Vec2 near = foot_place_anywhere(surface, curve->point(curve->domain().middle()), beside);
    const Curve2Ptr image = image_on(surface, curve, near);
    if (!image) throw BlendError(surgery_.blends[b].edge.edge, "the border of its blend leaves the surface of a face");
    return {border.edge, old.forward, image};
  }

  void add_bands() {
    for (size_t b = 0; b < surgery_.blends.size(); ++b) {
      const EdgeBlend& blend = surgery_.blends[b];
      double lo = kInfinity, hi = -kInfinity;
      for (int end = 0; end < 2; ++end)
        for (const Body::Use& use : blend.sections[end]) {
          const Box3 box = sampled_box(*use.image);
          for (const Vec3& p : {box.lo, box.hi}) {
            const double s = blend.band.s_of(Vec2(p));
            lo = std::min(lo, s), hi = std::max(hi, s);
          }
        }
      const bool is_straight = std::abs(lo - blend.s[0][0]) + std::abs(hi - blend.s[1][0]) +
                                   std::abs(lo - blend.s[0][1]) + std::abs(hi - blend.s[1][1]) <=
                               1e-12 * (hi - lo);
      DraftFace face;
      face.surface = blend.band.cut(is_straight ? Interval(blend.s[0][0], blend.s[1][0]) : Interval(lo, hi));
      face.trimmed = !is_straight;
      const Vec2 middle = blend.band.place(0.5 * (lo + hi), 0.5);
      face.forward = glm::dot(face.surface->normal(middle.x, middle.y), blend.band.outward(0.5 * (lo + hi), 0.5)) > 0;
      face.origin = {"", rules_[blend.edge.rule].role, -1};
      face.shell = surgery_.draft.faces[blend.edge.faces[0]].shell;
      face.loops = {loop_of(b)};
      surgery_.draft.faces.push_back(std::move(face));
    }
    for (DraftFace& face : surgery_.corner_faces) surgery_.draft.faces.push_back(std::move(face));
  }

  // The right border, the section at the end, the left border back, the section at the start back.
  std::vector<Body::Use> loop_of(size_t b) const {
    const EdgeBlend& blend = surgery_.blends[b];
    std::vector<Body::Use> loop{borders_[b][0]};
    loop.insert(loop.end(), blend.sections[1].begin(), blend.sections[1].end());
    const Body::Use& left = borders_[b][1];
    loop.push_back({left.edge, false, left.image});
    for (auto use = blend.sections[0].rbegin(); use != blend.sections[0].rend(); ++use)
      loop.push_back({use->edge, !use->forward, use->image});
    return loop;
  }

  // Loops that reach beyond the surfaces' domains; lines near to an edge still meet a plane.
  void widen_faces() {
    for (DraftFace& face : surgery_.draft.faces) {
      if (!face.trimmed) continue;
      Box3 box;
      for (const auto& loop : face.loops)
        for (const Body::Use& use : loop) box.include(sampled_box(*use.image));
      Rectangle domain = face.surface->domain();
      const Periods periods = face.surface->periods();
      const double slack = 1e-9 * box.diameter(),
                   reach = dynamic_cast<const Plane*>(face.surface.get()) ? 0.05 * box.diameter() : 0;
      const auto widened = [&](Interval& range, double period, double lo, double hi) {
        if (period > 0 && range.width() >= period * (1 - 1e-12)) return false;
        const bool leaves = lo - reach < range.lo - slack || hi + reach > range.hi + slack;
        if (leaves) range = {std::min(range.lo, lo - reach), std::max(range.hi, hi + reach)};
        return leaves;
      };
      const bool u = widened(domain.u, periods.u, box.lo.x, box.hi.x),
                 v = widened(domain.v, periods.v, box.lo.y, box.hi.y);
      if (!u && !v) continue;
      const bool was_reversed = face.surface->reversed();
      const SurfacePtr more = continued_by_law(face.surface, domain);
      if (!more)
        throw BlendError(surgery_.blends.front().edge.edge,
                         fmt::format("the surface of {} does not go on as far as the blend needs it",
                                     face.origin.text().empty() ? "a face" : face.origin.text()));
      std::const_pointer_cast<Surface>(more)->set_reversed(was_reversed);
      face.surface = more;
    }
  }

  void check(const Body& result) const {
    for (const Edge& edge : result.edges)
      if (edge.tolerance > kTogether * surgery_.size + body_tolerance())
        throw BlendError(surgery_.blends.front().edge.edge,
                         fmt::format("edges of the blend are {:.3g} from their faces", edge.tolerance));
    const std::vector<Violation> found = result.violations();
    if (!found.empty())
      throw BlendError(surgery_.blends.front().edge.edge,
                       fmt::format("there is no room for it ({}: {})", found.front().entity, found.front().condition));
  }
  double body_tolerance() const {
    double most = 0;
    for (const Edge& edge : body_.edges) most = std::max(most, edge.tolerance);
    return most;
  }

  const Body& body_;
  std::vector<BlendRule> rules_;
  Corners corners_;
  Surgery surgery_;
  std::map<int, CurvePtr> whole_;
  std::vector<std::array<Body::Use, 2>> borders_;
};

}  // namespace

Stage blended_at_once(const Body& body, const std::vector<BlendRequest>& requests, Corners corners) {
  return Blending(body, requests, corners).run();
}

}  // namespace lekalo::geometry
