#include "geometry/bodies/blends/blending.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/bodies/blends/crossing.h"
#include "geometry/bodies/blends/overruns.h"
#include "geometry/bodies/blends/supports.h"
#include "geometry/bodies/blends/surgery.h"
#include "geometry/bodies/constructions/swept_body.h"
#include "geometry/bodies/topology/entity_names.h"
#include "geometry/curves/derived/reparametrized_curve.h"
#include "geometry/curves/operations/curve_part.h"
#include "geometry/describe.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/derived/extended.h"

namespace lekalo::geometry {

namespace {

constexpr double kTogether = 1e-9;  // of the size: how far edges may be from their faces

class Blending {
 public:
  Blending(const Body& body, const std::vector<BlendRequest>& requests, Corners corners, const Beyonds& beyonds)
      : body_(body),
        corners_(corners),
        beyonds_(beyonds),
        surgery_{body, rules_, BodyDraft(body), bounds(body).diameter(), {}, {}, {}, {}, {}, {}} {
    const std::vector<BlendEdge> edges = blend_edges(body, requests, rules_);
    for (size_t i = 0; i < edges.size(); ++i) surgery_.blend_of[edges[i].edge] = i;
    for (const auto& [edge, beyond] : beyonds_) {
      rims_[beyond.rim] = edge;
      for (const bool at_end : {false, true}) surgery_.fixed_vertices.push_back(vertex_of(body, {beyond.rim, at_end}));
    }
    for (const BlendEdge& edge : edges) surgery_.blends.push_back({edge, band_of(edge), {}, {}, {}, {}});
  }

  // The first place where a blend does not find room on a face.
  std::optional<std::pair<int, Overrun>> overrun() const {
    for (const EdgeBlend& blend : surgery_.blends) {
      const int edge = blend.edge.edge;
      if (beyonds_.count(edge)) continue;
      if (const auto found = overrun_of(body_, blend.edge, blend.band, surgery_.rule_of(blend).overflow))
        return std::pair(edge, *found);
    }
    return std::nullopt;
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
      if (is_smooth_end(body_, {edge.edge, at_end})) reach[at_end] = 0;
      const Fan fan = fan_from(body_, {edge.edge, at_end});
      const size_t next = fan.edges.empty() ? 0 : continuation(body_, fan);
      if (next > 0 && surgery_.is_blended(fan.edges[next])) reach[at_end] = 0;
    }
    try {
      const auto beyond = beyonds_.find(edge.edge);
      if (beyond != beyonds_.end() && beyond->second.kind != BeyondKind::overflow)
        return band_beside(edge, rule, beyond->second);
      return BlendBand(body_, edge, rule, reach);
    } catch (const FieldError& error) {
      throw BlendError(edge.edge, error.what());
    }
  }

  BlendBand band_beside(BlendEdge edge, const BlendRule& rule, const Beyond& beyond) const {
    if (beyond.kind == BeyondKind::roll) {
      edge.faces[beyond.side] = beyond.face;
      return {body_, edge, rule, beyond.side, nullptr, beyond.contacts};
    }
    CurvePtr rim = body_.edges[beyond.rim].curve;
    const Vec3 begin = rim->point(rim->domain().lo);
    if (glm::length(begin - beyond.points[0]) > glm::length(begin - beyond.points[1])) rim = reversed_curve(rim);
    return {body_, edge, rule, beyond.side, rim, beyond.contacts};
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
    if (is_smooth_end(body_, fan.edges[0])) return run_to_point(surgery_, fan);
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
    for (const auto& [after, pieces] : straddling_)
      for (const auto& [place, use] : pieces) surgery_.corners[after].push_back(use);
    for (size_t f = 0; f < body_.faces.size(); ++f) retrace(static_cast<int>(f));
  }

  void retrace(int f) {
    DraftFace& face = surgery_.draft.faces[f];
    bool changed = false, opened = false;
    for (auto& loop : face.loops) {
      std::vector<Body::Use> uses;
      for (const Body::Use& use : loop) {
        const std::vector<Body::Use> now = now_of(use, f, opened);
        changed = changed || now.size() != 1 || now[0].edge != use.edge || now[0].image != use.image;
        uses.insert(uses.end(), now.begin(), now.end());
        const auto corner = surgery_.corners.find({use.edge, use.forward});
        if (corner == surgery_.corners.end()) continue;
        uses.insert(uses.end(), corner->second.begin(), corner->second.end());
        changed = true;
      }
      loop = std::move(uses);
    }
    if (changed) face.trimmed = true;
    if (opened && !chain_loops(surgery_.draft, face))
      throw BlendError(surgery_.blends.front().edge.edge, "its border touches others of the face");
  }

