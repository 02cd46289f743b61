// Volume, area and centre of mass of closed shapes that only lines can ask (CSG, implicit solids), by integration over
// lines.
//
//   volume     integral of the chords' lengths over the points of a plane across one direction (Cavalieri), in three
//              directions
//   area       pi R^2 times twice the mean number of crossings of an isotropic line through a ball of radius R around
//              the shape (Cauchy, Crofton)
//
// Lines are points of a lattice shifted at random (Cranley, Patterson 1976); each integral is the mean of several
// shifts, its error three standard deviations of that mean. The same shape gives the same numbers every time.
#pragma once

#include "geometry/queries/mass_properties.h"
#include "geometry/shape.h"

namespace lekalo::geometry {

struct ShapeMeasures {
  Measured area;
  Measured volume;
  Vec3 centroid{0};
  double centroid_error = 0;  // length
};

// Throws std::invalid_argument for a shape that is not closed, not bounded, or empty.
ShapeMeasures measure(const Shape& shape);

}  // namespace lekalo::geometry
