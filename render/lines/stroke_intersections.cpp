// Where shapes meet one another: the lines `intersection` of an object.
//
// Faces meet faces, and implicit surfaces and balls, in contours of the faces' surfaces. Plane faces cut tubes and
// meshes. Tubes are met by all else through surfaces that hold their boundary (stroke_tubes.cpp), meshes triangle by
// triangle (stroke_meshes.cpp), implicit surfaces and balls part by part (stroke_parts.cpp). What is put together is
// met through its leaves, as far as the lines lie on the whole.
#include <algorithm>
#include <cmath>

#include "geometry/curves/operations/surface_curve.h"
#include "geometry/queries/contours/surface_intersection.h"
#include "geometry/queries/intersections/curve_intersections.h"
#include "geometry/shapes/csg/body_shape.h"
#include "geometry/shapes/csg/half_space.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/transformed.h"
#include "render/lines/stroke_collector.h"
#include "render/model/objects.h"
#include "render/model/placed_objects.h"
#include "render/model/section_faces.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// A plane that goes on everywhere.
std::optional<SectionPlane> whole_plane(const Entity& shape, const Affine& to_world) {
  const Frame* frame = nullptr;
  if (const auto* surface = std::get_if<SurfacePtr>(&shape))
    if (const auto* plane = dynamic_cast<const Plane*>(surface->get()); plane && !plane->bounded())
      frame = &plane->frame();
  if (const auto* half = solid_of<HalfSpaceShape>(shape)) frame = &half->frame();
  if (!frame) return std::nullopt;
  return SectionPlane{to_world.point(frame->origin), glm::normalize(to_world.normal(frame->z))};
}

std::string words_of(const Entity& shape) {
  return has_faces(shape)                         ? "curved faces"
         : std::holds_alternative<MeshPtr>(shape) ? "a mesh"
         : solid_of<ImplicitSurface>(shape)       ? "an implicit surface"
         : solid_of<Balls>(shape)                 ? "balls"
         : solid_of<Tube>(shape)                  ? "a tube"
                                                  : "what has neither";
}

// Whether a point lies on a solid is asked along these, so far to both sides, of its size.
constexpr double kBesideSolid = 1e-6;
const Vec3 kProbes[] = {{0.61, 0.53, 0.59}, {-0.67, 0.49, 0.56}, {0.28, -0.83, 0.48}};

// The leaves of a solid, each as a body where it is one, placed in the world.
template <class Placed>
void add_leaves(const ShapePtr& shape, const Affine& to_world, int object, std::vector<Placed>& leaves) {
  if (const auto* moved = dynamic_cast<const TransformedShape*>(shape.get()))
    return add_leaves(moved->original(), to_world * moved->map(), object, leaves);
  if (const auto* solid = dynamic_cast<const Csg*>(shape.get())) {
    for (const ShapePtr& operand : solid->operands()) add_leaves(operand, to_world, object, leaves);
    return;
  }
  if (const auto* body = dynamic_cast<const BodyShape*>(shape.get()))
    leaves.push_back({body->body(), to_world, object});
  else
    leaves.push_back({shape, to_world, object});
}

}  // namespace

bool has_faces(const Entity& shape) {
  return std::holds_alternative<SurfacePtr>(shape) || std::holds_alternative<SurfaceSet>(shape) ||
         std::holds_alternative<BodyPtr>(shape);
}

void StrokeCollector::each_bounded_part(const Entity& shape, const std::function<void(const SurfacePtr&)>& visit) {
  each_surface(shape, [&](const SurfacePtr& surface) {
    if (surface->bounded()) each_smooth_part(surface, visit);
  });
}

std::vector<StrokeCollector::PlacedShape> StrokeCollector::placements_of(const Entity& shape) const {
  std::vector<PlacedShape> found;
  PlacedObjects(model_.objects, [&](const Object& object) {
    return &object != object_ && identity(shape_as_written(object)) == identity(shape);
  }).visit([&](const Object& object, const Affine& to_world, int placement) {
    found.push_back({shape, to_world, numbers_.at(&object), placement});
  });
  // A drawing's lines name each object's shape to itself too: it meets nothing there.
  if (found.empty() && identity(shape_as_written(*object_)) != identity(shape)) found.push_back({shape, Affine(), -1});
  return found;
}

void StrokeCollector::add_intersections(const Entity& other, const Style& style, const HiddenLines& hidden) {
  const Affine to_world = to_world_;
  for (const PlacedShape& placed : placements_of(other)) {
    add_intersection({object_->shape, to_world, object_number_, placement_}, placed, style, hidden);
    to_world_ = to_world;
  }
}

