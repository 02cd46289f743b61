#include "geometry/queries/contours/isophote.h"

#include <cmath>
#include <stdexcept>

#include "geometry/queries/contours/contour_parts.h"
#include "geometry/queries/contours/contours_of_function.h"

namespace lekalo::geometry {

namespace {

// Vanish on the lines.
SurfaceFunction lit_alike(const Triple<double>& direction, double cosine) {
  return {true, [=](const auto&, const auto& s_u, const auto& s_v) {
            const auto n = cross(s_u, s_v);
            return dot(direction, n) - cosine * length(n);
          }};
}

// d = i - 2 (i . n) n / n^2 for the line of sight i; it meets the lamp p + x l where (s - p) x l . d = 0.
SurfaceFunction mirrored(const ViewOf& view, const Triple<double>& p, const Triple<double>& l) {
  return {true, [=](const auto& s, const auto& s_u, const auto& s_v) {
            const auto n = cross(s_u, s_v);
            const auto i = sight(view, s);
            const auto d = dot(n, n) * i - (2.0 * dot(i, n)) * n;
            return dot(cross(s - p, l), d);
          }};
}

}  // namespace

Contours isophote(const SurfacePtr& surface, const Vec3& direction, double angle) {
  demand_bounded(*surface);
  if (!(angle > 0 && angle < kPi))
    throw std::invalid_argument("the angle of an isophote lies between 0 and 180 degrees");
  const Vec3 d = unit(direction, "the direction of the light has no length");
  return of_parts(surface, 0, [&](const SurfacePtr& part) {
    return contours_of(part, lit_alike(triple(d), part->normal_sign() * std::cos(angle)));
  });
}

Contours reflection_line(const SurfacePtr& surface, const ViewOf& given, const Line& lamp) {
  demand_bounded(*surface);
  const ViewOf view = checked(given);
  const Vec3 l = unit(lamp.direction, "the lamp has no direction");
  return of_parts(surface, 0, [&](const SurfacePtr& part) {
    return contours_of(part, mirrored(view, triple(lamp.origin), triple(l)));
  });
}

}  // namespace lekalo::geometry
