#include "geometry/bodies/booleans/turned_ball.h"

#include <algorithm>
#include <cmath>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"

namespace lekalo::geometry {

namespace {

constexpr double kSame = 1e-13;  // of directions, and of lengths by the radius

const SphereSurface* whole_ball(const Body& body) {
  if (body.faces.size() != 1 || body.faces[0].trimmed || !body.faces[0].forward) return nullptr;
  const auto* sphere = dynamic_cast<const SphereSurface*>(body.faces[0].surface.get());
  if (!sphere || sphere->reversed()) return nullptr;
  const Rectangle full = SphereSurface::kFull, domain = sphere->domain();
  return domain.u == full.u && domain.v == full.v ? sphere : nullptr;
}

// About z a surface cuts the sphere in circles; x is where its own seam is.
struct Axis {
  Vec3 z, x;
};

std::optional<Axis> axis_through(const Frame& frame, const SphereSurface& sphere) {
  const Vec3 from = sphere.frame().origin - frame.origin;
  if (glm::length(from - glm::dot(from, frame.z) * frame.z) > kSame * (sphere.radius() + glm::length(from)))
    return std::nullopt;
  return Axis{frame.z, frame.x};
}

std::optional<Axis> axis_of(const Surface& surface, const SphereSurface& sphere) {
  if (const auto* plane = dynamic_cast<const Plane*>(&surface)) return Axis{plane->frame().z, Vec3(0)};
  if (const auto* cone = dynamic_cast<const ConeSurface*>(&surface)) return axis_through(cone->frame(), sphere);
  if (const auto* torus = dynamic_cast<const TorusSurface*>(&surface)) return axis_through(torus->frame(), sphere);
  if (const auto* other = dynamic_cast<const SphereSurface*>(&surface)) {
    const Vec3 between = other->frame().origin - sphere.frame().origin;
    const double length = glm::length(between);
    if (length > kSame * sphere.radius()) return Axis{between / length, Vec3(0)};
  }
  return std::nullopt;
}

bool may_meet(const Body& body, int face, const SphereSurface& sphere) {
  const Vec3 center = sphere.frame().origin;
  const auto* plane = dynamic_cast<const Plane*>(body.faces[face].surface.get());
  if (plane && std::abs(glm::dot(center - plane->frame().origin, plane->frame().z)) >= sphere.radius()) return false;
  const Box3 box = bounds(body, face);
  const Vec3 nearest = glm::clamp(center, box.lo, box.hi);
  return glm::length(nearest - center) < sphere.radius();
}

}  // namespace

std::optional<Body> turned_ball(const Body& body, const Body& other) {
  const SphereSurface* sphere = whole_ball(body);
  if (!sphere) return std::nullopt;
  std::optional<Axis> axis;
  for (size_t f = 0; f < other.faces.size(); ++f) {
    if (!may_meet(other, static_cast<int>(f), *sphere)) continue;
    const auto found = axis_of(*other.faces[f].surface, *sphere);
    if (!found || (axis && glm::length(glm::cross(axis->z, found->z)) > kSame)) return std::nullopt;
    if (!axis || axis->x == Vec3(0)) axis = found;
  }
  if (!axis || glm::length(glm::cross(axis->z, sphere->frame().z)) <= kSame) return std::nullopt;
  const Vec3 center = sphere->frame().origin;
  Body turned =
      ball(axis->x == Vec3(0) ? frame_about(center, axis->z) : frame_from(center, axis->z, axis->x), sphere->radius());
  for (size_t k = 0; k < turned.vertices.size(); ++k) turned.vertices[k].origin = body.vertices[k].origin;
  for (size_t k = 0; k < turned.edges.size(); ++k) turned.edges[k].origin = body.edges[k].origin;
  turned.faces[0].origin = body.faces[0].origin;
  return turned;
}

}  // namespace lekalo::geometry
