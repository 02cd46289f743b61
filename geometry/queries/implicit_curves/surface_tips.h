// Tips of surfaces of formulas: isolated places where a root or power of zero has no derivatives, as that of
// sqrt(u^2 + v^2).
#pragma once

#include <vector>

#include "geometry/surface.h"

namespace lekalo::geometry {

// Places in the domain about which no halving bounds the derivatives. None where they are lines or too many to tell.
std::vector<Vec2> surface_tips(const Surface& surface);

// The pieces of a surface, cut along both parameter lines through each tip: inside of them derivatives are bounded.
std::vector<SurfacePiece> pieces_about_tips(const Surface& surface, const std::vector<Vec2>& tips);

}  // namespace lekalo::geometry
