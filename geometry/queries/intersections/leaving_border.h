// Curves that end on the border of a surface and leave it there.
//
// Where an end of the curve lies on a border v = v0 of the surface, P = s(u0, v0), another point of both is
//
//   r(t) - P = t R = (u - u0) S_u + (v - v0) S_v,
//
// t counted from the end, R, S_u, S_v means of the derivatives along the way. Interaction along any n, with D(a, b) =
// n . (a x b): t D(S_u, R) = (v - v0) D(S_u, S_v). So there is none if the signs of both D, which the boxes of the
// derivatives tell, put v beyond the border; the curve may leave in the tangent plane, as lines of the next patch do.
// The same of borders u = u0. An end that is off the border by e shifts t D(S_u, R) by |S_u| e, which the part at the
// end that no cell holds pays for.
#pragma once

#include "geometry/queries/intersections/crossing_candidates.h"

namespace lekalo::geometry {

// Whether the cell of the curve, next to this end of it, is shown in this way not to meet the surface's cell.
bool leaves_border(const CurveCells::Cell& curve, const CurveCells::End& end, const SurfaceCells::Cell& cell,
                   const Surface& surface);

}  // namespace lekalo::geometry
