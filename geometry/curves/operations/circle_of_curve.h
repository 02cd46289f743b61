// Circular arcs, whatever curves they were given as.
#pragma once

#include <memory>

#include "geometry/curves/analytic/circle.h"

namespace lekalo::geometry {

// The circle that a curve runs along, its frame's x towards the curve's beginning and the curve counterclockwise, with
// the angle that it runs; none of another curve.
std::shared_ptr<const Circle> circle_of(const Curve& curve);

}  // namespace lekalo::geometry
