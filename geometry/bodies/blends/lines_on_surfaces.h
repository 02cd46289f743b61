// Edges of blends with their images: parameter lines, and curves that lie on a surface.
#pragma once

#include "geometry/bodies/topology/line_on_surface.h"
#include "geometry/bodies/topology/near_foot.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// The parameter line between two places of a surface that differ in u or in v alone: a segment or a circle where it is
// one (of planes, cones, spheres, tori), else with the surface's parameter.
LineOnSurface line_between(const SurfacePtr& surface, const Vec2& from, const Vec2& to);

// The image of a curve that lies on a surface (to rounding). `near`: the parameters near to the curve's middle, which
// say where angles begin. Exact in a plane, else a polynomial fitted to 1e-13 of the parameters. Null where there is
// none.
Curve2Ptr image_on(const SurfacePtr& surface, const CurvePtr& curve, const Vec2& near);

}  // namespace lekalo::geometry
