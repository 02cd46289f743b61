// Silhouettes of tori in closed form (Golovanov 2016, 4.6; capability 4.6e). In the torus's own coordinates its normal
// is m = (cos v e(u), sin v) with e(u) = (cos u, sin u), and i . m = 0 says
//
//   seen along d:        (d . e) cos v + d_z sin v = 0,
//   seen from the eye w: (w . e - R) cos v + w_z sin v = r.
//
// Both are solved for v: two curves, each once around the axis, as long as d_z, or w_z^2 - r^2, is not too near zero.
#pragma once

#include <optional>

#include "geometry/contour.h"
#include "geometry/queries/quadrics/canonical_surface.h"

namespace lekalo::geometry {

// Of a whole ring torus, also under an affine map, with the cusps of its picture. Nothing for other surfaces and views.
std::optional<Contours> torus_silhouette(const CanonicalSurface& torus, const ViewOf& view);

}  // namespace lekalo::geometry
