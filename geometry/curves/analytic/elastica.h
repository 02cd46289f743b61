// Elastic laths through points (Zavyalov et al. 1985, introduction; Horn 1983; Levien 2009).
#pragma once

#include <optional>

#include "geometry/curves/splines/nurbs_curve.h"

namespace lekalo::geometry {

// A plane curve through the points that makes the integral of its squared curvature stationary, of all curves of any
// length: what a thin lath does that slides without friction through supports, free at its ends or with directions
// given there. t is the length of arc. Pieces of degree 5 agree with the solution to about 1e-10 of its size. Throws
// FieldError (field points) for points that do not lie in a plane, coincide, or through which no such curve was found;
// (start_tangent, end_tangent) for directions out of the plane.
NurbsCurve elastica(std::span<const Vec3> points, const std::optional<Vec3>& start_tangent = {},
                    const std::optional<Vec3>& end_tangent = {});

}  // namespace lekalo::geometry
