// Faces that go on in one another on one surface become one (Golovanov 2016, 6.2: overlapping faces).
#pragma once

#include <vector>

#include "geometry/bodies/booleans/gluing.h"

namespace lekalo::geometry {

// Pieces of one surface that meet along what was its seam, and pieces in one plane that meet along an edge with equal
// normals. A merged piece has the first one's origin.
void merge_pieces(std::vector<FacePiece>& pieces, const Imprint& imprint);

}  // namespace lekalo::geometry
