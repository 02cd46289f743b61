#include "render/drawing/annotations/center_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>

#include "geometry/bodies/booleans/boolean.h"
#include "geometry/bodies/booleans/solid_boundary.h"
#include "geometry/bodies/topology/landmarks.h"
#include "geometry/box_corners.h"
#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/operations/parameter_line.h"
#include "geometry/queries/closest/position.h"
#include "geometry/queries/differential/roundness.h"
#include "geometry/queries/quadrics/canonical_surface.h"
#include "geometry/shapes/csg/body_shape.h"
#include "geometry/shapes/csg/csg_leaves.h"
#include "geometry/transformed.h"
#include "render/drawing/annotations/annotation_work.h"
#include "render/model/placed_objects.h"

namespace lekalo::render {

using namespace geometry;

namespace {

constexpr double kBeyond = 3;       // millimetres by which centre lines pass what they belong to
constexpr double kSameAxis = 1e-6;  // of the scene's size, and radians
constexpr double kAllRound = kTwoPi - 1e-6;

// What turns about an axis: how far around, where along it, and how far from it.
struct RoundFace {
  Axis axis;
  double turn = 0, radius = 0;
  Interval along{kInfinity, -kInfinity};
};

// The angle by which a circular arc turns; each third of it less than half a turn.
double turn_of(const Curve& arc, const Circle& circle) {
  const Interval t = arc.domain();
  double sum = 0, before = 0;
  for (int k = 0; k <= 3; ++k) {
    const Vec3 p = arc.point(t.lo + t.width() * k / 3) - circle.frame().origin;
    const double angle = std::atan2(glm::dot(p, circle.frame().y), glm::dot(p, circle.frame().x));
    if (k > 0) sum += std::remainder(angle - before, kTwoPi);
    before = angle;
  }
  return std::abs(sum);
}

// A circle, or an arc of one.
std::optional<RoundFace> round_curve(const Curve& curve) {
  if (!(curve.domain().width() < kInfinity) || !is_round(curve)) return std::nullopt;
  const Interval t = curve.domain();
  const auto at = [&](double x) { return curve.point(t.lo + x * t.width()); };
  const Circle circle = arc_through(at(0), at(0.31), at(0.67));
  return RoundFace{{circle.frame().origin, circle.frame().z}, turn_of(curve, circle), circle.radius(), Interval(0)};
}

std::optional<RoundFace> round_face(const SurfacePtr& surface, const std::vector<Vec3>& border) {
  if (!surface->bounded() || !is_round(*surface)) return std::nullopt;
  if (const auto known = canonical(surface);
      known && (known->kind == CanonicalSurface::Kind::ellipsoid || known->kind == CanonicalSurface::Kind::plane))
    return std::nullopt;
  const Rectangle d = surface->domain();
  for (const IsoDirection held : {IsoDirection::v, IsoDirection::u}) {
    const Interval range = held == IsoDirection::v ? d.v : d.u;
    std::array<std::optional<Circle>, 2> circles;
    double turn = 0;
    for (size_t k = 0; k < 2; ++k) {
      const ParameterLine line(surface, held, range.lo + range.width() * (k == 0 ? 0.3 : 0.6));
      if (!is_round(line)) break;
      const Interval t = line.domain();
      const auto at = [&](double x) { return line.point(t.lo + x * t.width()); };
      circles[k] = arc_through(at(0), at(0.31), at(0.67));
      turn = turn_of(line, *circles[k]);
    }
    if (!circles[1]) continue;
    const Frame &one = circles[0]->frame(), &other = circles[1]->frame();
    const Vec3 way = other.origin - one.origin;
    if (glm::length(glm::cross(one.z, other.z)) > kSameAxis ||
        glm::length(glm::cross(way, one.z)) > kSameAxis * circles[0]->radius())
      continue;
    RoundFace face{{one.origin, one.z}, turn, 0, {kInfinity, -kInfinity}};
    for (const Vec3& p : border) {
      const Vec3 off = p - one.origin;
      const double height = glm::dot(off, one.z);
      face.along = hull(face.along, Interval(height));
      face.radius = std::max(face.radius, glm::length(off - height * one.z));
    }
    if (border.empty()) return std::nullopt;
    return face;
  }
  return std::nullopt;
}

void add_faces(const Body& body, std::vector<RoundFace>& faces) {
  for (int k = 0; k < static_cast<int>(body.faces.size()); ++k)
    if (const auto face = round_face(body.faces[k].surface, points_of_border(body, k))) faces.push_back(*face);
}

// Of a solid: of its boundary, or of what it is put together of.
void add_faces(const ShapePtr& shape, const Affine& to_world, std::vector<RoundFace>& faces) {
  const auto* moved = dynamic_cast<const TransformedShape*>(shape.get());
  const Shape* original = moved ? moved->original().get() : shape.get();
  const Affine placed = moved ? to_world * moved->map() : to_world;
  if (const auto* solid = dynamic_cast<const BodyShape*>(original))
    add_faces(transformed(*solid->body(), placed), faces);
  const auto* solid = dynamic_cast<const Csg*>(original);
  if (!solid) return;
  try {
    if (has_boundary(*solid))
      return add_faces(transformed(*boundary_of(moved ? moved->original() : shape), placed), faces);
  } catch (const BooleanError&) {  // of what cannot be made the operands
  } catch (const std::invalid_argument&) {
  }
  for (const CsgLeaf& leaf : csg_leaves(*solid))
    if (leaf.body) add_faces(transformed(*leaf.body, placed), faces);
}

// Whether all of it lies in what a section takes away.
bool is_taken_away(const RoundFace& face, const Shape& tool, const Affine& from_world) {
  constexpr int kHeights = 5, kAround = 8;
  const Frame frame = frame_about(face.axis.through, face.axis.along);
  for (int i = 0; i < kHeights; ++i)
    for (int j = 0; j < kAround; ++j) {
      const double height = face.along.lo + face.along.width() * (i + 0.5) / kHeights;
      const double angle = kTwoPi * (j + 0.3) / kAround;
      const Vec3 around = face.radius * Vec3(std::cos(angle), std::sin(angle), 0) + Vec3(0, 0, height);
      if (!is_inside(from_world.point(frame.point(around)), tool)) return false;
    }
  return true;
}

void add_faces(const Object& object, const Affine& to_world, std::vector<RoundFace>& faces) {
  if (const auto* body = std::get_if<BodyPtr>(&object.shape)) add_faces(transformed(**body, to_world), faces);
  if (const auto* curve = std::get_if<CurvePtr>(&object.shape))
    if (const auto arc = round_curve(*transformed(*curve, to_world))) faces.push_back(*arc);
  const auto* shape = std::get_if<ShapePtr>(&object.shape);
  if (!shape) return;
  // What a section cut is the solid, less what it took away: that has no axes here.
  const auto* cut = object.first_cut_leaf < 0 ? nullptr : dynamic_cast<const Csg*>(shape->get());
  const Box3 box = transformed((*shape)->bounds(), to_world);
  const Affine from_world = to_world.inverse();
  std::vector<RoundFace> found;
  add_faces(cut ? cut->operands().front() : *shape, to_world, found);
  // Without a boundary tools are longer than what they cut.
  for (RoundFace& face : found) {
    Interval inside(kInfinity, -kInfinity);
    for (const Vec3& corner : corners(box))
      inside = hull(inside, Interval(glm::dot(corner - face.axis.through, face.axis.along)));
    face.along = {std::max(face.along.lo, inside.lo), std::min(face.along.hi, inside.hi)};
    if (face.along.width() > 0 && !(cut && is_taken_away(face, *cut->operands().back(), from_world)))
      faces.push_back(face);
  }
}

bool same_axis(const Axis& a, const Axis& b, double size) {
  return glm::length(glm::cross(a.along, b.along)) <= kSameAxis &&
         glm::length(glm::cross(b.through - a.through, a.along)) <= kSameAxis * size;
}

// One for each axis about which something goes all round: the parts of one surface taken together.
std::vector<RoundFace> axes_of(std::vector<RoundFace> faces, double size) {
  std::vector<RoundFace> parts, axes;
  for (RoundFace& face : faces) {
    const auto same = std::find_if(parts.begin(), parts.end(), [&](const RoundFace& one) {
      return same_axis(one.axis, face.axis, size) && std::abs(one.radius - face.radius) <= kSameAxis * size;
    });
    if (same == parts.end()) {
      parts.push_back(face);
      continue;
    }
    if (glm::dot(same->axis.along, face.axis.along) < 0) face.along = {-face.along.hi, -face.along.lo};
    const double shift = glm::dot(face.axis.through - same->axis.through, same->axis.along);
    same->along = hull(same->along, {face.along.lo + shift, face.along.hi + shift});
    same->turn += face.turn;
  }
  for (RoundFace& part : parts) {
    if (part.turn < kAllRound) continue;
    const auto same = std::find_if(axes.begin(), axes.end(),
                                   [&](const RoundFace& one) { return same_axis(one.axis, part.axis, size); });
    if (same == axes.end()) {
      axes.push_back(part);
      continue;
    }
    if (glm::dot(same->axis.along, part.axis.along) < 0) part.along = {-part.along.hi, -part.along.lo};
    const double shift = glm::dot(part.axis.through - same->axis.through, same->axis.along);
    same->along = hull(same->along, {part.along.lo + shift, part.along.hi + shift});
    same->radius = std::max(same->radius, part.radius);
  }
  return axes;
}

}  // namespace

void add_center_lines(const View& view, LineWork& work, PageWork& page) {
  if (!view.model.drawing.center_lines) return;
  std::vector<RoundFace> faces;
  Box3 box;
  PlacedObjects(view.model.objects).visit([&](const Object& object, const Affine& to_world, int) {
    if (std::holds_alternative<GroupPtr>(object.shape)) return;
    add_faces(object, to_world, faces);
  });
  Annotation annotation;
  annotation.type = "center_line";
  annotation.style = *view.model.drawing.center_lines;
  AnnotationWork lines(view, annotation, work, page);
  const HiddenLines shown{HiddenLines::Way::show, {}};
  const Camera& camera = view.camera;
  for (const RoundFace& one : axes_of(std::move(faces), bounds(view.model).diameter())) {
    const auto at = [&](double height) { return one.axis.through + height * one.axis.along; };
    const Vec3 begin = at(one.along.lo), end = at(one.along.hi);
    if (!lines.is_seen(begin) || !lines.is_seen(end)) continue;
    const double beyond = lines.in_scene(kBeyond, begin);
    const double seen = camera.is_parallel() ? glm::length(glm::cross(camera.view_direction(), one.axis.along)) : 1;
    if (seen > kSameAxis) {
      const double more = beyond / std::max(seen, 0.2);
      lines.segment(at(one.along.lo - more), at(one.along.hi + more), shown, false, false);
      continue;
    }
    const Vec3 origin = camera.ray(0, 0).origin;
    for (const Vec3& way : {camera.ray(1, 0).origin - origin, camera.ray(0, 1).origin - origin}) {
      const Vec3 arm = (one.radius + beyond) * glm::normalize(way);
      lines.segment(begin - arm, begin + arm, shown, false, false);
    }
  }
}

}  // namespace lekalo::render
