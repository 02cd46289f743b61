// Piecewise polynomials of two variables as exact patches over the cells of a planar triangulation.
#pragma once

#include "geometry/body.h"
#include "geometry/surfaces/triangles/bezier_triangle.h"
#include "geometry/surfaces/triangles/planar_cells.h"

namespace lekalo::geometry {

// A function on cells, by the net on each.
struct SplineOnCells {
  PlanarCells cells;
  std::vector<TriangularNetOf<double>> nets;
};

struct GraphOptions {
  double scale = 1;    // of the height
  bool walls = true;   // where the function jumps, and at the border down to 0
  bool solid = false;  // with the floor at the height 0 and walls: closed
};

// The graph (u, v, scale f(u, v)) as patches whose triangles have the parameters u, v, sewn to a body; without the
// cells on which f is 0. Throws std::invalid_argument where it is 0 everywhere.
Body graph_of(const SplineOnCells& f, const GraphOptions& options);

// A surface by the homogeneous nets on cells, of degree 1 or more, sewn to a body.
Body surface_on(const PlanarCells& cells, const std::vector<TriangularNet>& nets);

}  // namespace lekalo::geometry
