// Volume, area and centre of mass of closed shapes that only lines can ask (CSG, implicit solids), by integration over
// lines.
//
//   volume     integral of the chords' lengths over the points of a plane across one direction (Cavalieri), in three
//              directions
//   area       pi R^2 times twice the mean number of crossings of an isotropic line through a ball of radius R around
//              the shape (Cauchy, Crofton)
//
// Lines are aimed at the parts of the surface (Shape::surface_parts) one after another, each as large as its box, and
// the crossings that lie on a part are counted with its lines alone: small parts far apart, thin tubes and small holes
// get as many lines as large parts. So a chord is not seen as a whole, and volumes are sums over its two ends.
//
// Lines are points of a lattice shifted at random (Cranley, Patterson 1976); each integral is the mean of several
// shifts. Its error is three standard deviations of that mean, what parts that no line met may have all the same, and
// the rounding of coordinates. The same shape gives the same numbers every time.
#pragma once

#include "geometry/queries/measures/mass_properties.h"
#include "geometry/shape.h"

namespace lekalo::geometry {

struct ShapeMeasures {
  Measured area;
  Measured volume;
  Vec3 centroid{0};
  double centroid_error = 0;  // length
};

// Throws std::invalid_argument for a shape that is not closed, not bounded, or that no line meets.
ShapeMeasures measure(const Shape& shape);

}  // namespace lekalo::geometry