  // What a use of an old edge has become; `opened`: the loop has a gap there, or another beginning.
  std::vector<Body::Use> now_of(const Body::Use& use, int face, bool& opened) const {
    const SurfacePtr& surface = surgery_.draft.faces[face].surface;
    const auto blended = surgery_.blend_of.find(use.edge);
    if (blended != surgery_.blend_of.end()) {
      const auto beyond = beyonds_.find(use.edge);
      opened = opened || (beyond != beyonds_.end() && beyond->second.side == (use.forward ? 1 : 0));
      return pieces_on(blended->second, use.forward ? 1 : 0, face, use.forward, use.image);
    }
    const auto rim = rims_.find(use.edge);
    if (rim != rims_.end()) {
      const Beyond& beyond = beyonds_.at(rim->second);
      if (face != beyond.face) {
        opened = true;
        return {};
      }
      if (beyond.kind != BeyondKind::edge)
        return pieces_on(surgery_.blend_of.at(rim->second), beyond.side, face, beyond.side == 1, use.image);
    }
    if (surgery_.trims.count(use.edge)) return {{use.edge, use.forward, trimmed_image(use, surface)}};
    return {use};
  }

  // The pieces of a border that lie in a face, in the direction in which its loop runs.
  std::vector<Body::Use> pieces_on(size_t b, int side, int face, bool forward, const Curve2Ptr& old) const {
    std::vector<Body::Use> uses;
    for (const Border& piece : borders_[b][side]) {
      if (piece.face != face) continue;
      const SurfacePtr& surface = surgery_.draft.faces[face].surface;
      const CurvePtr& curve = surgery_.draft.edges[piece.use.edge].curve;
      const Vec2 beside(old->point(old->domain().middle()));
      Curve2Ptr image = piece.on_face;
      if (!image)
        image = image_on(surface, curve, foot_place_anywhere(surface, curve->point(curve->domain().middle()), beside));
      if (!image)
        throw BlendError(surgery_.blends[b].edge.edge, "the border of its blend leaves the surface of a face");
      uses.push_back({piece.use.edge, piece.use.forward == forward, image});
    }
    if (!forward) std::reverse(uses.begin(), uses.end());
    return uses;
  }

  // A piece of a border: its edge as the band uses it in the edge's direction, and the face on its other side.
  struct Border {
    Body::Use use;
    int face = -1;
    Curve2Ptr on_face;  // if it is known
  };

  std::array<std::vector<Border>, 2> borders_of(const EdgeBlend& blend) {
    std::array<std::vector<Border>, 2> result;
    const auto found = beyonds_.find(blend.edge.edge);
    for (int side = 0; side < 2; ++side) {
      const double from = blend.s[0][side], to = blend.s[1][side];
      if (!(to - from > 1e-9 * blend.band.range().width()))
        throw BlendError(blend.edge.edge, "nothing is left of its blend between those at its ends");
      const Beyond* beyond = found != beyonds_.end() && found->second.side == side ? &found->second : nullptr;
      if (!beyond)
        result[side] = whole_border(blend, side);
      else if (beyond->kind == BeyondKind::overflow)
        result[side] = overflowing(blend, *beyond, from, to);
      else if (beyond->kind == BeyondKind::edge)
        result[side] = {along_rim(blend, *beyond)};
      else
        result[side] = {border_piece(blend, side, from, to, blend.vertices[0][side], blend.vertices[1][side])};
      if (beyond && beyond->kind == BeyondKind::roll) result[side][0].face = beyond->face;
    }
    return result;
  }

