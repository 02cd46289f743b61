// Points that several surfaces have in common, near to a known place.
#pragma once

#include <array>
#include <optional>

#include "geometry/bodies/local/support.h"

namespace lekalo::geometry {

// A surface and parameters near to the point.
struct SurfaceNear {
  SurfacePtr surface;
  std::optional<Frame> plane;
  Vec2 near{0};
};

// Of three surfaces: of planes by Cramer's rule (the spec's formula of Golovanov 2016, 6.7), else by Newton's method
// for r_0 = r_1 = r_2. Nothing where they do not meet, to within rounding of coordinates of that size.
std::optional<Vec3> common_point(const std::array<SurfaceNear, 3>& of, double size);

// Of two, the one nearest to where the parameters are.
std::optional<Vec3> nearest_common_point(const SurfaceNear& a, const SurfaceNear& b, double size);

// Of the curve r(image(t)) and a surface, t from `t` on.
std::optional<Vec3> piercing_point(const Surface& surface, const Curve& image, double t, const SurfaceNear& other,
                                   double size);

// How far a point is from a surface.
double distance_from(const SurfaceNear& of, const Vec3& point);

}  // namespace lekalo::geometry
