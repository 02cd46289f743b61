// Surfaces continued beyond their borders (Golovanov 2016, 3.15), for whoever makes other things of them.
#pragma once

#include "geometry/surface.h"

namespace lekalo::geometry {

// The surface over another rectangle, with its parameters and side: by its own law where it has one, else along its
// tangents at the border. The surface is bounded, or a plane. Throws std::invalid_argument where the law ends before
// (an axis, more than a turn).
SurfacePtr extended_to(const SurfacePtr& of, const Rectangle& domain);

}  // namespace lekalo::geometry