  // In one piece, but for what crosses a smooth edge at an end.
  std::vector<Border> whole_border(const EdgeBlend& blend, int side) {
    std::array<double, 2> s{blend.s[0][side], blend.s[1][side]};
    std::array<int, 2> vertices{blend.vertices[0][side], blend.vertices[1][side]};
    std::array<std::vector<Border>, 2> beyond;
    for (int end = 0; end < 2; ++end) {
      const auto& straddle = blend.straddles[end][side];
      if (!straddle) continue;
      const double to = straddle->is_whole ? s[1 - end] : straddle->s;
      const int vertex = straddle->is_whole ? vertices[1 - end] : straddle->vertex;
      Border piece = end == 0 ? border_piece(blend, side, s[0], to, vertices[0], vertex)
                              : border_piece(blend, side, to, s[1], vertex, vertices[1]);
      straddling_[straddle->after][straddle->place] = on_other_face(blend, piece, side, *straddle);
      piece.face = -1;
      if (straddle->is_whole) return {piece};
      beyond[end].push_back(std::move(piece));
      s[end] = to, vertices[end] = vertex;
    }
    std::vector<Border> pieces = std::move(beyond[0]);
    pieces.push_back(border_piece(blend, side, s[0], s[1], vertices[0], vertices[1]));
    pieces.insert(pieces.end(), beyond[1].begin(), beyond[1].end());
    return pieces;
  }

  Body::Use on_other_face(const EdgeBlend& blend, const Border& piece, int side, const Straddle& straddle) const {
    const SurfacePtr& surface = surgery_.draft.faces[straddle.face].surface;
    const CurvePtr& curve = surgery_.draft.edges[piece.use.edge].curve;
    const Vec2 near = foot_place_anywhere(surface, curve->point(curve->domain().middle()), straddle.near);
    const Curve2Ptr image = image_on(surface, curve, near);
    if (!image || !ends_on(*surface, *image, *curve))
      throw BlendError(blend.edge.edge, "its blend does not end on the smooth edge beside it");
    return {piece.use.edge, side == 1, image};
  }

  // An image may be that of the nearest places of a surface that does not hold the curve.
  bool ends_on(const Surface& surface, const Curve& image, const Curve& curve) const {
    const Interval t = curve.domain();
    for (const double at : {t.lo, t.middle(), t.hi}) {
      const Vec2 uv(image.point(at));
      if (glm::length(surface.point(uv.x, uv.y) - curve.point(at)) > kTogether * surgery_.size) return false;
    }
    return true;
  }

  Border border_piece(const EdgeBlend& blend, int side, double from, double to, int start, int end) {
    const LineOnSurface line = blend.band.border(side, from, to);
    const int edge =
        surgery_.draft.add_edge(line.curve, start, end, surgery_.origin(blend, side == 0 ? "right" : "left"));
    return {{edge, true, line.image}, blend.edge.faces[side], nullptr};
  }

  // The rim itself.
  Border along_rim(const EdgeBlend& blend, const Beyond& beyond) {
    const Edge& rim = surgery_.draft.edges[beyond.rim];
    const bool forward = rim.start == blend.vertices[0][beyond.side];
    const Interval s = blend.band.range();
    const Curve2Ptr image = image_on(blend.band.surface(), rim.curve, blend.band.place(s.middle(), beyond.side));
    if (!image) throw BlendError(blend.edge.edge, "its blend does not lie on the edge on which the ball rests");
    return {{beyond.rim, forward, image}, -1, nullptr};
  }

  // The border up to the rim, the edge in which the face beyond cuts the band, the border from the rim on.
  std::vector<Border> overflowing(const EdgeBlend& blend, const Beyond& beyond, double from, double to) {
    const int side = beyond.side;
    const SurfacePtr& surface = surgery_.draft.faces[beyond.face].surface;
    std::array<int, 2> vertices;
    std::array<BandOnCurve, 2> ends;
    std::array<Vec2, 2> places;
    for (int k = 0; k < 2; ++k) {
      vertices[k] = surgery_.vertex_at(beyond.points[k]);
      ends[k] = {beyond.s[k], static_cast<double>(side), 0, beyond.points[k]};
      const Edge& rim = body_.edges[beyond.rim];
      const bool at_end = rim.end == vertices[k];
      places[k] = place_on(body_, beyond.face, {beyond.rim, at_end}, parameter_of(body_, {beyond.rim, at_end}));
    }
    const Crossing cut = crossing_along(blend.band, surface, ends, places, surgery_.size, blend.edge.edge);
    const int edge = surgery_.draft.add_edge(cut.curve, vertices[0], vertices[1], surgery_.origin(blend, "overflow"));
    return {border_piece(blend, side, from, beyond.s[0], blend.vertices[0][side], vertices[0]),
            {{edge, true, cut.on_band}, beyond.face, cut.on_face},
            border_piece(blend, side, beyond.s[1], to, vertices[1], blend.vertices[1][side])};
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
      const auto beyond = beyonds_.find(blend.edge.edge);
      const bool is_cut = beyond != beyonds_.end() && beyond->second.kind == BeyondKind::overflow;
      const bool is_straight = !is_cut && std::abs(lo - blend.s[0][0]) + std::abs(hi - blend.s[1][0]) +
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
    std::vector<Body::Use> loop;
    for (const Border& piece : borders_[b][0]) loop.push_back(piece.use);
    loop.insert(loop.end(), blend.sections[1].begin(), blend.sections[1].end());
    for (auto piece = borders_[b][1].rbegin(); piece != borders_[b][1].rend(); ++piece)
      loop.push_back({piece->use.edge, !piece->use.forward, piece->use.image});
    for (auto use = blend.sections[0].rbegin(); use != blend.sections[0].rend(); ++use)
      loop.push_back({use->edge, !use->forward, use->image});
    return loop;
  }

