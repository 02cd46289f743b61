// Umbilics: places of a surface where both principal curvatures are equal (Golovanov 2016, 3.1; Maekawa, Wolter,
// Patrikalakis 1996).
#pragma once

#include <vector>

#include "geometry/surface.h"

namespace lekalo::geometry {

// The isolated ones inside the domain, as parameters. They are looked for from a grid of places of each smooth piece,
// 24 a side, so those nearer to each other than that may be taken for one; every place found is one, to 1e-7 of the
// curvature (of 1 / the surface's size where it is flatter). Regions of umbilics (spheres, planes) have none. Throws
// std::invalid_argument for an unbounded surface.
std::vector<Vec2> umbilics(const Surface& surface);

}  // namespace lekalo::geometry
