// Curves and surfaces under affine maps, exactly: nothing is sampled or approximated.
#pragma once

#include "geometry/surface.h"

namespace lekalo::geometry {

// M r(t) (Golovanov 2016, 2.15.6): the same parameters, period and pieces. A map of an image is folded into one map;
// the identity gives the curve itself. Throws std::invalid_argument for a map that flattens space.
CurvePtr transformed_curve(CurvePtr curve, const Affine& map);

// M r(u, v): the same parameters, periods, pieces and reversed(). The normal is that of r_u x r_v of the image: a
// mirror does not keep the side that it points to in the way a solid would (reverse it where that is wanted).
SurfacePtr transformed_surface(SurfacePtr surface, const Affine& map);

}  // namespace lekalo::geometry
