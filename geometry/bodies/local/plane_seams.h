// Plane faces without seams and poles.
#pragma once

#include "geometry/body.h"

namespace lekalo::geometry {

// The body with the seams and poles of plane faces taken out (rings and discs that a segment makes about an axis):
// their loops become circles, on a Plane. Faces keep their numbers; a body without such faces is returned as it is.
Body without_plane_seams(const Body& body);

}  // namespace lekalo::geometry
