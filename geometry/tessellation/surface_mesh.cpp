// Mesh of a whole surface: its grid, with seams welded and poles gathered into fans (Golovanov 2016, 8.7).
#include <cmath>
#include <stdexcept>

#include "geometry/tessellation/breaks.h"
#include "geometry/tessellation/grid_lines.h"

namespace lekalo::geometry {

namespace {

class SurfaceMesher {
 public:
  SurfaceMesher(const Surface& surface, const SurfaceGrid& grid) : surface_(surface), grid_(grid) {
    for (int i = 0; i <= grid.columns(); ++i) column_is_point_.push_back(grid.column_is_point(i));
    for (int j = 0; j <= grid.rows(); ++j) row_is_point_.push_back(grid.row_is_point(j));
    closed_u_ = joins(true);
    closed_v_ = joins(false);
  }

  Mesh run(const TessellationTolerance& tolerance) {
    name_points();
    mesh_.normals = grid_.normals;
    mesh_.parameters.reserve(grid_.points.size());
    for (double u : grid_.u)
      for (double v : grid_.v) mesh_.parameters.push_back({u, v});
    mesh_.triangles.reserve(2 * static_cast<size_t>(grid_.columns()) * grid_.rows());
    for (int i = 0; i < grid_.columns(); ++i)
      for (int j = 0; j < grid_.rows(); ++j)
        if (!grid_.is_empty_cell(i, j)) add_cell(i, j);
    split_at_breaks(mesh_, {surface_, 1, 0, over_breaks_, {}, poles()}, tolerance);
    return std::move(mesh_);
  }

 private:
  // The first and the last line coincide in space, point by point.
  bool joins(bool along_u) const {
    const int count = along_u ? grid_.rows() : grid_.columns();
    Box3 box;
    for (const Vec3& p : grid_.points) box.include(p);
    const double small = 1e-9 * box.diameter();
    bool any_length = false;
    for (int k = 0; k <= count; ++k) {
      const Vec3& first = grid_.points[along_u ? grid_.node(0, k) : grid_.node(k, 0)];
      const Vec3& last = grid_.points[along_u ? grid_.node(grid_.columns(), k) : grid_.node(k, grid_.rows())];
      if (glm::length(first - last) > small) return false;
      any_length = any_length || first != grid_.points[0];
    }
    // Two poles in one point are no seam.
    return any_length || count == 0;
  }

  // The node that stands for all nodes at the same place.
  size_t representative(int i, int j) const {
    if (i > 0 && grid_.u[i] == grid_.u[i - 1]) --i;
    if (j > 0 && grid_.v[j] == grid_.v[j - 1]) --j;
    if (closed_u_ && i == grid_.columns()) i = 0;
    if (closed_v_ && j == grid_.rows()) j = 0;
    if (row_is_point_[j]) i = 0;
    if (column_is_point_[i]) j = 0;
    return grid_.node(i, j);
  }

  void name_points() {
    index_.resize(grid_.points.size());
    std::vector<int32_t> place(grid_.points.size(), -1);
    for (int i = 0; i <= grid_.columns(); ++i) {
      for (int j = 0; j <= grid_.rows(); ++j) {
        const size_t node = representative(i, j);
        if (place[node] < 0) {
          place[node] = static_cast<int32_t>(mesh_.points.size());
          mesh_.points.push_back(grid_.points[node]);
        }
        index_[grid_.node(i, j)] = place[node];
      }
    }
  }

  void add_cell(int i, int j) {
    pole_ = -1;
    const size_t before = mesh_.triangles.size();
    const std::array<std::array<int, 2>, 4> corner{{{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}};
    if (grid_.other_diagonal[grid_.cell(i, j)]) {
      add_triangle(corner[0], corner[1], corner[3], i, j);
      add_triangle(corner[1], corner[2], corner[3], i, j);
    } else {
      add_triangle(corner[0], corner[1], corner[2], i, j);
      add_triangle(corner[0], corner[2], corner[3], i, j);
    }
    if (!grid_.is_broken(i, j)) return;
    for (size_t k = before; k < mesh_.triangles.size(); ++k) over_breaks_.push_back(static_cast<int>(k));
  }

  // The coordinate that means nothing at each pole.
  std::map<int32_t, int> poles() const {
    std::map<int32_t, int> result;
    for (int i = 0; i <= grid_.columns(); ++i)
      if (column_is_point_[i]) result.emplace(index_[grid_.node(i, 0)], 1);
    for (int j = 0; j <= grid_.rows(); ++j)
      if (row_is_point_[j]) result.emplace(index_[grid_.node(0, j)], 0);
    return result;
  }

  void add_triangle(std::array<int, 2> a, std::array<int, 2> b, std::array<int, 2> c, int i, int j) {
    if (surface_.reversed()) std::swap(b, c);
    Mesh::Triangle triangle;
    const std::array<std::array<int, 2>, 3> corners{a, b, c};
    for (int k = 0; k < 3; ++k) {
      const auto [column, row] = corners[k];
      const size_t node = grid_.node(column, row);
      triangle.point[k] = index_[node];
      triangle.normal[k] = triangle.parameter[k] = static_cast<int32_t>(node);
      if (row_is_point_[row] || column_is_point_[column])
        triangle.normal[k] = triangle.parameter[k] = pole_corner(column, row, i, j);
    }
    const auto& p = triangle.point;
    if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) return;
    mesh_.triangles.push_back(triangle);
  }

  // At a pole every triangle of the fan has a normal of its own: the limit along its middle.
  int32_t pole_corner(int column, int row, int i, int j) {
    Vec2 at{grid_.u[column], grid_.v[row]};
    if (row_is_point_[row]) at.x = 0.5 * (grid_.u[i] + grid_.u[i + 1]);
    if (column_is_point_[column]) at.y = 0.5 * (grid_.v[j] + grid_.v[j + 1]);
    if (pole_ >= 0 && mesh_.parameters[pole_] == at) return pole_;
    pole_ = static_cast<int32_t>(mesh_.parameters.size());
    mesh_.parameters.push_back(at);
    // From the cell's side, where the pole stands on a crease.
    Vec2 inside = at;
    const bool on_crease = (row > 0 && grid_.v[row] == grid_.v[row - 1]) ||
                           (row < grid_.rows() && grid_.v[row] == grid_.v[row + 1]) ||
                           (column > 0 && grid_.u[column] == grid_.u[column - 1]) ||
                           (column < grid_.columns() && grid_.u[column] == grid_.u[column + 1]);
    if (on_crease) {
      const Vec2 middle{0.5 * (grid_.u[i] + grid_.u[i + 1]), 0.5 * (grid_.v[j] + grid_.v[j + 1])};
      inside += 1e-6 * (middle - inside);
    }
    mesh_.normals.push_back(surface_.normal(inside.x, inside.y));
    return pole_;
  }

  const Surface& surface_;
  const SurfaceGrid& grid_;
  Mesh mesh_;
  std::vector<int32_t> index_;  // mesh point of every node
  std::vector<char> row_is_point_, column_is_point_;
  bool closed_u_ = false, closed_v_ = false;
  std::vector<int> over_breaks_;  // triangles of broken cells
  int32_t pole_ = -1;             // normal and parameter of the cell's pole corner
};

}  // namespace

Mesh tessellate(const Surface& surface, const TessellationTolerance& tolerance) {
  if (!surface.bounded()) throw std::invalid_argument("an unbounded surface has no mesh; give it a domain");
  const SurfaceGrid grid = make_grid(surface, surface.domain(), tolerance);
  return SurfaceMesher(surface, grid).run(tolerance);
}

}  // namespace lekalo::geometry
