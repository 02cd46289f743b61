// Contours cut to where they count: on the right sides of the parts of a surface, inside of a rectangle.
#pragma once

#include <functional>
#include <vector>

#include "geometry/contour.h"
#include "geometry/queries/implicit_curves/smooth_parts.h"

namespace lekalo::geometry {

// What the sides of a branch leave of a contour, where a curve with the same parameter is on the right ones.
void add_kept(const Contour& whole, const Curve& where, const std::vector<ImplicitSide>& sides,
              std::vector<Contour>& kept);

// What of a contour is in a rectangle, where a plane curve with the same parameter is in it.
void add_inside(const Contour& whole, const Curve& where, const Rectangle& domain, std::vector<Contour>& kept);

// Contours of the smooth parts of a surface with kinks or steps, by `search`, as far as the parts are the surface's
// own: they end at the borders. Of any other surface those of it. `image`: which of a contour's images is on it.
Contours of_parts(const SurfacePtr& surface, size_t image, const std::function<Contours(const SurfacePtr&)>& search);

}  // namespace lekalo::geometry
