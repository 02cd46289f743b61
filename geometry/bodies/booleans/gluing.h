// A body from pieces of faces whose borders are shared strands.
#pragma once

#include <vector>

#include "geometry/bodies/booleans/imprint.h"

namespace lekalo::geometry {

// A face that is left, with its loops as directed curves that have it on their left in the parameter plane.
struct FacePiece {
  SurfacePtr surface;
  bool forward = true;
  Origin origin;
  std::vector<std::vector<DirectedCurve>> loops;  // the outer one first
};

// Strands that four or more pieces have are as many edges as the solid has there, vertices whose faces form several
// fans likewise. Faces of one connected shell each. Throws BooleanError where pieces do not close.
Body glued(const std::vector<FacePiece>& pieces, const Imprint& imprint);

}  // namespace lekalo::geometry
