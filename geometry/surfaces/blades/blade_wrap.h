// The surface of a turbine blade as one smooth sheet wrapped about its leading edge (Zavyalov et al. 1985, VII.3).
#pragma once

#include "geometry/surfaces/splines/nurbs_surface.h"

namespace lekalo::geometry {

// u is the mean length along the sections from the leading edge, negative on the pressure side; v runs from section to
// section, 0 to 1 or through the given values. The normal looks out of the blade.
struct BladeWrap {
  NurbsSurface whole;
  double pressure_length = 0, suction_length = 0;  // u of the trailing edge is -pressure_length and suction_length
};

// A whole blade_surface. Throws FieldError (field of) for another one.
BladeWrap wrap_of(const Surface& whole);

// One side from that length beside the leading edge on: u from 0 there to 1 at the trailing edge.
NurbsSurface pressure_side(const BladeWrap& wrap, double from);
NurbsSurface suction_side(const BladeWrap& wrap, double from);

}  // namespace lekalo::geometry
