// A way from side to side of a band that is closed in the other direction, between loops that stand in it: where a
// cylinder of parameters with holes can be cut open.
//
// The band is cut into rows; a row's gaps are the rectangles that certainly no loop enters, gaps of neighbouring rows
// are joined where they overlap. The shortest way through them (Dijkstra 1959) is stretched in the corridor of its
// rectangles, which holds it clear of all loops and of itself. Rows are made finer until there is a way.
#pragma once

#include <vector>

#include "geometry/numerics/interval.h"
#include "geometry/vectors.h"

namespace lekalo::geometry {

// A part of a loop: it lies within `bulge` of the segment from a to b.
struct LoopSide {
  Vec2 a, b;
  double bulge;
};

// The band between two lines y = const, closed in x.
struct ClosedBand {
  double period;  // in x
  Interval y;
  bool closed_y;  // also closed in y: a torus that is cut open already where y begins
};

// A polyline from y.lo to y.hi that meets no loop, neither itself nor its copies by whole periods; in a torus both of
// its ends have one x. Loops are closed chains of sides, may stand anywhere in x, and lie within y. Empty if there is
// no way, or none but through gaps narrower than the finest rows and the bulges.
std::vector<Vec2> seam_path(const std::vector<std::vector<LoopSide>>& loops, const ClosedBand& band);

// The whole periods between a point and the strip from a seam (from y.lo to y.hi) to its first copy: it lies in the
// strip if moved by as many periods back.
double periods_from_seam(const Vec2& p, const std::vector<Vec2>& seam, double period);

}  // namespace lekalo::geometry
