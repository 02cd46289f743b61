// Open or closed shells from separate surfaces whose borders coincide.
#pragma once

#include <span>

#include "geometry/body.h"

namespace lekalo::geometry {

// One untrimmed face for each surface, in order. Sides of their rectangles are one edge where they are the same curve
// with the same (or the opposite) parameters, to within `tolerance` times the size of all; a side of no length is a
// pole edge, both ends of a closed surface are a seam. Sides that coincide only in part stay separate edges. The faces
// keep the orientation of their surfaces, so a shell need not be oriented throughout. Throws std::invalid_argument for
// an unbounded surface. An edge has two faces at most, another one beside it gets the next two; with `crowded` all
// faces that meet there share it.
Body sew(std::span<const SurfacePtr> surfaces, double tolerance = 1e-9, bool crowded = false);

// The solid that surfaces enclose: sewn, its faces turned to look outward. Throws std::invalid_argument where they
// leave an opening (and says where), have only one side, or are in several parts.
Body enclosed_by(std::span<const SurfacePtr> surfaces, double tolerance = 1e-9);

}  // namespace lekalo::geometry
