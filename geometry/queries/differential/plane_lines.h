// Whether a surface lies in a plane, and its lines of parameter in parallel planes (Zavyalov et al. 1985, II.4,
// condition 119: all derivatives along the lines are perpendicular to one vector).
#pragma once

#include <optional>

#include "geometry/surface.h"

namespace lekalo::geometry {

// Unit normals of the planes; none where there is no such plane. Of straight lines that are parallel there are many
// planes: one of them.
struct PlaneLines {
  std::optional<Vec3> surface;  // the plane of all points
  std::optional<Vec3> along_u;  // of the lines v = const
  std::optional<Vec3> along_v;  // of the lines u = const
};

// To rounding: of a polynomial spline by its control points, else by places of each smooth piece. The domain must be
// finite.
PlaneLines plane_lines(const Surface& surface);

}  // namespace lekalo::geometry
