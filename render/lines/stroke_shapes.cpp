#include <algorithm>
#include <cmath>

#include "geometry/curves/operations/curve_part.h"
#include "geometry/queries/contours/surface_intersection.h"
#include "geometry/queries/intersections/self_intersections.h"
#include "geometry/queries/rays/fitted_surface.h"
#include "geometry/shapes/tube/ball_parameter_lines.h"
#include "geometry/spatial/box_tree.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/transformed.h"
#include "render/lines/stroke_collector.h"
#include "render/model/face_materials.h"
#include "render/model/look.h"
#include "render/model/section.h"

namespace lekalo::render {

using namespace geometry;

namespace {

constexpr double kAlong = 1e-6;  // radians; of an edge's length
constexpr double kEnds[] = {0, 0.5, 1};

bool is_along(const Vec3& one, const Vec3& other) {
  return glm::length(glm::cross(one, other)) <= kAlong * glm::length(one) * glm::length(other) &&
         glm::length(other) > 0;
}

// Whether a part of one of the straight edges is the curve.
bool lies_on_any(const Curve& curve, const std::vector<CurvePtr>& edges) {
  const Interval t = curve.domain();
  return std::any_of(edges.begin(), edges.end(), [&](const CurvePtr& edge) {
    const Vec3 from = edge->point(edge->domain().lo), way = edge->point(edge->domain().hi) - from;
    return std::all_of(std::begin(kEnds), std::end(kEnds), [&](double share) {
      const Vec3 off = curve.point(t.lo + share * t.width()) - from;
      return glm::length(glm::cross(off, way)) <= kAlong * glm::dot(way, way);
    });
  });
}

}  // namespace

void StrokeCollector::add_boundary(const SurfacePtr& surface, const Style& style, const HiddenLines& hidden) {
  if (!surface->bounded()) return;
  const Rectangle domain = surface->domain();
  const DegenerateEdges edges = surface->degenerate_edges();
  const auto edge = [&](IsoDirection held, double at) { add(whole_line(surface, held, at), style, hidden); };
  if (!is_closed_in(*surface, IsoDirection::u)) {
    if (!edges.u_min) edge(IsoDirection::u, domain.u.lo);
    if (!edges.u_max) edge(IsoDirection::u, domain.u.hi);
  }
  if (!is_closed_in(*surface, IsoDirection::v)) {
    if (!edges.v_min) edge(IsoDirection::v, domain.v.lo);
    if (!edges.v_max) edge(IsoDirection::v, domain.v.hi);
  }
}

void StrokeCollector::add_edges(const Body& body, std::string_view kind, const Style& style,
                                const HiddenLines& hidden) {
  for (const Edge& edge : body.edges)
    if (edge.kind == EdgeKind::regular && edge.curve && kind_of(body, edge) == kind) {
      if (drawing_)
        for (const int c : edge.coedges) {
          const Coedge& coedge = body.coedges[c];
          supporting_surfaces_.push_back({body.faces[body.loops[coedge.loop].face].surface, coedge.image});
        }
      stroke(edge.curve, style, hidden);
    }
}

void StrokeCollector::add(const Contours& contours, const std::vector<SurfacePtr>& surfaces, const Style& style,
                          const HiddenLines& hidden) {
  if (!contours.complete) is_incomplete();
  for (const Contour& contour : contours.branches) {
    for (size_t k = 0; k < contour.images.size() && k < surfaces.size(); ++k)
      supporting_surfaces_.push_back({surfaces[k], contour.images[k]});
    cusps_ = contour.cusps;
    stroke(contour.curve, style, hidden);
  }
}

void StrokeCollector::add(const BodyContours& contours, const Body& body, const Style& style,
                          const HiddenLines& hidden) {
  if (!contours.complete) is_incomplete();
  for (const BodyContour& branch : contours.branches)
    for (const BodyContourPart& part : branch.parts) {
      const Interval all = part.contour.curve->domain();
      const auto add_part = [&](const Interval& t) {
        if (!(t.width() > 0)) return;
        supporting_surfaces_.push_back({body.faces[part.face].surface, part.contour.images[0]});
        for (const double cusp : part.contour.cusps)
          if (t.contains(cusp)) cusps_.push_back(cusp);
        stroke(t.width() == all.width() ? part.contour.curve : std::make_shared<CurvePart>(part.contour.curve, t),
               style, hidden);
      };
      add_part({part.t.lo, std::min(part.t.hi, all.hi)});
      if (part.t.hi > all.hi) add_part({all.lo, part.t.hi - all.width()});
    }
}

BodyPtr StrokeCollector::with_fitted_faces(const BodyPtr& body) {
  const auto [found, is_new] = fitted_bodies_.try_emplace(body, body);
  const auto is_composed = [](const Face& face) { return face.surface->is_composed(); };
  if (!is_new || std::none_of(body->faces.begin(), body->faces.end(), is_composed)) return found->second;
  const auto copy = std::make_shared<Body>(*body);
  for (Face& face : copy->faces)
    if (is_composed(face) && smooth_parts_of(face.surface).size() == 1) face.surface = fitted_copy(face.surface);
  return found->second = copy;
}

void StrokeCollector::add_silhouettes(const ViewOf& view, const Style& style, const HiddenLines& hidden) {
  // What a copy's search leaves open the surface itself may tell.
  if (const auto* body = std::get_if<BodyPtr>(&object_->shape)) {
    const BodyPtr copy = with_fitted_faces(*body);
    BodyContours found = silhouette(*copy, view);
    if (!found.complete && copy != *body) found = silhouette(**body, view);
    add(found, **body, style, hidden);
  }
  if (const auto* shape = std::get_if<ShapePtr>(&object_->shape)) add_solid(*shape, view, false, style, hidden);
  each_surface([&](const SurfacePtr& surface) {
    if (!surface->bounded() || dynamic_cast<const Plane*>(surface.get())) return;
    each_smooth_part(surface, [&](const SurfacePtr& part) {
      const SurfacePtr copy = fitted_copy(part);
      Contours found = silhouette(copy, view);
      if (!found.complete && copy != part) found = silhouette(part, view);
      add(found, {part}, style, hidden);
    });
  });
}

void StrokeCollector::in_own_coordinates(const ShapePtr& shape,
                                         const std::function<void(const Shape&, const Affine&)>& visit) {
  const auto* moved = dynamic_cast<const TransformedShape*>(shape.get());
  if (!moved) return visit(*shape, Affine());
  const Affine to_world = to_world_;
  to_world_ = to_world * moved->map();
  visit(*moved->original(), moved->map().inverse());
  to_world_ = to_world;
}

void StrokeCollector::add_solid(const ShapePtr& shape, const ViewOf& view, bool edges, const Style& style,
                                const HiddenLines& hidden) {
  in_own_coordinates(shape, [&](const Shape& original, const Affine& back) {
    const ViewOf own_view = seen_through(view, back);
    if (const auto* surface = dynamic_cast<const ImplicitSurface*>(&original)) {
      if (!edges) add(silhouette(*surface, own_view), style, hidden);
      if (kind_ == "sharp") add(creases(*surface, own_view), style, hidden);
      if (kind_ == (surface->is_closed() ? "sharp" : "boundary")) add(border(*surface, own_view), style, hidden);
      return;
    }
    if (kind_ == "boundary") return;
    const auto* tube = dynamic_cast<const Tube*>(&original);
    const auto* balls = dynamic_cast<const Balls*>(&original);
    if (const auto* solid = dynamic_cast<const Csg*>(&original)) {
      if (solid_ != shape || solid_view_ != own_view.direction_or_eye) {
        solid_ = shape, solid_view_ = own_view.direction_or_eye;
        const auto known = solids_.find(shape);
        solids_[shape] = csg_lines(*solid, own_view, known == solids_.end() ? nullptr : &known->second);
        note(solids_[shape]);
      }
      const CsgLine::Kind asked = !edges             ? CsgLine::Kind::silhouette
                                  : kind_ == "sharp" ? CsgLine::Kind::sharp
                                                     : CsgLine::Kind::smooth;
      const SectionSteps steps = edges ? steps_of(*object_) : SectionSteps();
      const bool without_steps = !own_view.central && is_along(own_view.direction_or_eye, steps.away);
      for (const CsgLine& line : solids_.at(shape).lines)
        if (line.kind == asked && !(without_steps && lies_on_any(*line.curve, steps.edges))) add(line, style, hidden);
    } else if ((tube || balls) && kind_ != "smooth") {
      // Asked for edges and for silhouettes.
      if (outlined_ != &original || outlined_view_ != own_view.direction_or_eye) {
        outlined_ = &original, outlined_view_ = own_view.direction_or_eye;
        outlines_of_shape_ = tube ? outlines(*tube, own_view) : outlines(*balls, own_view);
      }
      add(outlines_of_shape_, edges, style, hidden);
      if (!tube || !edges) return;
      const TubeBoundary::Edges own = boundary_of(*tube).edges(own_view);
      if (!own.all_known) leave_out("some edges along which " + name_of_object() + " goes through itself");
      add_on_tube(own.lines, nullptr, style, hidden);
    }
  });
}

void StrokeCollector::add_parameter_lines(const ShapePtr& shape, const Lines& lines, const Style& style) {
  const HiddenLines& hidden = lines.hidden_of("parameter");
  const ParameterNet net{lines.at_u, lines.at_v};
  const ViewOf view = view_from(to_world_.inverse());
  in_own_coordinates(shape, [&](const Shape& original, const Affine& back) {
    const ViewOf own_view = seen_through(view, back);
    if (const auto* tube = dynamic_cast<const Tube*>(&original))
      return add_on_tube(boundary_of(*tube).parameter_lines(net, own_view), nullptr, style, hidden);
    if (const auto* balls = dynamic_cast<const Balls*>(&original))
      return add(parameter_lines(*balls, net, own_view), true, style, hidden);
    const auto* solid = dynamic_cast<const Csg*>(&original);
    if (!solid) return leave_out("parameter lines of " + name_of_object());
    const CsgLines found = csg_parameter_lines(*solid, net, own_view);
    note(found);
    for (const CsgLine& line : found.lines) add(line, style, hidden);
  });
}

void StrokeCollector::add(const ShapeOutlines& outlines, bool edges, const Style& style, const HiddenLines& hidden) {
  // Asked for outlines and for edges: what is missing is told once.
  if (!outlines.complete && (!edges || kind_ == "section")) is_incomplete();
  for (const ShapeOutline& line : outlines.lines) {
    if (line.edge != edges) continue;
    outward_offset_ = line.outward_offset, cusps_ = line.turns;
    stroke(line.curve, style, hidden);
  }
}

void StrokeCollector::add(const ImplicitContours& contours, const Style& style, const HiddenLines& hidden) {
  if (!contours.complete) is_incomplete();
  for (const ImplicitContour& line : contours.lines) {
    outward_offset_ = line.outward_offset, cusps_ = line.turns;
    stroke(line.curve, style, hidden);
  }
}

void StrokeCollector::add(const CsgLine& line, const Style& style, const HiddenLines& hidden) {
  for (const CsgLine::SupportingSurface& supporting_surface : line.supporting_surfaces)
    supporting_surfaces_.push_back({supporting_surface.surface, supporting_surface.image});
  cusps_ = line.turns, outward_offset_ = line.outward_offset;
  stroke(line.curve, style, hidden);
}

void StrokeCollector::note(const CsgLines& lines) {
  if (!lines.complete) is_incomplete();
  for (const std::string& what : lines.left_out) leave_out(what);
}

void StrokeCollector::add_mesh_lines(MeshLineKind kind, const Style& style, const HiddenLines& hidden) {
  for (const MeshLine& line : mesh_lines_)
    if (line.kind == kind) stroke(line.curve, style, hidden);
}

void StrokeCollector::add_borders_of_fill(const Fill& fill) {
  undrawn_ = borders_ = true;
  if (fill.shading == Fill::Shading::two_tone || (fill.hatching && fill.hatching->shade_only)) {
    kind_ = "terminator";
    const ViewOf from_light = seen_through({false, light_of(fill, *model_.camera)}, to_world_.inverse());
    add_silhouettes(from_light, Style(), {});
    if (const auto* mesh = std::get_if<MeshPtr>(&object_->shape))
      for (const MeshLine& line : mesh_lines(**mesh, from_light))
        if (line.kind == MeshLineKind::silhouette) stroke(line.curve, Style(), {});
  }
  if (fill.shading == Fill::Shading::gradient || face_materials(*object_)) {
    kind_ = "smooth";
    if (const auto* body = std::get_if<BodyPtr>(&object_->shape)) add_edges(**body, kind_, Style(), {});
    if (const auto* shape = std::get_if<ShapePtr>(&object_->shape)) {
      add_solid(*shape, view_from(to_world_.inverse()), true, Style(), {});
      if (solid_ == *shape)
        for (const std::set<int>& faces : solids_.at(*shape).one_face) work_.one_faces.join(object_number_, faces);
    }
  }
  undrawn_ = borders_ = false;
  filled_.push_back({object_, {object_->shape, to_world_, object_number_, placement_}});
  each_face([&](const SurfacePtr& surface) {
    if (surface->bounded()) faces_.push_back({transformed(surface, to_world_), object_number_, placement_});
  });
  for (const ClipPlane& plane : planes_)
    if (plane.cap) faces_.push_back({transformed(cap_of(plane), to_world_), object_number_, placement_});
}

void StrokeCollector::add_intersections() {
  undrawn_ = borders_ = true;
  kind_ = "intersection";
  to_world_ = Affine();
  std::vector<Box3> boxes;
  for (const PlacedFace& face : faces_) boxes.push_back(bounds(*face.surface));
  const BoxTree tree(boxes);
  for (size_t k = 0; k < faces_.size(); ++k)
    tree.around(boxes[k], [&](int other) {
      const PlacedFace &a = faces_[k], &b = faces_[static_cast<size_t>(other)];
      if (static_cast<size_t>(other) <= k || (a.object == b.object && a.placement == b.placement)) return;
      if (is_same(a.surface, b.surface)) return;  // shown twice
      object_number_ = a.object, placement_ = a.placement;
      add(intersect(a.surface, b.surface), {a.surface, b.surface}, Style(), {});
    });
  // What has no faces of its own, as far as its intersections are known: areas that stay open are told of later.
  const std::vector<std::string> left_out = work_.left_out;
  std::vector<Box3> boxes_of_all;
  for (const auto& [object, placed] : filled_)
    boxes_of_all.push_back(transformed(bounds(placed.shape), placed.to_world));
  for (size_t k = 0; k < filled_.size(); ++k)
    for (size_t j = k + 1; j < filled_.size(); ++j) {
      const PlacedShape &a = filled_[k].second, &b = filled_[j].second;
      if (has_faces(a.shape) && has_faces(b.shape)) continue;
      if (!BoxTree::meets(boxes_of_all[k], boxes_of_all[j])) continue;
      object_ = filled_[k].first, object_number_ = a.object, placement_ = a.placement;
      add_intersection(a, b, Style(), {});
    }
  work_.left_out = left_out;
  undrawn_ = borders_ = false;
}

std::string_view StrokeCollector::kind_of(const Body& body, const Edge& edge) {
  if (edge.coedges.size() < 2) return "boundary";
  const Interval domain = edge.curve->domain();
  for (const double x : {0.23, 0.5, 0.81}) {
    const double t = domain.lo + x * domain.width();
    const auto normal = [&](int which) {
      const Coedge& coedge = body.coedges[edge.coedges[which]];
      const Vec3 uv = coedge.image->point(t);
      return body.normal(body.loops[coedge.loop].face, uv.x, uv.y);
    };
    if (glm::length(normal(0) - normal(1)) > kSmoothEdge) return "sharp";
  }
  return "smooth";
}

}  // namespace lekalo::render
