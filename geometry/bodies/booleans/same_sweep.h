// Surfaces that one curve makes as it moves, known by that curve: of revolution about one axis, or extruded one way.
#pragma once

#include "geometry/surface.h"

namespace lekalo::geometry {

// Whether both surfaces are of revolution about one axis, or extruded in one direction, by curves that are the same but
// for that motion, within a length. Curves of revolution must lie in a half-plane of the axis, extruded ones in a
// plane; false for others, and where only parts of the curves are the same.
bool are_one_sweep(const SurfacePtr& a, const SurfacePtr& b, double tolerance);

// Whether both are such surfaces, with one axis or direction, by curves that meet nowhere but at ends of one of them:
// then the surfaces meet at most along their borders there. False also where that is not known.
bool sweeps_meet_at_borders(const SurfacePtr& a, const SurfacePtr& b, double tolerance);

}  // namespace lekalo::geometry
