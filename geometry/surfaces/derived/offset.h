// Offset surfaces of constant distance (Golovanov 2016, 3.15.4), for whoever makes other things of them.
#pragma once

#include "geometry/surface.h"

namespace lekalo::geometry {

// s + d m with the parameters of s, m the normal of s, turned round for a reversed one. Throws FieldError (field of)
// for a surface with a pole, unless its offset is a surface of its own kind.
SurfacePtr offset_surface(const SurfacePtr& of, double distance);

}  // namespace lekalo::geometry