void StrokeCollector::add_intersection(PlacedShape a, PlacedShape b, const Style& style, const HiddenLines& hidden) {
  for (PlacedShape* one : {&a, &b}) {
    const auto* moved = solid_of<TransformedShape>(one->shape);
    if (!moved) continue;
    one->to_world = one->to_world * moved->map();
    one->shape = ShapePtr(moved->original());
  }
  for (const bool swapped : {false, true}) {
    const PlacedShape &one = swapped ? b : a, &other = swapped ? a : b;
    const auto plane = whole_plane(one.shape, one.to_world);
    if (!plane || whole_plane(other.shape, other.to_world)) continue;
    to_world_ = other.to_world;
    return add_section(other.shape, *plane, style, hidden);
  }
  for (const bool swapped : {false, true}) {
    const PlacedShape &one = swapped ? b : a, &other = swapped ? a : b;
    if (solid_of<Csg>(one.shape)) return add_intersection_of_leaves(one, other, style, hidden);
  }
  for (const PlacedShape* one : {&a, &b})
    each_surface(one->shape, [&](const SurfacePtr& surface) {
      if (!surface->bounded()) leave_out("intersections of unbounded surfaces (" + name_of_object() + ")");
    });
  if (has_faces(a.shape) && has_faces(b.shape)) {
    to_world_ = a.to_world;
    const Affine to_a = a.to_world.inverse() * b.to_world;
    const auto* body = std::get_if<BodyPtr>(&a.shape);
    if (const auto* other = std::get_if<BodyPtr>(&b.shape)) {
      const Body moved = to_a.is_identity() ? **other : transformed(**other, to_a);
      const auto are_same = [](const Face& one, const Face& same) { return is_same(one.surface, same.surface); };
      if (body &&
          std::equal((*body)->faces.begin(), (*body)->faces.end(), moved.faces.begin(), moved.faces.end(), are_same))
        return;  // shown twice
      if (body) add(intersect(**body, moved), **body, style, hidden);
      each_bounded_part(a.shape,
                        [&](const SurfacePtr& surface) { add(intersect(moved, surface), moved, style, hidden); });
    }
    each_bounded_part(b.shape, [&](const SurfacePtr& other) {
      const SurfacePtr moved = transformed(other, to_a);
      if (body) add(intersect(**body, moved), **body, style, hidden);
      each_bounded_part(a.shape, [&](const SurfacePtr& surface) {
        add(intersect(surface, moved), {surface, moved}, style, hidden);
      });
    });
    return;
  }
  // The lines run along both, one of which is the object.
  const bool is_object = a.object == object_number_ && a.placement == placement_;
  const PlacedShape& met = is_object ? b : a;
  met_ = met.object, met_placement_ = met.placement;
  add_intersection_of_solids(a, b, style, hidden);
  met_ = -2;
}

void StrokeCollector::add_intersection_of_solids(const PlacedShape& a, const PlacedShape& b, const Style& style,
                                                 const HiddenLines& hidden) {
  if (!has_faces(a.shape) && !has_faces(b.shape)) {
    for (const bool swapped : {false, true}) {
      const PlacedShape &one = swapped ? b : a, &other = swapped ? a : b;
      if (!std::holds_alternative<MeshPtr>(one.shape) ||
          !(std::holds_alternative<MeshPtr>(other.shape) || std::holds_alternative<ShapePtr>(other.shape)))
        continue;
      return add_intersection_of_mesh(one, other, style, hidden);
    }
    if (!add_intersection_of_parts(a, b, style, hidden) && !add_intersection_of_tube(a, b, style, hidden) &&
        !add_intersection_of_tube(b, a, style, hidden))
      leave_out("intersections of " + words_of(a.shape) + " and " + words_of(b.shape) + " (" + name_of_object() + ")");
    return;
  }
  const bool a_has_faces = has_faces(a.shape);
  const PlacedShape &faces = a_has_faces ? a : b, &solid = a_has_faces ? b : a;
  each_bounded_part(faces.shape, [&](const SurfacePtr& surface) {
    add_intersection_of_face({surface, nullptr, {}}, faces.to_world, solid, style, hidden);
  });
  if (const auto* body = std::get_if<BodyPtr>(&faces.shape))
    for (const FaceRegion& face : face_regions(**body))
      add_intersection_of_face(face, faces.to_world, solid, style, hidden);
}

void StrokeCollector::add_intersection_of_face(const FaceRegion& face, const Affine& to_world, const PlacedShape& solid,
                                               const Style& style, const HiddenLines& hidden) {
  to_world_ = to_world;
  const size_t before = cutters_.size();
  const auto* plane = dynamic_cast<const Plane*>(face.surface.get());
  const auto* tube = solid_of<Tube>(solid.shape);
  if (has_parts(solid.shape)) {
    if (face.region) cutters_.push_back(cutter_of(face, to_world));
    meets_parts(meets_of_face(face.surface, to_world, solid.to_world, style, hidden), solid);
  } else if (plane) {
    cutters_.push_back(cutter_of(face, to_world));
    to_world_ = solid.to_world;
    const Frame& frame = plane->frame();
    add_section(solid.shape, {to_world.point(frame.origin), glm::normalize(to_world.normal(frame.z))}, style, hidden);
  } else if (tube) {
    if (face.region) cutters_.push_back(cutter_of(face, to_world));
    meets_of_tube(*tube, solid.to_world, to_world, style, hidden).surface(face.surface);
  } else if (std::holds_alternative<MeshPtr>(solid.shape)) {
    if (face.region) cutters_.push_back(cutter_of(face, to_world));
    add_intersection_of_mesh(solid, {face.surface, to_world, -1}, style, hidden);
  } else {
    leave_out("intersections of curved faces and " + words_of(solid.shape) + " (" + name_of_object() + ")");
  }
  cutters_.resize(before);
}

