// Whether a cutter cuts into the part anywhere on its way, far from where it touches too: points of the part inside of
// the cutter, looked for at places of the path (Zavyalov, Leus, Skorospelov 1985, V.1).
#pragma once

#include "geometry/machining/tool_path.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// How far a point is inside of the cutter, by its distance from the axis and its height: the distance from end, corner
// and flank; not positive outside.
double depth_inside(const Cutter& cutter, double distance, double height);

// The deepest of some thousand points of the surface, for some hundred places of the cutting moves, and from there the
// nearest local one; depth 0: none. The point of a shank beyond the length is not looked at.
struct DeepestCut {
  double depth = 0, u = 0, v = 0;
};
DeepestCut deepest_cut(const ToolPath& path, const Surface& part);

}  // namespace lekalo::geometry
