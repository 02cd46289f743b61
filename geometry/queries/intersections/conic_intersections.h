// Where a straight line or a conic meets a plane, and a line a conic, in closed form: most edges of
// solids that are put together, and the planes of most of their faces.
//
// The height of r(t) = o + f(t) x + g(t) y above the plane is linear in f and g (conic.h). Where it vanishes the curve
// crosses; where it is stationary within the tolerance it touches; where it keeps within the tolerance the curve lies
// in the plane and is on the surface between its intersections with the surface's borders.
#pragma once

#include <optional>

#include "geometry/queries/intersections/curve_intersections.h"

namespace lekalo::geometry {

// As intersect() has it (curve_intersections.h); `tolerance` is a length. None where the curve is no such conic or the
// surface no plane, also under affine maps.
std::optional<SurfaceIntersections> conic_intersections(const Curve& curve, const Surface& surface, double tolerance);

// A straight line and a conic (Golovanov 2016, 4.3): they meet where the conic meets the plane through the
// line and along the conic's normal. None where the curves are no such pair, or the line is along that normal.
std::optional<CurveIntersections> line_conic_intersections(const Curve& a, const Curve& b, double tolerance);

}  // namespace lekalo::geometry
