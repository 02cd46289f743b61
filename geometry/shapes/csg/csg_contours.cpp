#include "geometry/shapes/csg/csg_contours.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>

#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/operations/curve_part.h"
#include "geometry/curves/operations/curve_sign_changes.h"
#include "geometry/queries/closest/closest_point.h"
#include "geometry/queries/contours/body_contours.h"
#include "geometry/queries/contours/contour_approximation.h"
#include "geometry/queries/contours/level_section.h"
#include "geometry/queries/contours/silhouette_crossings.h"
#include "geometry/queries/implicit_curves/implicit_arcs.h"
#include "geometry/queries/intersections/curve_entries.h"
#include "geometry/queries/intersections/curve_intersections.h"
#include "geometry/queries/quadrics/canonical_surface.h"
#include "geometry/shapes/csg/csg_boundary.h"
#include "geometry/shapes/csg/csg_leaves.h"
#include "geometry/shapes/implicit/implicit_contours.h"
#include "geometry/shapes/tube/ball_outlines.h"
#include "geometry/shapes/tube/tube_lines.h"
#include "geometry/spatial/box_tree.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

using Kind = CsgLine::Kind;

// Planes at a smaller angle have no line in common.
constexpr double kParallel = 1e-6;
// Parts of a line shorter than this, of its domain, are none.
constexpr double kShortest = 1e-9;
// Where in a stretch the solid is asked: not half way, where lines of symmetric solids cross themselves.
constexpr double kAskedAt = 0.4721;

// Normals and directions that are so far from parallel, or from a right angle, belong to another face.
constexpr double kOtherFace = 1e-3;

// Lines that are so near, of the solid's size, are one: where leaves end flush each has the edge.
constexpr double kSameLine = 1e-9;

// A line of a leaf, or of two, before it is known what of it is on the boundary.
struct Candidate {
  CsgLine line;
  std::vector<int> own;    // the leaves on which it lies
  int face = -1, of = -1;  // on that face of a body only, which is not one of `own`
  bool touching = false;   // surfaces touch along it
  bool smooth = false;     // two faces of one body go on smoothly in one another
  double reach = 1;        // how far the line goes
};

class Lines {
 public:
  Lines(const Csg& solid, const ViewOf& view)
      : solid_(solid), view_(view), box_(solid.bounds()), size_(box_.diameter()), leaves_(csg_leaves(solid)) {}

  CsgLines find(const CsgLines* known) {
    if (known && known->complete && !has_shapes()) {
      result_ = *known;
      std::erase_if(result_.lines, [](const CsgLine& line) { return line.kind == Kind::silhouette; });
    } else {
      for (int k = 0; k < count(); ++k) add_edges(k);
      for (int k = 0; k < count(); ++k)
        for (int m = k + 1; m < count(); ++m) add_intersection(k, m);
    }
    for (int k = 0; k < count(); ++k) add_silhouettes(k);
    return std::move(result_);
  }

  // Of each leaf, as far as its side of the section is the solid's.
  CsgLines section(const Vec3& origin, const Vec3& normal) {
    const auto plane = std::make_shared<Plane>(frame_about(origin, glm::normalize(normal)));
    for (int k = 0; k < count(); ++k) {
      const CsgLeaf& leaf = leaves_[k];
      const Candidate asked{{nullptr, Kind::section, {}, {}, nullptr}, all_of(k)};
      if (leaf.plane)
        add_planes(leaf.plane, plane, asked);
      else if (leaf.body && !leaf.is_region)
        add(plane_section(*leaf.body, origin, normal), *leaf.body, nullptr, asked);
      else if (leaf.shape)
        add_section_of_shape(k, origin, normal, asked);
    }
    return std::move(result_);
  }

  CsgLines parameter_lines(const ParameterNet& net) {
    std::set<int> of_tubes;
    for (const CsgTube& one : csg_tubes(solid_)) {
      of_tubes.insert(one.leaves.begin(), one.leaves.end());
      add(TubeBoundary(*one.tube).parameter_lines(net, view_of(one.map)), one.map, true,
          {{nullptr, Kind::parameter, {}, {}, nullptr}, one.leaves});
    }
    for (int k = 0; k < count(); ++k) {
      const CsgLeaf& leaf = leaves_[k];
      if (leaf.plane) result_.left_out.insert("parameter lines of half-spaces");
      if (leaf.implicit) result_.left_out.insert("parameter lines of implicit surfaces");
      if (!leaf.body || leaf.is_region || of_tubes.count(k) > 0) continue;
      for (const NetLine& line : geometry::parameter_lines(*leaf.body, net))
        add({{line.curve(), Kind::parameter, {{line.surface, line.image()}}, {}, nullptr}, all_of(k)});
    }
    return std::move(result_);
  }

