// Offset bodies with round joints: what a ball reaches whose center is in the body.
#pragma once

#include "geometry/body.h"

namespace lekalo::geometry {

// The parallel body at a distance h > 0 of a convex one: its faces set off, cylinders and tori of radius h about its
// edges, balls about its vertices. By Steiner's formula its volume is V + A h + M h^2 + 4 pi/3 h^3. Faces keep their
// names, those about edges and vertices have the edges' names, and vertex.k. Throws FieldError (that field) for edges
// that are concave, or neither straight nor circles, and for tips that are no vertices of edges.
Body round_offset(const Body& body, double h, const char* field);

}  // namespace lekalo::geometry
