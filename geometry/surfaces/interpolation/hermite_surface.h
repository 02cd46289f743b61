// Bicubic surfaces of class C^1 with given derivatives at the nodes of a grid (Golovanov 2016, 3.6; Zavyalov et al.
// 1985, I.5, II.4).
#pragma once

#include "geometry/surfaces/interpolation/point_grid.h"

namespace lekalo::geometry {

// Derivatives at the nodes, each in the shape of the grid's points.
struct NodeDerivatives {
  Grid<Vec3> u, v, uv;
};

NurbsSurface hermite_surface(const PointGrid& grid, const NodeDerivatives& d);

}  // namespace lekalo::geometry
