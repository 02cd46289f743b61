#include "geometry/queries/contours/silhouette.h"

#include <cmath>

#include "geometry/queries/contours/analytic/closed_contours.h"
#include "geometry/queries/contours/contour_parts.h"
#include "geometry/queries/contours/contours_of_function.h"
#include "geometry/queries/contours/picture_cusps.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// Vanishes on the silhouette.
SurfaceFunction outline(const ViewOf& view) {
  return {true,
          [view](const auto& s, const auto& s_u, const auto& s_v) { return dot(sight(view, s), cross(s_u, s_v)); }};
}

}  // namespace

// Whether the line of sight runs in the surface everywhere in a part of its domain: a cylinder along its axis, a cone
// from its tip, a facet. All that is seen of it are its borders.
static bool is_edge_on(const Surface& surface, const Rectangle& part, const ViewOf& view) {
  constexpr int kSteps = 6;
  constexpr double kFlat = 1e-12;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const double u = part.u.lo + part.u.width() * (i + 0.5) / kSteps,
                   v = part.v.lo + part.v.width() * (j + 0.5) / kSteps;
      const Vec3 sight = view.central ? surface.point(u, v) - view.direction_or_eye : view.direction_or_eye;
      if (std::abs(glm::dot(surface.normal(u, v), sight)) > kFlat * glm::length(sight)) return false;
    }
  return true;
}

static Contours smooth_silhouette(const SurfacePtr& surface, const ViewOf& view) {
  if (is_edge_on(*surface, surface->domain(), view)) return {};
  if (auto exact = closed_silhouette(surface, view, kSamePoint * bounds(*surface).diameter())) return *exact;
  Contours found =
      contours_of(surface, outline(view), [&](const Rectangle& piece) { return is_edge_on(*surface, piece, view); });
  for (Contour& contour : found.branches) contour.cusps = picture_cusps(*surface, contour, view);
  return found;
}

Contours silhouette(const SurfacePtr& surface, const ViewOf& given) {
  demand_bounded(*surface);
  const ViewOf view = checked(given);
  return of_parts(surface, 0, [&](const SurfacePtr& part) { return smooth_silhouette(part, view); });
}

}  // namespace lekalo::geometry
