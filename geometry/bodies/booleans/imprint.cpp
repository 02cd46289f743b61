#include "geometry/bodies/booleans/imprint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "geometry/bodies/booleans/boolean.h"
#include "geometry/bodies/booleans/coincidence.h"
#include "geometry/bodies/booleans/near_curve.h"
#include "geometry/bodies/booleans/same_sweep.h"
#include "geometry/bodies/primitives/construct.h"
#include "geometry/curves/operations/curve_part.h"
#include "geometry/queries/contours/contour_approximation.h"
#include "geometry/queries/contours/surface_intersection.h"
#include "geometry/queries/intersections/curve_intersections.h"
#include "geometry/queries/quadrics/canonical_surface.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/tolerances.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

// Of the size of both bodies: points nearer than this are one.
constexpr double kSameNode = 1e-8;
// Parts of the parameters of a face's border.
constexpr double kOnBorder = 1e-9;
// Of lengths: parameters of a plane that are so near to them are lengths.
constexpr double kRigid = 1e-13;
// A share of the domain that the image of a contour is near enough to where it cannot be known better: beside a place
// where surfaces touch.
constexpr double kNearSingular = 1e-12;

bool boxes_meet(const Box3& a, const Box3& b, double by) {
  for (int k = 0; k < 3; ++k)
    if (a.lo[k] - by > b.hi[k] || b.lo[k] - by > a.hi[k]) return false;
  return true;
}

Box3 common(const Box3& a, const Box3& b) { return {glm::max(a.lo, b.lo), glm::min(a.hi, b.hi)}; }

struct Cut {
  double t;
  int point;
};

struct EdgeData {
  std::shared_ptr<const NearCurve> near;
  std::vector<Cut> cuts;
  struct OnFace {
    int face;
    Interval t;
  };
  std::vector<OnFace> on_faces;  // of the other body
  std::vector<int> strands;      // in order along the edge
  std::vector<bool> backwards;   // the strand runs against it
};

struct FaceData {
  SurfacePtr support;  // for intersections: a plane goes on beyond its borders
  std::shared_ptr<const TrimRegion> region;
  std::vector<std::vector<TrimRegion::Part>> loops;
  Box3 box, plane_box;
  std::vector<int> edges;    // each once
  std::set<int> own, inner;  // strands
  std::vector<std::pair<int, Curve2Ptr>> inner_images;
};

class Imprinting {
 public:
  Imprinting(const Body& a, const Body& b) : bodies_{&a, &b} {
    for (const Body* body : bodies_) all_.include(bounds(*body));
    size_ = std::max(all_.diameter(), 1e-300);
    tolerance_ = kSameNode * size_;
    for (const int side : {0, 1}) prepare(side);
  }

  Imprint result() {
    find_coincident();
    for (const int side : {0, 1}) meet_edges(side);
    meet_faces();
    for (const int side : {0, 1}) cut_at_points(side);
    for (const int side : {0, 1}) split_edges(side);
    for (const int side : {0, 1}) lay_edges_on_faces(side);
    split_contours();
    for (const int side : {0, 1})
      for (size_t f = 0; f < faces_[side].size(); ++f) arrange(side, static_cast<int>(f));
    imprint_.tolerance = tolerance_;
    imprint_.lies_on.assign(imprint_.strands.size(), {false, false});
    for (const int side : {0, 1})
      for (const ImprintedFace& face : imprint_.faces[side])
        for (const DirectedCurve& curve : face.curves)
          if (curve.strand < static_cast<int>(imprint_.lies_on.size())) imprint_.lies_on[curve.strand][side] = true;
    return std::move(imprint_);
  }

 private:
  const Body& body(int side) const { return *bodies_[side]; }
  const Face& face(int side, int f) const { return bodies_[side]->faces[f]; }

  // ---- Preparation

