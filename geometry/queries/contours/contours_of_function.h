// The contours of one surface along which a function of its points and tangents vanishes, and what queries of this
// kind have in common.
#pragma once

#include <functional>

#include "geometry/contour.h"
#include "geometry/queries/contours/contour_equations.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

using IsLeftOut = std::function<bool(const Rectangle& piece)>;

// Those of smooth parts end at the creases between them. A part all of whose pieces are left out has none.
Contours contours_of(const SurfacePtr& surface, const SurfaceFunction& function, const IsLeftOut& is_left_out = {});

// Whether a surface goes on beyond the upper borders of a piece, in u and in v.
std::array<bool, 2> goes_on(const Surface& surface, const Rectangle& piece);

// Throws std::invalid_argument for an unbounded surface.
void demand_bounded(const Surface& surface);

// v / |v|; throws std::invalid_argument with this message where there is no length.
Vec3 unit(const Vec3& v, const char* message);

// The same view with a unit direction; throws std::invalid_argument.
ViewOf checked(ViewOf view);

inline Triple<double> triple(const Vec3& v) { return {v.x, v.y, v.z}; }

// From the eye to the point, or the direction of sight.
template <class T>
Triple<T> sight(const ViewOf& view, const Triple<T>& s) {
  const Triple<double> from = triple(view.direction_or_eye);
  if (view.central) return s - from;
  return {T(from.x), T(from.y), T(from.z)};
}

}  // namespace lekalo::geometry
