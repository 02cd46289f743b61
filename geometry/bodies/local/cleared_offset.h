// Offsets of bodies with curved faces that pass through themselves (Golovanov 2016, 6.7 step 6), where they can be put
// together of others that do not.
#pragma once

#include <optional>

#include "geometry/body.h"

namespace lekalo::geometry {

// Whether a face is rounder than the distance wherever one looks, so that its offset would be inside out.
bool has_vanishing_face(const Body& body, double distance);

// The body at the distance (positive to the outside), its faces continued until they meet. Faces that are rounder than
// the distance have no counterpart: holes, bosses and fillets that vanish are taken away first. Where two others run
// into each other the body is the union (inward: the intersection) of two bodies, each without one of them, and
//
//   offset(A + B) = offset(A) + offset(B) to the outside,   offset(A * B) = offset(A) * offset(B) to the inside
//
// Nothing where neither is so, or where the result is nearer to the body than the distance.
std::optional<Body> cleared_offset(const Body& body, double distance);

}  // namespace lekalo::geometry