 private:
  int count() const { return static_cast<int>(leaves_.size()); }
  bool has_shapes() const {
    return std::any_of(leaves_.begin(), leaves_.end(), [](const CsgLeaf& leaf) { return leaf.shape != nullptr; });
  }

  // Of an implicit leaf its region too, of a piece of a tube its ends: they cut nothing of its lines.
  std::vector<int> all_of(int k) const {
    std::vector<int> all = leaves_[k].ends;
    all.push_back(k);
    if (leaves_[k].region >= 0) all.push_back(leaves_[k].region);
    return all;
  }
  bool belong_together(int k, int m) const {
    const std::vector<int>& ends = leaves_[k].ends;
    return leaves_[k].region == m || std::find(ends.begin(), ends.end(), m) != ends.end();
  }

  ViewOf view_of(const CsgLeaf& leaf) const { return view_of(leaf.map); }
  ViewOf view_of(const Affine& map) const {
    const Affine back = map.inverse();
    ViewOf view = view_;
    view.direction_or_eye =
        view.central ? back.point(view.direction_or_eye) : glm::normalize(back.direction(view.direction_or_eye));
    return view;
  }

  void add_edges(int k) {
    const CsgLeaf& leaf = leaves_[k];
    const Candidate sharp{{nullptr, Kind::sharp, {}, {}, nullptr}, all_of(k)};
    if (leaf.implicit) {
      add(border(*leaf.implicit, view_of(leaf)), leaf.map, sharp);
      add(creases(*leaf.implicit, view_of(leaf)), leaf.map, sharp);
    }
    if (leaf.tube) {
      add(tube_outlines(leaf), leaf.map, true, sharp);
      const TubeBoundary::Edges own = boundary_of(k).edges(view_of(leaf));
      add(own.lines, leaf.map, true, sharp);
      if (!own.all_known) result_.left_out.insert("some edges along which a tube goes through itself");
    }
    if (!leaf.body || leaf.is_region) return;
    const Body& body = *leaf.body;
    for (const Edge& edge : body.edges) {
      if (edge.kind != EdgeKind::regular || !edge.curve) continue;
      Candidate found = sharp;
      found.line.curve = edge.curve;
      for (const int c : edge.coedges) {
        const Coedge& coedge = body.coedges[c];
        found.line.supporting_surfaces.push_back({body.faces[body.loops[coedge.loop].face].surface, coedge.image});
      }
      found.smooth = is_smooth(found.line);
      add(std::move(found));
    }
  }

  static bool is_smooth(const CsgLine& line) {
    constexpr double kSmooth = 1e-3;
    if (line.supporting_surfaces.size() != 2) return false;
    const Interval domain = line.curve->domain();
    for (const double x : {0.23, kAskedAt, 0.81}) {
      const auto normal = [&](int which) {
        const Vec3 uv = line.supporting_surfaces[which].image->point(domain.lo + x * domain.width());
        return line.supporting_surfaces[which].surface->normal(uv.x, uv.y);
      };
      if (glm::length(glm::cross(normal(0), normal(1))) > kSmooth) return false;
    }
    return true;
  }

  void add_silhouettes(int k) {
    const CsgLeaf& leaf = leaves_[k];
    const Candidate asked{{nullptr, Kind::silhouette, {}, {}, nullptr}, all_of(k)};
    if (leaf.body && !leaf.is_region) add(silhouette(*leaf.body, view_), *leaf.body, nullptr, asked);
    if (leaf.implicit) add(silhouette(*leaf.implicit, view_of(leaf)), leaf.map, asked);
    if (leaf.tube) add(tube_outlines(leaf), leaf.map, false, asked);
  }
  ShapeOutlines tube_outlines(const CsgLeaf& leaf) const { return outlines(*leaf.tube, view_of(leaf)); }

