// A triangulation of points of space with normals and a synchronous one of the parameter plane (Golovanov 2016, 3.17).
#pragma once

#include "geometry/body.h"
#include "geometry/describe.h"

namespace lekalo::geometry {

struct SpatialTriangulation {
  std::vector<Vec3> points;
  std::vector<Vec3> normals;                    // unit, of the points
  std::vector<std::array<int, 3>> triangles;    // counterclockwise seen from where the normals look
  std::vector<std::array<Vec2, 3>> parameters;  // of the triangles' corners
  bool is_parametrized = true;                  // false: each triangle has parameters of its own
  // Derivatives by the parameters at the points, where they are known.
  std::vector<Vec3> du, dv;
};

// Of a mesh of points: the fields points, triangles, normals, parameters, longest, joined_by, largest_hole, flattened.
// Throws FieldError.
SpatialTriangulation triangulation_of_points(const Fields& fields);

// Of so many cells of a surface's rectangle, each cut by the same diagonal; opposite sides that are one share their
// points, a side that is a point has one. Point i, j of rows along u has the number i (cells of v + 1) + j, or, where v
// is closed, i (cells of v) + j; points at poles come last.
SpatialTriangulation triangulation_of_surface(const Surface& surface, int cells_u, int cells_v);

// Means of the normals of the triangles at each point, weighted by their angles (3.17b).
void set_mean_normals(SpatialTriangulation& triangulation);

}  // namespace lekalo::geometry
