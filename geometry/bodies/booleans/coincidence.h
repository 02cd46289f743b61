// Surfaces that lie on one another, and the images of curves on them.
#pragma once

#include "geometry/curve.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// Whether two surfaces that are known by their equations, are one, or are the same sweep (same_sweep.h) have the same
// equation within a length; nothing where the equations are not known. `size` is that of what lies on them.
std::optional<bool> have_same_equation(const SurfacePtr& a, const SurfacePtr& b, const Vec3& near, double size,
                                       double tolerance);

// The parameters of a point that lies on the surface.
Vec2 parameters_on(const SurfacePtr& surface, const Vec3& p);

// An image that trims know how to handle at once: straight where it is, within 1e-13 of the parameters, constant where
// one of its coordinates is, else a polynomial.
Curve2Ptr simple_image(const Surface& surface, const Curve2Ptr& image);

// The image of a curve in the parameter plane of a surface on which it lies, with the curve's parameter: affine for a
// plane, else to 1e-13 of the parameters. Where the surface is periodic the image may begin in any period. Null where
// none is found (a curve through a pole between its ends).
Curve2Ptr image_on(const SurfacePtr& surface, const CurvePtr& curve);

}  // namespace lekalo::geometry