  void widen_faces() {
    for (DraftFace& face : surgery_.draft.faces)
      if (face.trimmed && !reaches_loops(face))
        throw BlendError(surgery_.blends.front().edge.edge,
                         fmt::format("the surface of {} does not go on as far as the blend needs it",
                                     face.origin.text().empty() ? "a face" : face.origin.text()));
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
  Beyonds beyonds_;
  Surgery surgery_;
  std::map<int, CurvePtr> whole_;
  std::map<HalfEdge, std::map<int, Body::Use>> straddling_;  // by their place
  std::map<int, int> rims_;                                  // the blended edge beside each
  std::vector<std::array<std::vector<Border>, 2>> borders_;  // right, left: in the direction of the edge
};

// Requests and what is known of overruns, for a body some of whose edges have fallen into parts.
void renumber(const Divided& divided, std::vector<BlendRequest>& requests, Beyonds& beyonds) {
  for (BlendRequest& one : requests) {
    std::vector<int> edges;
    for (const int edge : one.edges) edges.insert(edges.end(), divided.parts[edge].begin(), divided.parts[edge].end());
    one.edges = std::move(edges);
  }
  Beyonds renumbered;
  for (const auto& [edge, beyond] : beyonds) {
    renumbered[divided.parts[edge].front()] = beyond;
    renumbered[divided.parts[edge].front()].rim = divided.parts[beyond.rim].front();
  }
  beyonds = std::move(renumbered);
}

}  // namespace

Stage blended_at_once(const Body& body, const std::vector<BlendRequest>& requests, Corners corners) {
  constexpr int kMaxOverruns = 16;
  Body divided_body;
  const Body* now = &body;
  std::vector<BlendRequest> asked = requests;
  Beyonds beyonds;
  std::vector<int> numbers(body.edges.size());
  for (size_t e = 0; e < numbers.size(); ++e) numbers[e] = static_cast<int>(e);
  try {
    for (int k = 0;; ++k) {
      Blending blending(*now, asked, corners, beyonds);
      const auto overrun = k < kMaxOverruns ? blending.overrun() : std::nullopt;
      if (!overrun) {
        Stage stage = blending.run();
        std::vector<int> edges;
        for (const int e : numbers) edges.push_back(e < 0 ? -1 : stage.edges[e]);
        stage.edges = std::move(edges);
        return stage;
      }
      Divided parts = divided(*now, overrun->first, overrun->second);
      renumber(parts, asked, beyonds);
      beyonds[parts.blended] = parts.beyond;
      for (int& e : numbers) e = e < 0 ? -1 : parts.parts[e].front();
      divided_body = std::move(parts.body);
      now = &divided_body;
    }
  } catch (BlendError& error) {
    error.name = name_of_edge(*now, error.edge);
    throw;
  } catch (const std::invalid_argument& reason) {
    // Curves and surfaces do not go as far as it asks of them.
    const auto one = std::find_if(asked.begin(), asked.end(), [](const BlendRequest& r) { return !r.edges.empty(); });
    if (one == asked.end()) throw;
    BlendError error(one->edges.front(),
                     fmt::format("there is no room for its blend, or one beside ({})", reason.what()));
    error.name = name_of_edge(*now, error.edge);
    throw error;
  }
}

}  // namespace lekalo::geometry