  // Where the boundaries of two leaves meet.
  void add_intersection(int k, int m) {
    if (!BoxTree::meets(leaves_[k].box, leaves_[m].box) || belong_together(k, m) || belong_together(m, k)) return;
    // A shape is the first, then a body.
    if ((leaves_[m].shape && !leaves_[k].shape) || (leaves_[k].plane && !leaves_[m].plane)) std::swap(k, m);
    const CsgLeaf &a = leaves_[k], &b = leaves_[m];
    Candidate asked{{nullptr, Kind::sharp, {}, {}, nullptr}, all_of(k)};
    asked.own.push_back(m);
    try {
      if (a.plane)
        add_planes(a.plane, b.plane, asked);
      else if (a.shape && b.plane)
        add_section_of_shape(k, b.plane->frame().origin, b.plane->frame().z, asked);
      else if (a.shape && b.body)
        add_intersection_of_shape(k, m);
      else if (a.implicit && b.implicit)
        add_intersection_of_implicit(k, m);
      else if (a.shape && b.shape)
        add_intersection_of_tube(a.tube ? k : m, a.tube ? m : k, asked);
      else if (b.body)
        add(intersect(*a.body, *b.body), *a.body, b.body.get(), asked);
      else
        add(plane_section(*a.body, b.plane->frame().origin, b.plane->frame().z), *a.body, nullptr, asked);
    } catch (const std::invalid_argument&) {
      result_.complete = false;
    }
  }

  // With the faces of a body, as far as the whole surfaces go: where they are no faces the solid has no edge.
  void add_intersection_of_shape(int k, int m) {
    const CsgLeaf &leaf = leaves_[k], &other = leaves_[m];
    for (int f = 0; f < static_cast<int>(other.body->faces.size()); ++f) {
      const SurfacePtr& surface = other.body->faces[f].surface;
      if (!BoxTree::meets(bounds(*surface), leaf.box)) continue;
      const Candidate asked{{nullptr, Kind::sharp, {}, {}, nullptr}, {k}, f, m};
      if (leaf.implicit) {
        const Contours found = level_section(surface, leaf.implicit->formula(), leaf.map.inverse());
        if (!found.complete) result_.complete = false;
        for (const Contour& contour : found.branches) {
          Candidate one = asked;
          one.line.curve = contour.curve;
          one.line.supporting_surfaces.push_back({surface, contour.images[0]});
          one.touching = contour.kind == ContourKind::touching;
          add_turns(leaf, contour.closed, one.line);
          add(std::move(one));
        }
      } else if (const auto plane = canonical(surface); plane && plane->kind == CanonicalSurface::Kind::plane) {
        add_section_of_shape(k, plane->origin, plane->normal(), asked);
      } else if (leaf.tube) {
        const Affine back = leaf.map.inverse();
        const ShapeOutlines found = boundary_of(k).intersection(transformed(surface, back), view_of(leaf));
        if (!found.complete) result_.complete = false;
        for (const ShapeOutline& line : found.lines) {
          Candidate one = asked;
          one.line.supporting_surfaces.push_back({surface, line.image});
          add(line.curve, nullptr, line.turns, leaf.map, std::move(one));
        }
      }
    }
  }

  // A tube and another one, or an implicit leaf.
  void add_intersection_of_tube(int k, int m, const Candidate& asked) {
    const CsgLeaf &leaf = leaves_[k], &other = leaves_[m];
    const Affine to_other = other.map.inverse() * leaf.map;
    const ViewOf view = view_of(leaf);
    const ShapeOutlines found = other.tube ? boundary_of(k).intersection(boundary_of(m), to_other.inverse(), view)
                                           : boundary_of(k).intersection(other.implicit->formula(), to_other, view);
    if (!found.complete) result_.complete = false;
    for (const ShapeOutline& line : found.lines) {
      Candidate one = asked;
      one.line.curve = transformed(line.curve, leaf.map);
      one.line.turns = line.turns;
      if (other.implicit) add_turns(other, false, one.line);
      add(std::move(one));
    }
  }
  const TubeBoundary& boundary_of(int k) { return tubes_.try_emplace(k, *leaves_[k].tube).first->second; }

  void add_intersection_of_implicit(int k, int m) {
    const CsgLeaf &a = leaves_[k], &b = leaves_[m];
    const Affine back = a.map.inverse();
    const ImplicitCondition other = ImplicitCondition::other(b.implicit->formula(), b.map.inverse() * a.map);
    // Where both are.
    Box3 box = transformed(b.box, back);
    const Box3 own = a.implicit->bounds();
    box.lo = glm::max(box.lo, own.lo), box.hi = glm::min(box.hi, own.hi);
    for (int axis = 0; axis < 3; ++axis)
      if (!(box.lo[axis] < box.hi[axis])) return;
    const ImplicitArcs found = implicit_arcs(a.implicit->formula(), a.implicit->region(), other, box);
    if (!found.complete) result_.complete = false;
    for (const ImplicitArc& arc : found.arcs) {
      Candidate one{{transformed(arc.curve, a.map), Kind::sharp, {}, {}, nullptr}, {k, m}};
      add_turns(a, arc.closed, one.line);
      add_turns(b, arc.closed, one.line);
      add(std::move(one));
    }
  }

