// Triangles for shapes that only answer along lines (CSG, implicit surfaces), so that a bare Embree loop can be raced
// against them.
#pragma once

#include "geometry/mesh.h"
#include "geometry/shape.h"

namespace lekalo::benchmarks {

// The surface of a closed bounded shape by marching tetrahedra on a grid of `steps` cubes along the box's longest side:
// vertices are hits of the grid's edges, so they lie on the surface; parts thinner than a cube may be lost.
geometry::Mesh marching_mesh(const geometry::Shape& shape, int steps);

}  // namespace lekalo::benchmarks
