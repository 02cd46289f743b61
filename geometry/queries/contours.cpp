#include "geometry/queries/contours.h"

#include <cmath>
#include <stdexcept>

#include "geometry/queries/contour_assembly.h"
#include "geometry/surfaces/plane.h"

namespace lekalo::geometry {

namespace {

void demand_bounded(const Surface& surface) {
  if (!surface.bounded()) throw std::invalid_argument("the surface is unbounded: give it a domain");
}

bool meet(const Box3& a, const Box3& b, double by) {
  for (int k = 0; k < 3; ++k)
    if (a.lo[k] - by > b.hi[k] || b.lo[k] - by > a.hi[k]) return false;
  return true;
}

Triple<double> triple(const Vec3& v) { return {v.x, v.y, v.z}; }

Contours contours_of(const SurfacePtr& surface, const SurfaceFunction& function) {
  demand_bounded(*surface);
  const double size = std::max(bounds(*surface).diameter(), 1e-300);
  const Periods periods = surface->periods();
  ContourAssembly<2> assembly(size, kSamePoint * size, {periods.u, periods.v});
  for (const SurfacePiece& piece : surface->pieces())
    assembly.add(function_equations(surface, piece.domain, function));
  return assembly.joined();
}

// From the eye to the point, or the direction of sight.
template <class T>
Triple<T> sight(const ViewOf& view, const Triple<T>& s) {
  const Triple<double> from = triple(view.direction_or_eye);
  if (view.central) return s - from;
  return {T(from.x), T(from.y), T(from.z)};
}

Vec3 unit(const Vec3& v, const char* what) {
  const double length = glm::length(v);
  if (!(length > 0) || !std::isfinite(length)) throw std::invalid_argument(what);
  return v / length;
}

ViewOf checked(ViewOf view) {
  if (!view.central) view.direction_or_eye = unit(view.direction_or_eye, "the direction of sight has no length");
  return view;
}

}  // namespace

Contours intersect(const SurfacePtr& a, const SurfacePtr& b, double tolerance) {
  for (const bool swapped : {false, true}) {
    const auto* plane = dynamic_cast<const Plane*>(swapped ? a.get() : b.get());
    const SurfacePtr& other = swapped ? b : a;
    if (plane && !plane->bounded() && other->bounded())
      return plane_section(other, plane->frame().origin, plane->frame().z);
  }
  demand_bounded(*a);
  demand_bounded(*b);
  Box3 all = bounds(*a);
  all.include(bounds(*b));
  const double size = std::max(all.diameter(), 1e-300);
  const Periods of_a = a->periods(), of_b = b->periods();
  ContourAssembly<4> assembly(size, tolerance * size, {of_a.u, of_a.v, of_b.u, of_b.v});
  const std::vector<SurfacePiece> pieces_a = a->pieces(), pieces_b = b->pieces();
  std::vector<Box3> boxes_b;
  for (const SurfacePiece& piece : pieces_b) boxes_b.push_back(bounds(*b, piece));
  for (const SurfacePiece& piece_a : pieces_a) {
    const Box3 box = bounds(*a, piece_a);
    for (size_t k = 0; k < pieces_b.size(); ++k)
      if (meet(box, boxes_b[k], tolerance * size))
        assembly.add(meeting_equations(a, piece_a.domain, b, pieces_b[k].domain));
  }
  return assembly.joined();
}

Contours plane_section(const SurfacePtr& surface, const Vec3& origin, const Vec3& normal) {
  const Triple<double> n = triple(unit(normal, "the normal of the plane has no length")), o = triple(origin);
  return contours_of(surface, SurfaceFunction::from(false, [=](const auto& s, const auto&, const auto&) {
                       return dot(n, s - o);
                     }));
}

Contours silhouette(const SurfacePtr& surface, const ViewOf& given) {
  const ViewOf view = checked(given);
  return contours_of(surface, SurfaceFunction::from(true, [=](const auto& s, const auto& s_u, const auto& s_v) {
                       return dot(sight(view, s), cross(s_u, s_v));
                     }));
}

Contours isophote(const SurfacePtr& surface, const Vec3& direction, double angle) {
  if (!(angle > 0 && angle < kPi)) throw std::invalid_argument("the angle of an isophote lies between 0 and 180 degrees");
  const Triple<double> d = triple(unit(direction, "the direction of the light has no length"));
  const double cosine = surface->normal_sign() * std::cos(angle);
  return contours_of(surface, SurfaceFunction::from(true, [=](const auto&, const auto& s_u, const auto& s_v) {
                       const auto n = cross(s_u, s_v);
                       return dot(d, n) - cosine * length(n);
                     }));
}

// d = i - 2 (i . n) n / n^2 for the way of sight i; it meets the lamp where (s - p) x l . d = 0.
Contours reflection_line(const SurfacePtr& surface, const ViewOf& given, const Line& lamp) {
  const ViewOf view = checked(given);
  const Triple<double> p = triple(lamp.origin), l = triple(unit(lamp.direction, "the lamp has no direction"));
  return contours_of(surface, SurfaceFunction::from(true, [=](const auto& s, const auto& s_u, const auto& s_v) {
                       const auto n = cross(s_u, s_v);
                       const auto i = sight(view, s);
                       const auto mirrored = dot(n, n) * i - (2.0 * dot(i, n)) * n;
                       return dot(cross(s - p, l), mirrored);
                     }));
}

}  // namespace lekalo::geometry