  // Where an implicit leaf turns away along a line on it.
  void add_turns(const CsgLeaf& leaf, bool closed, CsgLine& line) const {
    line.curve = contour_approximation(line.curve);
    const std::vector<double> turns = silhouette_crossings(*transformed(line.curve, leaf.map.inverse()), closed,
                                                           leaf.implicit->formula(), view_of(leaf));
    line.turns.insert(line.turns.end(), turns.begin(), turns.end());
  }

  void add_section_of_shape(int k, const Vec3& through, const Vec3& across, const Candidate& asked) {
    const CsgLeaf& leaf = leaves_[k];
    const Vec3 origin = leaf.map.inverse().point(through), normal = glm::transpose(leaf.map.linear) * across;
    if (leaf.implicit) add(plane_section(*leaf.implicit, origin, normal, view_of(leaf)), leaf.map, asked);
    if (leaf.tube) add(plane_section(*leaf.tube, origin, normal, view_of(leaf)), leaf.map, true, asked);
  }

  // The line of two planes within the solid's box.
  void add_planes(const std::shared_ptr<const Plane>& first, const std::shared_ptr<const Plane>& second,
                  Candidate asked) {
    const Frame &a = first->frame(), &b = second->frame();
    const Vec3 along = glm::cross(a.z, b.z);
    const double square = glm::dot(along, along);
    if (!(square > kParallel * kParallel) || !box_.bounded()) return;
    // The point of both planes nearest to the box's middle.
    const Vec3 middle = 0.5 * (box_.lo + box_.hi);
    const double da = glm::dot(a.origin - middle, a.z), db = glm::dot(b.origin - middle, b.z);
    const Vec3 through = middle + (da * glm::cross(b.z, along) + db * glm::cross(along, a.z)) / square;
    const Vec3 reach = 0.51 * size_ / std::sqrt(square) * along;
    asked.line.curve = std::make_shared<Segment>(through - reach, through + reach);
    add(std::move(asked));
  }

  void add(const BodyContours& contours, const Body& body, const Body* other, const Candidate& asked) {
    if (!contours.complete) result_.complete = false;
    for (const BodyContour& branch : contours.branches)
      for (const BodyContourPart& part : branch.parts) {
        const Interval all = part.contour.curve->domain();
        const auto add_part = [&](const Interval& t) {
          if (!(t.width() > kShortest * all.width())) return;
          Candidate found = asked;
          CsgLine& line = found.line;
          line.curve =
              t.width() == all.width() ? part.contour.curve : std::make_shared<CurvePart>(part.contour.curve, t);
          line.supporting_surfaces.push_back({body.faces[part.face].surface, part.contour.images[0]});
          if (other && part.other_face >= 0 && part.contour.images.size() > 1)
            line.supporting_surfaces.push_back({other->faces[part.other_face].surface, part.contour.images[1]});
          for (const double cusp : part.contour.cusps)
            if (t.contains(cusp)) line.turns.push_back(cusp);
          found.touching = part.contour.kind == ContourKind::touching;
          add(std::move(found));
        };
        add_part({part.t.lo, std::min(part.t.hi, all.hi)});
        if (part.t.hi > all.hi) add_part({all.lo, part.t.hi - all.width()});
      }
  }

  void add(const ImplicitContours& contours, const Affine& map, const Candidate& asked) {
    if (!contours.complete) result_.complete = false;
    for (const ImplicitContour& contour : contours.lines)
      add(contour.curve, contour.outward_offset, contour.turns, map, asked);
  }
  void add(const ShapeOutlines& outlines, const Affine& map, bool edges, const Candidate& asked) {
    if (!outlines.complete) result_.complete = false;
    for (const ShapeOutline& outline : outlines.lines)
      if (outline.edge == edges) add(outline.curve, outline.outward_offset, outline.turns, map, asked);
  }
  // What a leaf has in coordinates of its own.
  void add(const CurvePtr& curve, const CurvePtr& outward_offset, const std::vector<double>& turns, const Affine& map,
           Candidate found) {
    found.line.curve = transformed(curve, map);
    if (outward_offset) found.line.outward_offset = transformed(outward_offset, Affine{map.linear, Vec3(0)});
    found.line.turns = turns;
    add(std::move(found));
  }

