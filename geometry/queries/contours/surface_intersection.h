// Intersections of two surfaces (Golovanov 2016, 4.7 and 4.8).
#pragma once

#include "geometry/contour.h"
#include "geometry/surface.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

// `tolerance` is relative to the size of both: surfaces that come so near to each other touch. Throws
// std::invalid_argument for unbounded surfaces other than planes, and for two unbounded planes.
Contours intersect(const SurfacePtr& a, const SurfacePtr& b, double tolerance = kSamePoint);

}  // namespace lekalo::geometry
