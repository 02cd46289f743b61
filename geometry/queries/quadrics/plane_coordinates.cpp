#include "geometry/queries/quadrics/plane_coordinates.h"

#include "geometry/queries/quadrics/canonical_surface.h"

namespace lekalo::geometry {

std::optional<PlaneCoordinates> plane_coordinates(const Vec3& point, const SurfacePtr& plane) {
  const auto known = canonical(plane);
  if (!known || known->kind != CanonicalSurface::Kind::plane) return std::nullopt;
  const SurfaceJet at = plane->evaluate(0, 0, 1);
  PlaneCoordinates result;
  result.origin = at.point();
  result.inverse = glm::inverse(Mat3(at.du(), at.dv(), plane->normal(0, 0)));
  const Vec3 local = result.inverse * (point - result.origin);
  result.u = local.x, result.v = local.y, result.distance = local.z;
  return result;
}

}  // namespace lekalo::geometry
