// Deformations of surfaces by B-splines over their parameters (Golovanov 2016, 3.16), for whoever deforms other things.
#pragma once

#include "geometry/describe.h"

namespace lekalo::geometry {

// Declares the fields that a deformation reads: count, degree, knots, heights, vectors, moves, axes.
void declare_deformation(TypeDeclaration& type);

// The bounded surface deformed by them, with its parameters. `plane_as_spline`: that of a plane is one B-spline.
SurfacePtr deformed_by(const SurfacePtr& of, const Fields& fields, bool plane_as_spline);

}  // namespace lekalo::geometry