  void prepare(int side) {
    const Body& of = body(side);
    for (const Vertex& vertex : of.vertices) point_of_vertex_[side].push_back(point(vertex.point, vertex.origin));
    for (const Edge& edge : of.edges) {
      EdgeData& data = edges_[side].emplace_back();
      if (edge.kind != EdgeKind::pole) data.near = std::make_shared<NearCurve>(edge.curve);
    }
    for (size_t f = 0; f < of.faces.size(); ++f) {
      FaceData& data = faces_[side].emplace_back();
      const Face& one = of.faces[f];
      data.support = support_of(one.surface);
      for (const int loop : one.loops) {
        data.loops.emplace_back();
        for (const int c : of.loops[loop].coedges) {
          const Coedge& coedge = of.coedges[c];
          data.loops.back().push_back({coedge.image, coedge.forward});
          data.plane_box.include(bounds(*coedge.image));
          if (std::find(data.edges.begin(), data.edges.end(), coedge.edge) == data.edges.end())
            data.edges.push_back(coedge.edge);
        }
      }
      data.region = std::make_shared<TrimRegion>(data.loops);
      data.box = bounds(of, static_cast<int>(f));
    }
    imprint_.faces[side].resize(of.faces.size());
  }

  // Borders of planes add nothing but chances for rounding; a plane that was turned is one.
  SurfacePtr support_of(const SurfacePtr& surface) const {
    const auto known = canonical(surface);
    if (!known || known->kind != CanonicalSurface::Kind::plane) return surface;
    const Mat3 axes = glm::transpose(known->to_local), square = known->to_local * axes;
    for (int k = 0; k < 3; ++k)
      if (glm::length(square[k] - Mat3(1)[k]) > kRigid) return surface;
    const Frame frame{known->origin, axes[0], axes[1], glm::cross(axes[0], axes[1])};
    const Vec3 center = frame.to_local_point(all_.center());
    const double reach = 1.37 * size_;
    return std::make_shared<Plane>(
        frame, Rectangle{{center.x - reach, center.x + reach}, {center.y - reach, center.y + reach}});
  }

  int point(const Vec3& at, const Origin& origin = {}) {
    int nearest = -1;
    double least = tolerance_;
    for (size_t k = 0; k < imprint_.points.size(); ++k)
      if (const double apart = glm::length(imprint_.points[k] - at); apart <= least)
        least = apart, nearest = static_cast<int>(k);
    if (nearest >= 0) return nearest;
    imprint_.points.push_back(at);
    imprint_.origins.push_back(origin);
    return static_cast<int>(imprint_.points.size()) - 1;
  }

  // The parameters of a place in the period in which the loops of the face are, or near it.
  std::optional<Vec2> in_region(int side, int f, const Vec2& uv, double slack) const {
    const FaceData& data = faces_[side][f];
    const Periods periods = face(side, f).surface->periods();
    const double wide = slack * data.plane_box.diameter();
    const auto shifts = [&](double period, double at, double lo, double hi) {
      std::vector<double> result;
      if (!(period > 0)) return std::vector<double>{0};
      for (double by = period * std::floor((lo - at) / period - 0.01); at + by <= hi + 0.01 * period; by += period)
        if (at + by >= lo - 0.01 * period) result.push_back(by);
      return result;
    };
    const Box3& box = data.plane_box;
    for (const double du : shifts(periods.u, uv.x, box.lo.x, box.hi.x))
      for (const double dv : shifts(periods.v, uv.y, box.lo.y, box.hi.y))
        if (data.region->contains(uv.x + du, uv.y + dv, wide)) return Vec2(uv.x + du, uv.y + dv);
    return std::nullopt;
  }

  bool is_edge(int side, int e) const { return body(side).edges[e].kind != EdgeKind::pole; }

  // ---- What meets what

  bool is_coincident(int f, int g) const { return coincident_.count({f, g}) != 0; }
  void set_coincident(int f, int g) {
    if (!coincident_.insert({f, g}).second) return;
    imprint_.faces[0][f].coincident.push_back(g);
    imprint_.faces[1][g].coincident.push_back(f);
  }

  template <class Visit>
  void for_pairs(Visit&& visit) {
    for (size_t f = 0; f < faces_[0].size(); ++f)
      for (size_t g = 0; g < faces_[1].size(); ++g)
        if (boxes_meet(faces_[0][f].box, faces_[1][g].box, tolerance_)) visit(static_cast<int>(f), static_cast<int>(g));
  }

