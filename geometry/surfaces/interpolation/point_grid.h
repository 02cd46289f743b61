// Grids of points that a surface is laid through, and the splines of curves used along both directions of one.
#pragma once

#include <functional>

#include "geometry/curves/interpolation/tangent_estimates.h"
#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/surfaces/splines/nurbs_surface.h"

namespace lekalo::geometry {

// A grid with the parameters of its rows (u) and columns (v); a closed direction has one parameter more, where it comes
// back to the first.
struct PointGrid {
  Grid<Vec3> points;
  std::vector<double> at_u, at_v;
  bool closed_u = false, closed_v = false;
};

// The fields points, knots and closed. Steps of a rule are means over all lines of the direction (Golovanov 2016, 3.6).
// Throws FieldError (fields points, knots).
PointGrid read_point_grid(const Fields& fields);
// The same of another field of points, open in both directions.
PointGrid read_open_grid(const Fields& fields, const char* field);
// The fields that it reads.
void declare_point_grid(TypeDeclaration& type);

// The row of a grid along u (at column j), or along v (at row i).
std::vector<Vec3> line_along_u(const Grid<Vec3>& grid, int j);
std::vector<Vec3> line_along_v(const Grid<Vec3>& grid, int i);

// Means over all lines along u, or along v, of the distances between neighbours, the closing one included.
std::vector<double> mean_steps(const Grid<Vec3>& grid, bool along_u, bool closed);

// A polynomial spline of the points of one line, linear in them, with the same axis for all lines.
using LineSpline = std::function<NurbsCurve(std::span<const Vec3>)>;
// The splines along u of all columns, then along v of their control points: a tensor product.
NurbsSurface tensor_surface(const Grid<Vec3>& points, const LineSpline& along_u, const LineSpline& along_v);

}  // namespace lekalo::geometry
