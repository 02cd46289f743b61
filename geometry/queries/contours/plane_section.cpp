#include "geometry/queries/contours/plane_section.h"

#include "geometry/queries/contours/analytic/closed_contours.h"
#include "geometry/queries/contours/contour_parts.h"
#include "geometry/queries/contours/contours_of_function.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// Vanishes in the plane.
SurfaceFunction height_over(const Triple<double>& origin, const Triple<double>& normal) {
  SurfaceFunction height = {false, [=](const auto& s, const auto&, const auto&) { return dot(normal, s - origin); }};
  height.plane = Vec3(normal.x, normal.y, normal.z);
  return height;
}

}  // namespace

Contours plane_section(const SurfacePtr& surface, const Vec3& origin, const Vec3& normal) {
  demand_bounded(*surface);
  const Vec3 n = unit(normal, "the normal of the plane has no length");
  return of_parts(surface, 0, [&](const SurfacePtr& part) {
    if (auto exact = closed_section(part, origin, n, kSamePoint * bounds(*part).diameter())) return *exact;
    return contours_of(part, height_over(triple(origin), triple(n)));
  });
}

}  // namespace lekalo::geometry
