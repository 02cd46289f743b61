// A surface in place of one that is made of the evaluations of others: its fitted patches
// (geometry/queries/rays/fitted_pieces.h). They are evaluated and enclosed as polynomials, at a fraction of the cost.
#pragma once

#include "geometry/surface.h"

namespace lekalo::geometry {

// Has the domain, periods, pieces, normals and degenerate edges of the surface. Points differ by about kFitDistance of
// its size at most, and enclosures contain the derivatives of both: those of the difference are estimated by Markov's
// inequality from the distance seen. For pictures; what is to be exact asks the surface itself. Surfaces that are not
// composed, have exact patches or no bounds, are their own copies.
SurfacePtr fitted_copy(const SurfacePtr& surface);

}  // namespace lekalo::geometry
