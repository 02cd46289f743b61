// The way along which limits at singular places are taken.
#pragma once

#include "geometry/surface.h"

namespace lekalo::geometry {

// From (u, v) towards the middle of the domain, as long in each parameter as its range (1 where that has no end): a
// part below 1/2 of it leads to a place inside.
Vec2 inward_step(const Rectangle& domain, double u, double v);

}  // namespace lekalo::geometry
