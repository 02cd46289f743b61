// Intersections of surfaces with implicit surfaces.
#pragma once

#include "geometry/contour.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

class ImplicitFormula;

// Where F of a point has the value of its level, the surface's points taken to F's coordinates by an affine map: the
// line in which an implicit surface meets this one. Not complete where F has jumps.
Contours level_section(const SurfacePtr& surface, const ImplicitFormula& formula, const Affine& to_formula = {});

}  // namespace lekalo::geometry
