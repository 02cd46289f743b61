// A point in the axes of a plane (Golovanov 2016, 4.2): p = s_0 + u s_1 + v s_2 + l m, s_1 and s_2 at any angle, m the
// unit normal; so [u v l] = A^-1 (p - s_0), A with the columns s_1, s_2, m.
#pragma once

#include <optional>

#include "geometry/surface.h"

namespace lekalo::geometry {

struct PlaneCoordinates {
  double u = 0, v = 0;
  double distance = 0;  // signed by the plane's normal
  Vec3 origin{0};       // s_0
  Mat3 inverse{1.0};    // A^-1
};

// Also beyond the plane's borders; nothing for a surface that is no plane, or a plane under an affine map.
std::optional<PlaneCoordinates> plane_coordinates(const Vec3& point, const SurfacePtr& plane);

}  // namespace lekalo::geometry
