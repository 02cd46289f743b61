// Diameters of the cells of a surface, and what follows from them (Zavyalov, Leus, Skorospelov 1985, II.2).
//
// The domain is cut into cells by evenly spaced parameter lines. Two points of a cell are joined on the surface by a
// path along u and one along v: the cell's intrinsic diameter is at most |r_u| du + |r_v| dv with the largest speeds in
// it. Cells that follow one another have at most the sum of theirs, and so has the surface: chains of n cells join all
// of it, D <= n d. A line at a distance of at least (n + 1) d from one node misses the surface.
#pragma once

#include "geometry/surface.h"

namespace lekalo::geometry {

struct CellDiameters {
  double largest = 0;  // d: no cell's diameter is larger, proven
  int chain = 0;       // n
  double bound() const { return chain * largest; }
};
// At least one cell each way, a bounded surface; throws std::invalid_argument.
CellDiameters cell_diameters(const Surface& surface, int cells_u, int cells_v);

// The distance from a line of the node (corner of cells) that is farthest from it.
double farthest_node(const Surface& surface, int cells_u, int cells_v, const Line& line);

// Whether the diameters alone prove that the line misses the surface; false proves nothing.
inline bool surely_misses(const CellDiameters& cells, double node_distance) {
  return node_distance >= (cells.chain + 1) * cells.largest;
}

}  // namespace lekalo::geometry
