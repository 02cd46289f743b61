// Singular solutions of the equations of contours: where branches cross, surfaces touch, cusps and poles are.
#pragma once

#include "geometry/queries/contours/contour_equations.h"

namespace lekalo::geometry {

// The place near `box`, which the search has left open, where F = 0 and F' loses its rank: l^T F'(x) v = 0 for the left
// null vector l and both right ones v (Patrikalakis, Maekawa 2002, 5.3). By the iteration of Gauss and Newton, of the
// second order as all vanish there. The middle of the box where it leads away. A place nearer to a pole than `near`, a
// length, is moved onto it if neither surface's point goes far by that.
template <int N>
ParameterPoint<N> singular_solution(const ContourEquations<N>& equations, const ParameterBox<N>& box, double near);

}  // namespace lekalo::geometry
