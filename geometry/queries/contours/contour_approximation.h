// Contours and parameter lines for whoever asks many questions of one.
#pragma once

#include <array>

#include "geometry/contour.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// A contour that was searched, a part of one, or a parameter line, which evaluate surfaces for every point, as a
// piecewise polynomial that agrees with it to 1e-13 of its size, or 4e-15 of its coordinates if that is more
// (curves/polynomial_approximation.h); any other curve, and one too crooked for that, itself. `coarsest`: a share of
// the size that is near enough where `finest` cannot be had, as beside a place where a contour crosses itself.
CurvePtr contour_approximation(const CurvePtr& curve, double coarsest = 1e-13, double finest = 1e-13);

// The same to a length, in as few parts as serve: of a small contour rounding may be more than a share of its size.
CurvePtr contour_approximation_within(const CurvePtr& curve, double length);

// The image of such a contour on a surface, likewise, in shares of the surface's domain; itself where that is
// unbounded.
Curve2Ptr contour_approximation(const CurvePtr& curve, const Surface& surface, const Curve2Ptr& image,
                                double coarsest = 1e-13, double finest = 1e-13);

// The same to what moves the surface's point by a length at most, as far as a few places tell.
Curve2Ptr contour_approximation_within(const CurvePtr& curve, const Surface& surface, const Curve2Ptr& image,
                                       double length);

// An intersection with both images, whose equations are solved once for all three at each place.
struct ContourApproximation {
  CurvePtr curve;
  std::array<Curve2Ptr, 2> images;
};
ContourApproximation contour_approximation(const Contour& contour, const std::array<const Surface*, 2>& surfaces,
                                           double coarsest, double finest = 1e-13);

}  // namespace lekalo::geometry
