// Silhouettes of surfaces (Golovanov 2016, 4.6).
#pragma once

#include "geometry/contour.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// Where the line of sight is tangent: i . (s_u x s_v) = 0 (4.6.5). Throws
// std::invalid_argument for an unbounded surface.
Contours silhouette(const SurfacePtr& surface, const ViewOf& view);

}  // namespace lekalo::geometry
