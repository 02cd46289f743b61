// Surfaces continued beyond their borders (Golovanov 2016, 3.15), for whoever makes other things of them.
#pragma once

#include "geometry/surface.h"

namespace lekalo::geometry {

// The same law, parameters as before, over another rectangle: planes, spheres, tori, cones, formulas, extrusions,
// revolutions, and images of these. Null where none is known. The surface is not reversed. Throws std::invalid_argument
// for a rectangle that the law does not allow (beyond a pole there is nothing).
SurfacePtr continued_by_law(const SurfacePtr& of, const Rectangle& domain);

// The surface over another rectangle, with its parameters and side: by its own law where it has one, else along its
// tangents at the border. The surface is bounded, or a plane. Throws std::invalid_argument where the law ends before
// (an axis, more than a turn).
SurfacePtr extended_to(const SurfacePtr& of, const Rectangle& domain);

}  // namespace lekalo::geometry
