// Cusps of the picture of a silhouette: where the curve runs along the line of sight (Golovanov 2016, 4.6).
#pragma once

#include <vector>

#include "geometry/contour.h"
#include "geometry/queries/contours/silhouette.h"

namespace lekalo::geometry {

// The zeros of m . (r' x i), by t in order, for a branch that silhouette() found for this view (its direction a unit
// vector). Everywhere else intervals show that there is none, as certain as the curve's second derivative is; but of
// two cusps within 1e-7 of the branch both would be lost, and nothing is known of the last 1e-6 of the size before a
// singular point and of stretches along which the curve keeps to the line of sight.
std::vector<double> picture_cusps(const Surface& surface, const Contour& branch, const ViewOf& view);

}  // namespace lekalo::geometry
