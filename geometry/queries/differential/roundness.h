// Whether a curve is a circular arc and a surface has a radius, whatever they were made from.
#pragma once

#include "geometry/curve.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// Whether the curve runs on one circle: a circle or an arc, also as an ellipse, a spline or a moved copy that is one.
// Judged at 33 parameters to a millionth of the radius.
bool is_round(const Curve& curve);

// Whether the parameter lines of one direction are circular arcs: spheres, cylinders, cones, tori and other surfaces
// of revolution, however they are given. Judged on three lines of each direction. Unbounded directions are judged on
// the part from -1 to 1.
bool is_round(const Surface& surface);

}  // namespace lekalo::geometry
