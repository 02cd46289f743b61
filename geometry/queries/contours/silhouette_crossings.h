// Where a line on a surface goes round it, as seen: the line of sight i touches the surface there,
//
//   i . (s_u x s_v) = 0 at (u, v) = x(t), the line's image (Golovanov 2016, 4.6.5, along a line),
//
// or of an implicit surface i . grad F = 0 at r(t).
#pragma once

#include <vector>

#include "geometry/contour.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

class ImplicitFormula;

// Adds the parameters of the line at such places to `turns`, in no order, and one in the middle of a piece perhaps
// twice. The line, whose pieces these are, and its image have one parameter; the view is that of the surface's own
// coordinates. A certified search; where the bounds of a line are too wide to tell, changes of sign between many
// places: those of rounding where the surface is seen edge-on along a stretch.
void add_silhouette_crossings(const Curve& line, const Surface& surface, const Curve& image, const ViewOf& view,
                              std::vector<double>& turns);
// Those of a curve on an implicit surface, in order (curve_sign_changes.h).
std::vector<double> silhouette_crossings(const Curve& curve, bool closed, const ImplicitFormula& formula,
                                         const ViewOf& view);

}  // namespace lekalo::geometry
