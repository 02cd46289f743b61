// Meshes for T-splines that are fine only where they need to be (Morgenstern, Peterseim 2015): cells are halved in turn
// along u and along v, and coarser cells near a halved one with it, so that continuations of lines along u and along v
// do not cross: the functions are independent and sum to 1.
#pragma once

#include "geometry/surfaces/splines/t_spline.h"

namespace lekalo::geometry {

// The T-spline of this odd degree near a surface, by least squares, on a mesh that begins with `cells_u` by `cells_v`
// cells over its domain and is refined where the two are farther apart than the tolerance at places of a cell. Throws
// FieldError (field tolerance) where that takes too many points.
TSpline t_spline_within(const Surface& of, int degree, int cells_u, int cells_v, double tolerance);

}  // namespace lekalo::geometry
