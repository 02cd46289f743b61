// Sections of surfaces by planes (Golovanov 2016, 4.7).
#pragma once

#include "geometry/contour.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// Throws std::invalid_argument for an unbounded surface.
Contours plane_section(const SurfacePtr& surface, const Vec3& origin, const Vec3& normal);

}  // namespace lekalo::geometry
