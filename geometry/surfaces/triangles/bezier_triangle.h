// Bezier triangles (Golovanov 2016, 3.11) as exact Bezier surfaces over the square.
#pragma once

#include "geometry/surfaces/splines/nurbs_surface.h"

namespace lekalo::geometry {

// A triangular net in homogeneous coordinates: the points ijk, i + j + k = degree, for i = degree .. 0, for j = degree
// - i .. 0.
struct TriangularNet {
  int degree = 1;
  std::vector<Vec4> points;

  static int count(int degree) { return (degree + 1) * (degree + 2) / 2; }
  int index(int i, int j) const {
    const int row = degree - i;
    return row * (row + 1) / 2 + row - j;
  }
  const Vec4& at(int i, int j) const { return points[index(i, j)]; }
};

// r = sum B_ijk(a, b, c) p_ijk with a = u, b = (1 - u) v, c = (1 - u)(1 - v): the line u = const is the Bezier curve of
// degree n - i of row i. The edge u = 1 is the point n00.
NurbsSurface bezier_triangle(const TriangularNet& net);

// The same surface with a net of one degree more (3.11.8).
TriangularNet elevated(const TriangularNet& net);

}  // namespace lekalo::geometry