  void find_coincident() {
    for_pairs([&](int f, int g) {
      const Box3 shared = common(faces_[0][f].box, faces_[1][g].box);
      const double reach = std::max(faces_[0][f].box.diameter(), faces_[1][g].box.diameter());
      const auto same = have_same_equation(face(0, f).surface, face(1, g).surface, shared.center(), reach, tolerance_);
      if (same.value_or(false)) set_coincident(f, g);
    });
  }

  void cut(int side, int e, double t, int at) { edges_[side][e].cuts.push_back({t, at}); }

  // Edges of one body on faces of the other.
  void meet_edges(int side) {
    const int other = 1 - side;
    for (size_t e = 0; e < edges_[side].size(); ++e) {
      if (!is_edge(side, static_cast<int>(e))) continue;
      EdgeData& edge = edges_[side][e];
      const CurvePtr& curve = body(side).edges[e].curve;
      for (size_t f = 0; f < faces_[other].size(); ++f) {
        const FaceData& on = faces_[other][f];
        if (!boxes_meet(edge.near->box(), on.box, tolerance_)) continue;
        if (lies_on_same_equation(side, static_cast<int>(e), static_cast<int>(f))) {
          edge.on_faces.push_back({static_cast<int>(f), curve->domain()});
          meet_border(side, static_cast<int>(e), static_cast<int>(f));
          continue;
        }
        const SurfaceIntersections found = intersect(*curve, *on.support);
        for (const SurfaceIntersection& hit : found.points)
          if (in_region(other, static_cast<int>(f), {hit.u, hit.v}, kOnBorder))
            cut(side, static_cast<int>(e), hit.t, point(hit.point));
        for (const Interval& part : found.on_surface) {
          edge.on_faces.push_back({static_cast<int>(f), part});
          for (const double t : {part.lo, part.hi})
            if (t > curve->domain().lo && t < curve->domain().hi)
              cut(side, static_cast<int>(e), t, point(curve->point(t)));
          meet_border(side, static_cast<int>(e), static_cast<int>(f));
        }
      }
    }
  }

  // An edge of a face that coincides with that of the other body lies on it.
  bool lies_on_same_equation(int side, int e, int f) const {
    for (const int c : body(side).edges[e].coedges) {
      const int own = body(side).loops[body(side).coedges[c].loop].face;
      if (is_coincident(side == 0 ? own : f, side == 0 ? f : own)) return true;
    }
    return false;
  }

  // An edge that lies on a face's surface meets the face's edges there.
  void meet_border(int side, int e, int f) {
    const int other = 1 - side;
    const CurvePtr& curve = body(side).edges[e].curve;
    for (const int b : faces_[other][f].edges) {
      if (!is_edge(other, b) || !met_.insert({side, e, b}).second) continue;
      if (!boxes_meet(edges_[side][e].near->box(), edges_[other][b].near->box(), tolerance_)) continue;
      const CurvePtr& border = body(other).edges[b].curve;
      const CurveIntersections found = intersect(*curve, *border);
      for (const CurveIntersection& hit : found.points) {
        const int at = point(hit.point);
        cut(side, e, hit.s, at);
        cut(other, b, hit.t, at);
      }
      for (const CommonPart& part : found.common)
        for (const bool end : {false, true}) {
          const double s = end ? part.s.hi : part.s.lo, t = end ? part.end : part.begin;
          const int at = point(curve->point(s));
          cut(side, e, s, at);
          cut(other, b, t, at);
        }
    }
  }

  void meet_faces() {
    for_pairs([&](int f, int g) {
      if (is_coincident(f, g) || sweeps_meet_at_borders(face(0, f).surface, face(1, g).surface, tolerance_)) return;
      const Contours found = intersect(faces_[0][f].support, faces_[1][g].support);
      if (found.coincident) {
        set_coincident(f, g);
        return;
      }
      if (!found.complete)
        throw BooleanError("two faces nearly touch or nearly coincide: whether they meet is not decided",
                           common(faces_[0][f].box, faces_[1][g].box).center());
      for (const ContourPoint& singular : found.points) {
        const std::vector<double>& at = singular.parameters;
        if (singular.kind == ContourPointKind::end || at.size() != 4) continue;
        if (in_region(0, f, {at[0], at[1]}, kOnBorder) && in_region(1, g, {at[2], at[3]}, kOnBorder))
          point(singular.point);
      }
      // Where surfaces only touch neither goes on inside of the other.
      for (const Contour& contour : found.branches)
        if (contour.kind == ContourKind::crossing) contours_.push_back({f, g, contour});
    });
  }

