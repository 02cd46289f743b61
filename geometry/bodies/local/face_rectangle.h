// The rectangle of parameters that a face lies on.
#pragma once

#include "geometry/body.h"

namespace lekalo::geometry {

// The surface of a face over the rectangle of its loops, looking outward. Throws std::invalid_argument as extended_to.
SurfacePtr over_its_rectangle(const Body& body, int face);

}  // namespace lekalo::geometry