void StrokeCollector::add_intersection_of_leaves(const PlacedShape& whole, const PlacedShape& other, const Style& style,
                                                 const HiddenLines& hidden) {
  const auto& solid = std::get<ShapePtr>(whole.shape);
  std::vector<PlacedShape> leaves;
  add_leaves(solid, whole.to_world, whole.object, leaves);
  const ShapePtr placed = transformed(solid, whole.to_world);
  for (size_t k = 0; k < leaves.size(); ++k) {
    cutters_.push_back(cutter_of(leaves, k, placed));
    add_intersection(leaves[k], other, style, hidden);
    cutters_.pop_back();
  }
}

StrokeCollector::Cutter StrokeCollector::cutter_of(const FaceRegion& face, const Affine& to_world) {
  const Affine back = to_world.inverse();
  std::vector<CurvePtr> borders;
  for (const Curve2Ptr& image : face.borders) borders.push_back(std::make_shared<SurfaceCurve>(face.surface, image));
  const Rectangle domain = face.surface->domain();
  if (!face.region) {
    for (const double at : {domain.u.lo, domain.u.hi})
      borders.push_back(std::make_shared<ParameterLine>(face.surface, IsoDirection::u, at));
    for (const double at : {domain.v.lo, domain.v.hi})
      borders.push_back(std::make_shared<ParameterLine>(face.surface, IsoDirection::v, at));
  }
  Cutter cutter;
  cutter.add_cuts = [=](const Stroke& stroke, std::vector<double>& cuts) {
    const CurvePtr curve = transformed(stroke.curve, back * stroke.to_world);
    for (const CurvePtr& border : borders)
      for (const CurveIntersection& intersection : intersect(*curve, *border).points) cuts.push_back(intersection.s);
  };
  cutter.keeps = [=](const Stroke& stroke, double t, double) {
    Vec3 uv;
    if (const auto* plane = dynamic_cast<const Plane*>(face.surface.get())) {
      const Vec3 off = back.point(stroke.to_world.point(stroke.curve->point(t))) - plane->frame().origin;
      uv = {glm::dot(off, plane->frame().x), glm::dot(off, plane->frame().y), 0};
    } else if (!stroke.supporting_surfaces.empty()) {
      uv = stroke.supporting_surfaces[0].image->point(t);  // the first is the face that meets something
    }
    return face.region ? face.region->contains(uv.x, uv.y) : domain.contains(uv.x, uv.y);
  };
  return cutter;
}

StrokeCollector::Cutter StrokeCollector::cutter_of(const std::vector<PlacedShape>& leaves, size_t on,
                                                   const ShapePtr& placed_solid) {
  std::vector<SurfacePtr> faces;
  std::vector<Cutter> others;
  for (size_t k = 0; k < leaves.size(); ++k) {
    if (k == on) continue;
    const Affine to_world = leaves[k].to_world;
    if (const auto* body = std::get_if<BodyPtr>(&leaves[k].shape)) {
      for (const Face& face : (*body)->faces) faces.push_back(transformed(face.surface, to_world));
    } else if (const auto plane = whole_plane(leaves[k].shape, to_world)) {
      others.push_back(cutter_of(ClipPlane{plane->through, plane->normal, false}));
    } else if (const auto* implicit = solid_of<ImplicitSurface>(leaves[k].shape)) {
      const ImplicitFormula formula = implicit->formula();
      others.push_back(cut_where(
          to_world, [formula](const Box3& box) { return formula.enclose(box); },
          [formula](const Vec3& p) { return formula(p); }));
    } else if (const auto* balls = solid_of<Balls>(leaves[k].shape)) {
      for (const Balls::Ball& ball : balls->balls()) others.push_back(cut_in_ball(to_world, ball.center, ball.radius));
    }
  }
  Cutter cutter;
  cutter.add_cuts = [=](const Stroke& stroke, std::vector<double>& cuts) {
    const CurvePtr curve = transformed(stroke.curve, stroke.to_world);
    for (const SurfacePtr& face : faces)
      for (const SurfaceIntersection& intersection : intersect(*curve, *face).points) cuts.push_back(intersection.t);
    for (const Cutter& other : others) other.add_cuts(stroke, cuts);
  };
  const double reach = kBesideSolid * bounds(*placed_solid).diameter();
  cutter.keeps = [placed_solid, reach](const Stroke& stroke, double t, double) {
    const Vec3 point = stroke.to_world.point(stroke.curve->point(t));
    return std::any_of(std::begin(kProbes), std::end(kProbes), [&](const Vec3& direction) {
      std::vector<SurfaceHit> hits;
      placed_solid->all_hits({point - reach * direction, direction}, {0, 2 * reach}, hits);
      return hits.size() % 2 != 0;
    });
  };
  return cutter;
}

}  // namespace lekalo::render
