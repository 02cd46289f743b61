// Edges of a tube whose curve bends more than its radius allows: there the wall has cuspidal edges, a swallowtail of
// which the tube's boundary keeps one edge, on the inner side of the bend. It ends at two points inside of the
// boundary, where it fades.
//
// A point p is on such an edge if two balls, at s - d and s + d, touch it from inside: f(t) = |p - c(t)|^2 - R(t)^2 is
// zero and stationary at both. With D = d^2, and for any function h of t
//
//   A0 = (h(s+d) + h(s-d))/2,   A1 = (h(s+d) - h(s-d))/(2 d),   B0, B1, C0, C1 their first and second derivatives by D,
//
// all of them power series in D, this says A0 f = A1 f = B0 f = B1 f = 0. At D = 0 it says that f and its first three
// derivatives vanish: the edge ends there, but the curve of solutions is regular and merely leaves the domain D >= 0.
// With q = p - A0 c the equations are
//
//   |q|^2 + D |A1 c|^2 = A0 R^2,                      q . A1 c = -A1 R^2/2,
//   q . B0 c = |A1 c|^2/2 + D A1 c . B1 c - B0 R^2/2,   q . B1 c = A1 c . B0 c - B1 R^2/2.
//
// The second and third give q but for a multiple z of the unit vector along A1 c x B0 c: two equations are left in the
// unknowns s, D, z. c and R^2 are one polynomial over the bend that agrees with them to rounding.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "geometry/shapes/tube/ball_sweep.h"

namespace lekalo::geometry {

struct BendEdge {
  CurvePtr curve;                     // in space
  std::function<Vec2(double)> balls;  // by the same parameter: the two t
};
struct BendEdges {
  std::vector<BendEdge> edges;
  bool complete = true;
};
// All points that two balls of a range touch so, whether or not others hold them; a closed curve's range may go on
// beyond the end of its domain. Nothing where one polynomial is not enough.
std::optional<BendEdges> bend_edges(const BallSweep& sweep, const Interval& range);

}  // namespace lekalo::geometry
