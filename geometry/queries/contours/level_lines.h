// Where any function of a surface's parameters has a value: lines as polygons in the parameter plane, for drawings.
#pragma once

#include <functional>
#include <vector>

#include "geometry/surface.h"

namespace lekalo::geometry {

// Not finite where it has no value; there are no lines there.
using FunctionOnSurface = std::function<double(double u, double v)>;

struct LevelLine {
  std::vector<Vec2> places;  // u, v; at least two
  bool closed = false;       // and goes back from the last to the first
};

// Followed over a grid of cells, at least 64 a side, whose borders are those of the surface's smooth pieces too; what
// is smaller than a cell may be missed. The function has the value at the polygon's corners to its rounding, and the
// middles of its sides lie within about 1e-4 of the surface's size of the line. Throws std::invalid_argument for an
// unbounded surface.
std::vector<LevelLine> level_lines(const Surface& surface, const FunctionOnSurface& function, double level);

}  // namespace lekalo::geometry
