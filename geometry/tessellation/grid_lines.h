// Grids over a surface's parameter plane whose cells keep a tolerance (Golovanov 2016, 8.7).
#pragma once

#include <vector>

#include "geometry/surface.h"
#include "geometry/tessellation/density.h"
#include "geometry/tessellation/tessellate.h"

namespace lekalo::geometry {

// Points and normals of a surface at the crossings of its grid lines. A line across which the normal jumps stands
// twice, so that the cells on either side have their own normals; the cells between its two copies have no width.
struct SurfaceGrid {
  std::vector<double> u;
  std::vector<double> v;
  std::vector<Vec3> points;   // node (i, j) at i * v.size() + j
  std::vector<Vec3> normals;  // of the surface, its `reversed` counted in
  // Cell (i, j) at i * (v.size() - 1) + j: true where the diagonal from (i + 1, j) to (i, j + 1) lies nearer to the
  // surface than the one from (i, j) to (i + 1, j + 1).
  std::vector<char> other_diagonal;
  // True where the surface breaks within the cell, so that it may deviate; empty where it does nowhere.
  std::vector<char> broken;

  int columns() const { return static_cast<int>(u.size()) - 1; }
  int rows() const { return static_cast<int>(v.size()) - 1; }
  size_t node(int i, int j) const { return static_cast<size_t>(i) * v.size() + j; }
  size_t cell(int i, int j) const { return static_cast<size_t>(i) * (v.size() - 1) + j; }
  bool is_empty_cell(int i, int j) const { return u[i] == u[i + 1] || v[j] == v[j + 1]; }
  bool is_broken(int i, int j) const { return !broken.empty() && broken[cell(i, j)]; }
  // All nodes of the row v[j] (the column u[i]) are one point.
  bool row_is_point(int j) const;
  bool column_is_point(int i) const;
};

// The grid over a bounded rectangle whose cells, each split along its better diagonal, deviate from the surface by at
// most the sag and turn its normal along a side by at most the angle: measured in the middle of every side and cell,
// and made denser until they do, but for broken cells (breaks.h). Throws std::invalid_argument when that would take
// more than kMaxTriangles.
SurfaceGrid make_grid(const Surface& surface, const Rectangle& box, const TessellationTolerance& tolerance);

// The grid on given lines, increasing, each at most twice; the tolerance decides diagonals only.
SurfaceGrid grid_on(const Surface& surface, std::vector<double> u, std::vector<double> v,
                    const TessellationTolerance& tolerance);

inline constexpr double kMaxTriangles = 6.4e7;
// Throws std::invalid_argument for a mesh that would need so many.
[[noreturn]] void refuse_mesh(double triangles);

// Parameters of one direction where the surface's smooth pieces meet inside the range, shifted by whole periods.
std::vector<double> joints(const Surface& surface, const Rectangle& box, bool along_u);

}  // namespace lekalo::geometry
