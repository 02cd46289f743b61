// Lengths of contours.
#pragma once

#include "geometry/contour.h"
#include "geometry/queries/measures/mass_properties.h"

namespace lekalo::geometry {

// The length of a part of a contour that was searched: by Gauss's rule on each of its pieces, which are short arcs.
// Other rules for curves ask for more digits than a tiny loop between large surfaces has. A part of a closed contour
// may go on past the end of its domain.
Measured contour_length(const Contour& contour, const Interval& t);
inline Measured contour_length(const Contour& contour) { return contour_length(contour, contour.curve->domain()); }

}  // namespace lekalo::geometry
