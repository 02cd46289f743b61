#include "render/lines/control_mesh.h"

#include <algorithm>

#include "geometry/surfaces/splines/t_spline.h"
#include "geometry/surfaces/triangles/bezier_triangle.h"
#include "geometry/transformed.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// Points in rows of a grid; a periodic direction repeats its first points, as many as the degree.
ControlMesh mesh_of(const NurbsSurfaceForm& form, const Periods& periods) {
  const bool closed_u = periods.u > 0, closed_v = periods.v > 0;
  const int rows = form.count_u() - (closed_u ? form.degree_u : 0),
            columns = form.count_v() - (closed_v ? form.degree_v : 0);
  ControlMesh mesh;
  std::vector<ControlMesh::Line> along_v(rows), along_u(columns);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const Vec4& p = form.points[static_cast<size_t>(i) * form.count_v() + j];
      if (p.w == 0) continue;
      const int index = static_cast<int>(mesh.points.size());
      along_v[i].points.push_back(index);
      along_u[j].points.push_back(index);
      const bool is_corner = (i == 0 || i + 1 == rows) && (j == 0 || j + 1 == columns);
      mesh.points.push_back({Vec3(p) / p.w, {static_cast<double>(i), static_cast<double>(j)}, is_corner});
    }
  for (ControlMesh::Line& line : along_v) mesh.lines.push_back({std::move(line.points), closed_v});
  for (ControlMesh::Line& line : along_u) mesh.lines.push_back({std::move(line.points), closed_u});
  return mesh;
}

// Rows of equal i, then j, then k.
ControlMesh mesh_of(const TriangularNet& net) {
  const int n = net.degree;
  ControlMesh mesh;
  each_index(n, [&](int i, int j, int k) {
    const Vec4& p = net.at(i, j);
    mesh.points.push_back({Vec3(p) / p.w,
                           {static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)},
                           i == n || j == n || k == n});
  });
  for (int row = 0; row < n; ++row) {
    ControlMesh::Line lines[3];
    for (int m = 0; m <= n - row; ++m) {
      lines[0].points.push_back(net.index(row, m));
      lines[1].points.push_back(net.index(m, row));
      lines[2].points.push_back(net.index(m, n - row - m));
    }
    for (ControlMesh::Line& line : lines) mesh.lines.push_back(std::move(line));
  }
  return mesh;
}

// Points of a T-spline, joined as in its mesh.
ControlMesh mesh_of(const TSpline& spline, const std::vector<Vec3>& points) {
  ControlMesh mesh;
  for (size_t i = 0; i < points.size(); ++i) mesh.points.push_back({points[i], {static_cast<double>(i)}, true});
  for (const auto& [a, b] : spline.edges()) mesh.lines.push_back({{a, b}, false});
  return mesh;
}

}  // namespace

std::optional<ControlMesh> control_mesh(const Surface& surface) {
  if (const auto [spline, map] = placed<TSpline>(surface); spline) {
    std::vector<Vec3> points;
    for (const Vec3& p : spline->points()) points.push_back(map.point(p));
    return mesh_of(*spline, points);
  }
  if (const auto net = triangular_net(surface)) return mesh_of(*net);
  if (const auto form = surface.as_nurbs()) return mesh_of(*form, surface.periods());
  return std::nullopt;
}

std::optional<ControlMesh> shown_mesh(const Surface& surface, const Helper& helper) {
  if (helper.type == "control_net") return control_mesh(surface);
  const TSpline* spline = placed<TSpline>(surface).surface;
  if (helper.type != "t_mesh" || is_mesh_on_surface(helper) || !spline) return std::nullopt;
  std::vector<Vec3> places;
  for (size_t i = 0; i < spline->points().size(); ++i) places.emplace_back(spline->place(static_cast<int>(i)), 0);
  ControlMesh mesh = mesh_of(*spline, places);
  // Lines over the seam end beyond it.
  for (size_t k = 0; k < mesh.lines.size(); ++k) {
    const Vec2 end = spline->end_of(spline->edges()[k]);
    if (end == spline->place(spline->edges()[k][1])) continue;
    mesh.lines[k].points[1] = static_cast<int>(mesh.points.size());
    mesh.points.push_back({Vec3(end, 0), {static_cast<double>(spline->edges()[k][1])}, true});
  }
  return mesh;
}

bool is_mesh_on_surface(const Helper& helper) {
  return helper.type == "t_mesh" && helper.values.text("where") == "surface";
}

}  // namespace lekalo::render