  // Points that are known from elsewhere lie on edges: vertices on edges, edges that touch.
  void cut_at_points(int side) {
    for (size_t e = 0; e < edges_[side].size(); ++e) {
      if (!is_edge(side, static_cast<int>(e))) continue;
      EdgeData& edge = edges_[side][e];
      const Edge& of = body(side).edges[e];
      std::set<int> known{point_of_vertex_[side][of.start], point_of_vertex_[side][of.end]};
      for (const Cut& one : edge.cuts) known.insert(one.point);
      for (size_t k = 0; k < imprint_.points.size(); ++k) {
        if (known.count(static_cast<int>(k)) != 0) continue;
        if (const auto t = edge.near->place_of(imprint_.points[k], tolerance_))
          cut(side, static_cast<int>(e), *t, static_cast<int>(k));
      }
    }
  }

  // ---- Strands

  // Cuts in order without those that are one, both ends among them.
  static std::vector<Cut> in_order(std::vector<Cut> cuts, const Cut& begin, const Cut& end, double least) {
    std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) { return a.t < b.t; });
    std::vector<Cut> result{begin};
    for (const Cut& one : cuts) {
      if (one.t - result.back().t <= least) continue;
      if (end.t - one.t <= least) break;
      result.push_back(one);
    }
    result.push_back(end);
    return result;
  }

  int add_strand(Strand strand) {
    const int index = static_cast<int>(imprint_.strands.size());
    if (strand.kind != EdgeKind::pole) by_ends_[ends_of(strand)].push_back(index);
    imprint_.strands.push_back(std::move(strand));
    near_.emplace_back();
    return index;
  }
  static std::pair<int, int> ends_of(const Strand& strand) {
    return {std::min(strand.from, strand.to), std::max(strand.from, strand.to)};
  }
  static double middle_of(const Curve& curve) {
    // No place of symmetry, so that arcs of one circle are told apart.
    return curve.domain().lo + 0.4871 * curve.domain().width();
  }
  // A strand in the same place, and whether it runs the other way.
  std::optional<std::pair<int, bool>> known_strand(const Strand& strand) {
    const auto found = by_ends_.find(ends_of(strand));
    if (found == by_ends_.end()) return std::nullopt;
    const CurveJet at = strand.curve->evaluate(middle_of(*strand.curve), 1);
    for (const int k : found->second) {
      const Strand& known = imprint_.strands[k];
      if (!near_[k]) near_[k] = std::make_shared<NearCurve>(known.curve);
      const auto t = near_[k]->place_of(at.d[0], 4 * tolerance_);
      if (!t) continue;
      const bool against = glm::dot(known.curve->evaluate(*t, 1).d[1], at.d[1]) < 0;
      return std::pair(k, against);
    }
    return std::nullopt;
  }

  void split_edges(int side) {
    for (size_t e = 0; e < edges_[side].size(); ++e) {
      const Edge& of = body(side).edges[e];
      EdgeData& edge = edges_[side][e];
      const Interval domain = of.curve->domain();
      const Cut begin{domain.lo, point_of_vertex_[side][of.start]}, end{domain.hi, point_of_vertex_[side][of.end]};
      std::vector<Cut> cuts{begin, end};
      if (is_edge(side, static_cast<int>(e)))
        cuts = in_order(edge.cuts, begin, end, 2 * tolerance_ / edge.near->length() * domain.width());
      for (size_t k = 0; k + 1 < cuts.size(); ++k) {
        Strand strand;
        strand.curve =
            cuts.size() == 2 ? of.curve : std::make_shared<CurvePart>(of.curve, Interval(cuts[k].t, cuts[k + 1].t));
        strand.from = cuts[k].point;
        strand.to = cuts[k + 1].point;
        strand.kind = of.kind;
        strand.origin = of.origin;
        strand.edge[side] = static_cast<int>(e);
        const auto known = of.kind == EdgeKind::pole || side == 0 ? std::nullopt : known_strand(strand);
        if (known) imprint_.strands[known->first].edge[side] = static_cast<int>(e);
        edge.strands.push_back(known ? known->first : add_strand(std::move(strand)));
        edge.backwards.push_back(known && known->second);
      }
    }
  }

  void add_own(int side, int f) {
    const Body& of = body(side);
    FaceData& data = faces_[side][f];
    ImprintedFace& result = imprint_.faces[side][f];
    const bool left = side_of(face(side, f)) > 0;
    for (const int loop : of.faces[f].loops)
      for (const int c : of.loops[loop].coedges) {
        const Coedge& coedge = of.coedges[c];
        const EdgeData& edge = edges_[side][coedge.edge];
        for (size_t k = 0; k < edge.strands.size(); ++k) {
          const Strand& strand = imprint_.strands[edge.strands[k]];
          data.own.insert(edge.strands[k]);
          DirectedCurve curve;
          curve.strand = edge.strands[k];
          curve.forward = (coedge.forward != edge.backwards[k]) == left;
          curve.from = curve.forward ? strand.from : strand.to;
          curve.to = curve.forward ? strand.to : strand.from;
          curve.image = side == 1 && strand.edge[0] >= 0 ? image_instead(side, f, coedge, strand, edge)
                                                         : part_of(coedge.image, strand.curve->domain());
          result.curves.push_back(std::move(curve));
        }
      }
  }

  static Curve2Ptr part_of(const Curve2Ptr& image, const Interval& t) {
    const Interval whole = image->domain();
    if (t.lo <= whole.lo && t.hi >= whole.hi) return image;
    return std::make_shared<CurvePart>(image, Interval(std::max(t.lo, whole.lo), std::min(t.hi, whole.hi)));
  }

  // The image of an edge that is replaced by one of the first body, with that one's parameter.
  Curve2Ptr image_instead(int side, int f, const Coedge& coedge, const Strand& strand, const EdgeData& edge) {
    const Curve2Ptr image = image_of(side, f, strand);
    // The copy that lies where the edge's own image is.
    const Vec3 middle = strand.curve->point(middle_of(*strand.curve));
    const auto t = edge.near->place_of(middle, 10 * tolerance_);
    if (!t) throw BooleanError("two edges that seem to coincide do not", middle);
    return moved_to(side, f, image, middle_of(*strand.curve), Vec2(coedge.image->point(*t)));
  }

  Curve2Ptr image_of(int side, int f, const Strand& strand) const {
    const Curve2Ptr image = image_on(face(side, f).surface, strand.curve);
    if (!image)
      throw BooleanError("an edge of one body lies on a face of the other in a way that is not followed",
                         strand.curve->point(middle_of(*strand.curve)));
    return image;
  }

  Curve2Ptr moved_to(int side, int f, const Curve2Ptr& image, double t, const Vec2& to) const {
    const Periods periods = face(side, f).surface->periods();
    const Vec2 at(image->point(t));
    Vec3 by(0);
    if (periods.u > 0) by.x = periods.u * std::round((to.x - at.x) / periods.u);
    if (periods.v > 0) by.y = periods.v * std::round((to.y - at.y) / periods.v);
    return by == Vec3(0) ? image : transformed(image, Affine::translation(by));
  }

  // Parts of edges that lie in a face of the other body.
  void lay_edges_on_faces(int side) {
    const int other = 1 - side;
    for (EdgeData& edge : edges_[side])
      for (const EdgeData::OnFace& on : edge.on_faces) {
        const std::set<int> own = strands_of_border(other, on.face);
        for (const int k : edge.strands) {
          const Strand& strand = imprint_.strands[k];
          if (own.count(k) != 0 || faces_[other][on.face].inner.count(k) != 0) continue;
          // A strand of the first body has that one's parameter: where it lies is asked in space.
          const auto t = edge.near->place_of(strand.curve->point(middle_of(*strand.curve)), 10 * tolerance_);
          if (!t || !on.t.contains(*t) || !is_in_face(other, on.face, edge.near->point(*t))) continue;
          add_inner(other, on.face, k, image_of(other, on.face, strand));
        }
      }
  }

  bool is_in_face(int side, int f, const Vec3& p) const {
    const SurfacePtr& surface = face(side, f).surface;
    const Vec2 uv = parameters_on(surface, p);
    const auto place = in_region(side, f, uv, kOnBorder);
    return place && glm::length(surface->point(place->x, place->y) - p) <= 10 * tolerance_;
  }

  std::set<int> strands_of_border(int side, int f) const {
    std::set<int> result;
    for (const int e : faces_[side][f].edges)
      result.insert(edges_[side][e].strands.begin(), edges_[side][e].strands.end());
    return result;
  }

  // False where the strand is not in the face.
  bool add_inner(int side, int f, int strand, const Curve2Ptr& image) {
    const double t = middle_of(*image);
    const auto uv = in_region(side, f, Vec2(image->point(t)), 0);
    if (!uv) return false;
    FaceData& data = faces_[side][f];
    if (!data.inner.insert(strand).second) return true;
    data.inner_images.emplace_back(strand, moved_to(side, f, image, t, *uv));
    return true;
  }

  void split_contours() {
    for (const auto& [f, g, contour] : contours_) {
      const auto [curve, images] =
          contour_approximation(contour, {face(0, f).surface.get(), face(1, g).surface.get()}, kNearSingular);
      const NearCurve near(curve);
      // A point: the surfaces touch there.
      if (near.length() <= 8 * tolerance_) continue;
      const Interval domain = curve->domain();
      std::vector<Cut> cuts;
      for (size_t k = 0; k < imprint_.points.size(); ++k)
        for (const double t : near.places_of(imprint_.points[k], tolerance_)) cuts.push_back({t, static_cast<int>(k)});
      const double least = 2 * tolerance_ / near.length() * domain.width();
      const auto end_point = [&](double t) {
        for (const Cut& one : cuts)
          if (std::abs(one.t - t) <= least) return one.point;
        return -1;
      };
      // Ends that nothing is known of lie outside of the faces, or begin a strand of their own.
      const Cut begin{domain.lo, end_point(domain.lo)}, end{domain.hi, end_point(domain.hi)};
      cuts = in_order(cuts, begin, end, least);
      for (size_t k = 0; k + 1 < cuts.size(); ++k) add_stretch(f, g, curve, images, cuts[k], cuts[k + 1]);
    }
  }

  void add_stretch(int f, int g, const CurvePtr& curve, const std::array<Curve2Ptr, 2>& images, Cut begin, Cut end) {
    const Interval t{begin.t, end.t};
    const double middle = t.lo + 0.4871 * t.width();
    const auto in_f = in_region(0, f, Vec2(images[0]->point(middle)), kOnBorder),
               in_g = in_region(1, g, Vec2(images[1]->point(middle)), kOnBorder);
    if (!in_f || !in_g) return;
    if (const auto edge = edge_through(f, g, curve->point(middle))) {
      add_known(0, f, *edge);
      add_known(1, g, *edge);
      return;
    }
    if (begin.point < 0) begin.point = point(curve->point(begin.t));
    if (end.point < 0) end.point = point(curve->point(end.t));
    Strand strand;
    strand.curve = curve_over(curve, t);
    strand.from = begin.point;
    strand.to = end.point;
    if (const auto known = known_strand(strand)) {
      add_known(0, f, known->first);
      add_known(1, g, known->first);
      return;
    }
    const int index = add_strand(std::move(strand));
    const Curve2Ptr on_f = simple_part(0, f, images[0], t), on_g = simple_part(1, g, images[1], t);
    const bool in_both = add_inner(0, f, index, on_f) && add_inner(1, g, index, on_g);
    if (!in_both)
      throw BooleanError("a curve of intersection runs along the border of a face but not on it", curve->point(middle));
  }

  // Of one that solves its equations anew everywhere trims would never find monotone parts.
  Curve2Ptr simple_part(int side, int f, const Curve2Ptr& image, const Interval& t) const {
    const Curve2Ptr part = part_of(image, t), simple = simple_image(*face(side, f).surface, part);
    if (simple == part && !part->pieces().front().is_rational())
      throw BooleanError("two faces touch or nearly touch on a curve in which they meet: it is not known well enough",
                         face(side, f).surface->point(part->point(t.lo).x, part->point(t.lo).y));
    return simple;
  }

  // The part of an edge, on the border or inside of either face, that a point lies on.
  std::optional<int> edge_through(int f, int g, const Vec3& p) {
    std::set<int> candidates = strands_of_border(0, f);
    candidates.merge(strands_of_border(1, g));
    candidates.insert(faces_[0][f].inner.begin(), faces_[0][f].inner.end());
    candidates.insert(faces_[1][g].inner.begin(), faces_[1][g].inner.end());
    for (const int k : candidates) {
      const Strand& strand = imprint_.strands[k];
      if (strand.kind == EdgeKind::pole || (strand.edge[0] < 0 && strand.edge[1] < 0)) continue;
      if (!near_[k]) near_[k] = std::make_shared<NearCurve>(strand.curve);
      if (near_[k]->place_of(p, 4 * tolerance_)) return k;
    }
    return std::nullopt;
  }

  // A curve of intersection that is a known edge.
  void add_known(int side, int f, int strand) {
    if (strands_of_border(side, f).count(strand) != 0 || faces_[side][f].inner.count(strand) != 0) return;
    add_inner(side, f, strand, image_of(side, f, imprint_.strands[strand]));
  }

  // ---- Faces

  void arrange(int side, int f) {
    add_own(side, f);
    FaceData& data = faces_[side][f];
    ImprintedFace& result = imprint_.faces[side][f];
    for (const auto& [k, image] : data.inner_images) {
      if (data.own.count(k) != 0) continue;
      const Strand& strand = imprint_.strands[k];
      result.curves.push_back({k, true, strand.from, strand.to, image, true});
      result.curves.push_back({k, false, strand.to, strand.from, image, true});
    }
    split_poles(side, f);
  }

  // Curves that run into a pole end somewhere on its edge.
  void split_poles(int side, int f) {
    std::vector<DirectedCurve>& curves = imprint_.faces[side][f].curves;
    const double size = faces_[side][f].plane_box.diameter();
    std::vector<DirectedCurve> result;
    for (const DirectedCurve& pole : curves) {
      if (imprint_.strands[pole.strand].kind != EdgeKind::pole) {
        result.push_back(pole);
        continue;
      }
      const NearCurve near(pole.image);
      std::vector<Cut> cuts;
      for (const DirectedCurve& curve : curves)
        if (curve.inner && curve.from == pole.from)
          if (const auto t = near.place_of(Vec3(curve.begin(), 0), 1e-6 * size)) cuts.push_back({*t, pole.from});
      const Interval domain = pole.image->domain();
      cuts = in_order(cuts, {domain.lo, pole.from}, {domain.hi, pole.to}, 1e-9 * domain.width());
      if (cuts.size() == 2) {
        result.push_back(pole);
        continue;
      }
      for (size_t k = 0; k + 1 < cuts.size(); ++k) {
        const Interval t{cuts[k].t, cuts[k + 1].t};
        Strand part = imprint_.strands[pole.strand];
        part.curve = point_curve(t, imprint_.points[pole.from]);
        DirectedCurve curve = pole;
        curve.strand = add_strand(std::move(part));
        curve.image = part_of(pole.image, t);
        result.push_back(std::move(curve));
      }
    }
    curves = std::move(result);
  }

  struct FacesContour {
    int f, g;
    Contour contour;
  };

  std::array<const Body*, 2> bodies_;
  Box3 all_;
  double size_ = 0, tolerance_ = 0;
  Imprint imprint_;
  std::array<std::vector<int>, 2> point_of_vertex_;
  std::array<std::vector<EdgeData>, 2> edges_;
  std::array<std::vector<FaceData>, 2> faces_;
  std::set<std::pair<int, int>> coincident_;
  std::set<std::array<int, 3>> met_;
  std::vector<FacesContour> contours_;
  std::map<std::pair<int, int>, std::vector<int>> by_ends_;
  std::vector<std::shared_ptr<const NearCurve>> near_;
};

}  // namespace

double side_of(const Face& face) { return face.forward == (face.surface->normal_sign() > 0) ? 1 : -1; }

Imprint imprint(const Body& a, const Body& b) { return Imprinting(a, b).result(); }

}  // namespace lekalo::geometry