  // What of the line is on the solid's boundary.
  void add(Candidate found) {
    CsgLine& line = found.line;
    const Interval domain = line.curve->domain();
    for (CsgLine::SupportingSurface& supporting_surface : line.supporting_surfaces)
      if (supporting_surface.image)
        supporting_surface.image =
            contour_approximation(line.curve, *supporting_surface.surface, supporting_surface.image);
    line.curve = contour_approximation(line.curve);
    const Box3 box = bounds(*line.curve);
    found.reach = std::min(size_, box.diameter());
    const std::vector<double> cuts = cuts_of(found, box);
    // Stretches that follow one another on the boundary are one line.
    double from = 0;
    std::optional<Kind> on;
    for (size_t i = 0; i + 1 < cuts.size(); ++i) {
      if (cuts[i + 1] - cuts[i] <= kShortest * domain.width()) continue;
      const Interval stretch{cuts[i], cuts[i + 1]};
      std::optional<Kind> here = kind_of(found, stretch);
      if (here && is_known(*line.curve, *here, stretch)) here.reset();
      if (on && here != on) put(line, *on, {from, cuts[i]});
      if (here != on) from = cuts[i];
      on = here;
    }
    if (on) put(line, *on, {from, domain.hi});
  }

  // Whether another leaf has had a line there. Parameter lines are those of their own faces.
  bool is_known(const Curve& curve, Kind kind, const Interval& stretch) const {
    if (kind == Kind::parameter) return false;
    const double near = kSameLine * size_;
    return std::any_of(result_.lines.begin(), result_.lines.end(), [&](const CsgLine& known) {
      if (known.kind != kind) return false;
      const Box3 box = bounds(*known.curve).inflated(near);
      constexpr double kPlaces[] = {kAskedAt, 0.1237, 0.8711};
      return std::all_of(std::begin(kPlaces), std::end(kPlaces), [&](double place) {
        const Vec3 p = curve.point(stretch.lo + place * stretch.width());
        if (!box.contains(p)) return false;
        const CurveFootPoints foot_points = project(p, *known.curve);
        return !foot_points.foot_points.empty() && foot_points.foot_points[0].distance <= near;
      });
    });
  }

  // Where other leaves may begin or end to cover it.
  std::vector<double> cuts_of(const Candidate& found, const Box3& box) const {
    const Curve& curve = *found.line.curve;
    std::vector<double> cuts{curve.domain().lo, curve.domain().hi};
    for (int k = 0; k < count(); ++k) {
      const CsgLeaf& leaf = leaves_[k];
      if (std::find(found.own.begin(), found.own.end(), k) != found.own.end() || !BoxTree::meets(leaf.box, box))
        continue;
      const auto meet = [&](const Surface& surface) {
        const SurfaceIntersections intersections = intersect(curve, surface);
        for (const SurfaceIntersection& one : intersections.points) cuts.push_back(one.t);
        for (const Interval& on : intersections.on_surface) cuts.push_back(on.lo), cuts.push_back(on.hi);
      };
      if (leaf.plane) meet(*leaf.plane);
      if (leaf.body)
        for (int f = 0; f < static_cast<int>(leaf.body->faces.size()); ++f)
          if (k != found.of || f != found.face) meet(*leaf.body->faces[f].surface);
      if (leaf.implicit) {
        const ImplicitFormula& formula = leaf.implicit->formula();
        const std::vector<double> changes = sign_changes(
            *transformed(found.line.curve, leaf.map.inverse()), false,
            [&](const Box3& part) { return range_of(formula, part).over.value; },
            [&](const Vec3& p) { return formula(p); });
        cuts.insert(cuts.end(), changes.begin(), changes.end());
      } else if (leaf.shape) {
        add_entries(
            curve, leaf.box, size_,
            [&](const Line& chord, std::vector<double>& hits) {
              std::vector<SurfaceHit> met;
              leaf.shape->all_hits(chord, {0, 1}, met);
              for (const SurfaceHit& hit : met) hits.push_back(hit.t);
            },
            cuts);
      }
    }
    std::sort(cuts.begin(), cuts.end());
    return cuts;
  }

