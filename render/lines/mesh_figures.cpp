#include "render/lines/mesh_figures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/tessellation/planar_triangulations.h"

namespace lekalo::render {

using namespace geometry;

namespace {

struct Circumcircle {
  Vec3 center, normal;
  double radius;
};

// Of a triangle a, b, c in space: with p = b - a, q = c - a, n = p x q its center is a + (q^2 (n x p) - p^2 (n x q)) /
// 2 n^2, from (o - a) . p = p^2 / 2 and (o - a) . q = q^2 / 2.
std::optional<Circumcircle> circumcircle(const Mesh& mesh, const Mesh::Triangle& t) {
  const Vec3 &a = mesh.points[t.point[0]], p = mesh.points[t.point[1]] - a, q = mesh.points[t.point[2]] - a;
  const Vec3 n = glm::cross(p, q);
  const double square = glm::dot(n, n);
  if (!(square > 0)) return std::nullopt;
  const Vec3 to_center = (glm::dot(p, p) * glm::cross(q, n) + glm::dot(q, q) * glm::cross(n, p)) / (2 * square);
  return Circumcircle{a + to_center, n / std::sqrt(square), glm::length(to_center)};
}

MeshFigure circumcircles(const Mesh& mesh, const Fields& f) {
  MeshFigure figure;
  const std::vector<double>* only = f.has("of") ? &f.numbers("of") : nullptr;
  const auto is_shown = [&](size_t number) {
    return !only || std::find(only->begin(), only->end(), static_cast<double>(number)) != only->end();
  };
  for (size_t k = 0; k < mesh.triangles.size(); ++k) {
    const auto circle = is_shown(k) ? circumcircle(mesh, mesh.triangles[k]) : std::nullopt;
    if (!circle) continue;
    figure.lines.push_back(std::make_shared<Circle>(frame_about(circle->center, circle->normal), circle->radius));
    figure.points.push_back(circle->center);
  }
  return figure;
}

// Borders of Voronoi's cells: the centers of the circles of neighbours are joined; from those at the hull a line goes
// out across it, as far as the helper says. Right for triangulations by Delaunay's condition.
MeshFigure voronoi(const Mesh& mesh, const Fields& f) {
  const double reach = f.has("reach") ? f.number("reach") : 0.5 * bounds(mesh).diameter();
  MeshFigure figure;
  std::map<std::pair<int, int>, std::vector<size_t>> beside;  // the triangles of a side
  std::vector<std::optional<Circumcircle>> circles;
  for (size_t k = 0; k < mesh.triangles.size(); ++k) {
    circles.push_back(circumcircle(mesh, mesh.triangles[k]));
    for (size_t i = 0; i < 3; ++i)
      beside[std::minmax(mesh.triangles[k].point[i], mesh.triangles[k].point[(i + 1) % 3])].push_back(k);
  }
  const auto add = [&](const Vec3& a, const Vec3& b) {
    if (glm::length(b - a) > 1e-9 * reach) figure.lines.push_back(std::make_shared<Segment>(a, b));
  };
  for (const auto& [side, triangles] : beside) {
    const auto& first = circles[triangles[0]];
    if (!first) continue;
    if (triangles.size() == 2 && circles[triangles[1]]) add(first->center, circles[triangles[1]]->center);
    if (triangles.size() > 1) continue;
    // Out of the hull: to the right of the side as the triangle runs.
    const Mesh::Triangle& t = mesh.triangles[triangles[0]];
    size_t i = 0;
    while (std::pair<int, int>(std::minmax(t.point[i], t.point[(i + 1) % 3])) != side) ++i;
    const Vec3 along = mesh.points[t.point[(i + 1) % 3]] - mesh.points[t.point[i]];
    add(first->center, first->center + reach * glm::normalize(glm::cross(along, first->normal)));
  }
  for (const auto& circle : circles)
    if (circle) figure.points.push_back(circle->center);
  return figure;
}

MeshFigure first_greedy_edges(const Mesh& mesh, const Fields& f) {
  MeshFigure figure;
  std::vector<Vec2> points;
  for (const Vec3& p : mesh.points) points.emplace_back(p);
  std::vector<std::pair<int, int>> edges = greedy_edges(points);
  if (f.has("steps")) edges.resize(std::min(edges.size(), static_cast<size_t>(f.integer("steps"))));
  for (const auto& [a, b] : edges) figure.lines.push_back(std::make_shared<Segment>(mesh.points[a], mesh.points[b]));
  figure.points = mesh.points;
  return figure;
}

}  // namespace

bool is_mesh_figure(const std::string& helper) {
  return helper == "circumcircles" || helper == "voronoi" || helper == "greedy_edges";
}

MeshFigure mesh_figure(const Mesh& mesh, const Helper& helper) {
  if (helper.type == "greedy_edges") return first_greedy_edges(mesh, helper.values);
  return helper.type == "voronoi" ? voronoi(mesh, helper.values) : circumcircles(mesh, helper.values);
}

}  // namespace lekalo::render
