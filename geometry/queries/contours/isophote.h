// Isophotes and reflection lines: how stylists judge surfaces.
#pragma once

#include "geometry/contour.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// These throw std::invalid_argument for an unbounded surface.
// Where the normal (that of the surface) stands at `angle` to `direction`; pi/2 is the silhouette. In (0, pi).
Contours isophote(const SurfacePtr& surface, const Vec3& direction, double angle);
// Where the mirrored line of sight meets the straight line `lamp`: how stylists judge a surface.
Contours reflection_line(const SurfacePtr& surface, const ViewOf& view, const Line& lamp);

}  // namespace lekalo::geometry
