// Pieces of curve polygons that body edges share.
#pragma once

#include <vector>

#include "geometry/curve.h"
#include "geometry/tessellation/tessellate.h"

namespace lekalo::geometry {

// Ends of the domain and the parameters between them where the curve's direction jumps or is not defined.
std::vector<double> corner_parameters(const Curve& curve);

// Sag of the chord from a to b as a multiple of the tolerance at its middle, and turn of the tangent as a multiple of
// the angle; the larger of the two. At most 1 when the chord is fine enough.
double chord_excess(const Curve& curve, double a, double b, const TessellationTolerance& tolerance);

// Parameters from a to b without corners between them.
std::vector<double> smooth_polygon(const Curve& curve, double a, double b, const TessellationTolerance& tolerance);

}  // namespace lekalo::geometry