  // Of the angle at which the surfaces of a line meet there; 1 where they are not known.
  static double sine_at(const CsgLine& line, double t) {
    if (line.supporting_surfaces.size() != 2 || !line.supporting_surfaces[0].image ||
        !line.supporting_surfaces[1].image)
      return 1;
    const auto normal = [&](const CsgLine::SupportingSurface& supporting_surface) {
      const Vec3 uv = supporting_surface.image->point(t);
      return supporting_surface.surface->normal(uv.x, uv.y);
    };
    return glm::length(glm::cross(normal(line.supporting_surfaces[0]), normal(line.supporting_surfaces[1])));
  }

  // A line of one leaf may lie in a face of another, as an outline in the plane that cuts the solid in half: it is on
  // the boundary only where that has the leaf's normal, or for want of it one across the sight.
  bool is_on_own_face(const CsgLine& line, double t, const Vec3& point, const std::vector<Vec3>& normals) const {
    const CsgLine::SupportingSurface* own = nullptr;
    for (const CsgLine::SupportingSurface& one : line.supporting_surfaces)
      if (!own && one.image) own = &one;
    std::function<bool(const Vec3&)> is_own;
    if (own) {
      const Vec3 uv = own->image->point(t), normal = own->surface->normal(uv.x, uv.y);
      is_own = [=](const Vec3& n) { return !(glm::length(glm::cross(n, normal)) > kOtherFace); };
    } else if (line.kind == Kind::silhouette) {
      const Vec3 sight = view_.central ? glm::normalize(point - view_.direction_or_eye) : view_.direction_or_eye;
      is_own = [=](const Vec3& n) { return !(std::abs(glm::dot(n, sight)) > kOtherFace); };
    } else {
      return true;
    }
    return std::any_of(normals.begin(), normals.end(), is_own);
  }

  // Of a stretch on the boundary: what it is there. Notes faces that are one across it.
  std::optional<Kind> kind_of(const Candidate& found, const Interval& stretch) {
    const double place = stretch.lo + kAskedAt * stretch.width();
    const CurveJet at = found.line.curve->evaluate(place, 1);
    if (!(glm::length(at.d[1]) > 0)) return std::nullopt;
    const bool is_edge = found.line.kind == Kind::sharp;
    const CsgBoundaryQuestion question{
        at.d[0], at.d[1], found.reach, sine_at(found.line, place), found.touching, is_edge && !found.smooth};
    const auto [boundary, faces, normals] = boundary_at(solid_, size_, question);
    if (boundary == CsgBoundary::none || (!is_edge && !is_on_own_face(found.line, place, at.d[0], normals)))
      return std::nullopt;
    if (!is_edge || boundary == CsgBoundary::sharp_edge) return found.line.kind;
    if (found.smooth || boundary == CsgBoundary::smooth_edge) return Kind::smooth;
    if (faces.size() > 1) result_.one_face.push_back(faces);
    return std::nullopt;
  }

  void put(const CsgLine& line, Kind kind, const Interval& t) {
    CsgLine part = line;
    part.kind = kind;
    if (t.width() < line.curve->domain().width()) {
      part.curve = std::make_shared<CurvePart>(line.curve, t);
      if (part.outward_offset) part.outward_offset = std::make_shared<CurvePart>(line.outward_offset, t);
    }
    std::erase_if(part.supporting_surfaces,
                  [](const CsgLine::SupportingSurface& supporting_surface) { return !supporting_surface.image; });
    std::erase_if(part.turns, [&](double turn) { return !t.contains(turn); });
    result_.lines.push_back(std::move(part));
  }

  const Csg& solid_;
  const ViewOf& view_;
  Box3 box_;
  double size_;
  std::vector<CsgLeaf> leaves_;
  std::map<int, TubeBoundary> tubes_;
  CsgLines result_;
};

}  // namespace

CsgLines csg_lines(const Csg& solid, const ViewOf& view, const CsgLines* known) {
  return Lines(solid, view).find(known);
}

CsgLines csg_section(const Csg& solid, const Vec3& origin, const Vec3& normal, const ViewOf& view) {
  return Lines(solid, view).section(origin, normal);
}

CsgLines csg_parameter_lines(const Csg& solid, const ParameterNet& net, const ViewOf& view) {
  return Lines(solid, view).parameter_lines(net);
}

}  // namespace lekalo::geometry
