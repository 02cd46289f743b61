// Contours of surfaces with kinks or steps: those of their smooth parts, as far as the parts are the surface's own.
#pragma once

#include <functional>
#include <vector>

#include "geometry/contour.h"
#include "geometry/queries/implicit_curves/implicit_branches.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// What the sides of a branch leave of a contour, where a curve with the same parameter is on the right ones.
void add_kept(const Contour& whole, const Curve& where, const std::vector<ImplicitSide>& sides,
              std::vector<Contour>& kept);

// The contours that `search` finds on each smooth part of the surface. `image`: which of a contour's images is on it.
Contours of_parts(const SurfacePtr& surface, size_t image, const std::function<Contours(const SurfacePtr&)>& search);

}  // namespace lekalo::geometry
