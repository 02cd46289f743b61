// The constants by their closed forms: seven points with y = (6 -+ sqrt(15))/21, w = (155 -+ sqrt(15))/1200; six with
// y = (8 - sqrt(10) -+ sqrt(38 - 44 sqrt(2/5)))/18, w = (620 -+ sqrt(213125 - 53320 sqrt(10)))/3720. (Printed tables
// give the six points those of the seven.)
#include "geometry/queries/measures/triangle_cubature.h"

#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "geometry/tessellation/tessellate.h"

namespace lekalo::geometry {

namespace {

using Rule = std::vector<CubaturePoint>;

void add_orbit(Rule& rule, double y, double weight) {
  const double x = 1 - 2 * y;
  rule.insert(rule.end(), {{x, y, y, weight}, {y, x, y, weight}, {y, y, x, weight}});
}

Rule make_rule(int points) {
  Rule rule;
  const double third = 1.0 / 3;
  if (points == 1) rule = {{third, third, third, 1}};
  if (points == 3) add_orbit(rule, 1.0 / 6, third);
  if (points == 4) {
    rule = {{third, third, third, -0.5625}};
    add_orbit(rule, 0.2, 25.0 / 48);
  }
  if (points == 6) {
    const double root = std::sqrt(38 - 44 * std::sqrt(0.4)), spread = std::sqrt(213125 - 53320 * std::sqrt(10.0));
    add_orbit(rule, (8 - std::sqrt(10.0) - root) / 18, (620 - spread) / 3720);
    add_orbit(rule, (8 - std::sqrt(10.0) + root) / 18, (620 + spread) / 3720);
  }
  if (points == 7) {
    const double root = std::sqrt(15.0);
    rule = {{third, third, third, 0.225}};
    add_orbit(rule, (6 - root) / 21, (155 - root) / 1200);
    add_orbit(rule, (6 + root) / 21, (155 + root) / 1200);
  }
  return rule;
}

TessellationTolerance by_angle(double angle) {
  TessellationTolerance tolerance;
  tolerance.sag = kInfinity;
  tolerance.angle = angle;
  return tolerance;
}

using Corners = std::array<Vec2, 3>;

// The triangle's cell of the parameter plane. At a pole, where a mesh has one triangle between two parameter lines, the
// cell is all that lies between them: two triangles.
std::vector<Corners> cells_of(const Surface& surface, const Corners& triangle) {
  const Rectangle d = surface.domain();
  const DegenerateEdges degenerate = surface.degenerate_edges();
  const struct {
    bool is_pole;
    int axis;
    double at;
  } edges[4] = {{degenerate.u_min, 0, d.u.lo},
                {degenerate.u_max, 0, d.u.hi},
                {degenerate.v_min, 1, d.v.lo},
                {degenerate.v_max, 1, d.v.hi}};
  for (const auto& edge : edges) {
    if (!edge.is_pole) continue;
    for (int k = 0; k < 3; ++k) {
      const Vec2 p = triangle[(k + 1) % 3], q = triangle[(k + 2) % 3];
      if (triangle[k][edge.axis] != edge.at || p[edge.axis] == edge.at || q[edge.axis] == edge.at) continue;
      Vec2 below_p = p, below_q = q;
      below_p[edge.axis] = below_q[edge.axis] = edge.at;
      return {{p, q, below_q}, {p, below_q, below_p}};
    }
  }
  return {triangle};
}

void add_cell(const Corners& cell, const Surface& surface, double side, int points, const Vec3& origin,
              CellMeasures& sum) {
  const Vec2 ab = cell[1] - cell[0], ac = cell[2] - cell[0];
  const double size = 0.5 * std::abs(ab.x * ac.y - ab.y * ac.x);
  ++sum.cells;
  for (const CubaturePoint& p : triangle_rule(points)) {
    const Vec2 uv = p.a * cell[0] + p.b * cell[1] + p.c * cell[2];
    const SurfaceJet s = surface.evaluate(uv.x, uv.y, 1);
    const Vec3 normal = glm::cross(s.du(), s.dv());
    sum.area += size * p.weight * glm::length(normal);
    sum.volume += size * p.weight * side * glm::dot(s.point() - origin, normal) / 3;
  }
}

// What the triangles of a mesh with parameters cover, each on its surface.
template <class SurfaceOf>
CellMeasures sum_over(const Mesh& mesh, int points, const Vec3& origin, SurfaceOf surface_of) {
  CellMeasures result;
  for (const Mesh::Triangle& triangle : mesh.triangles) {
    const auto [surface, side] = surface_of(triangle.face);
    Corners triangle_in_plane;
    for (int k = 0; k < 3; ++k) triangle_in_plane[k] = mesh.parameters[triangle.parameter[k]];
    for (const Corners& cell : cells_of(*surface, triangle_in_plane))
      add_cell(cell, *surface, side, points, origin, result);
  }
  return result;
}

}  // namespace

std::span<const CubaturePoint> triangle_rule(int points) {
  static const std::array<Rule, 8> rules = [] {
    std::array<Rule, 8> all;
    for (int k = 1; k < 8; ++k) all[k] = make_rule(k);
    return all;
  }();
  if (points < 1 || points > 7 || rules[points].empty())
    throw std::invalid_argument("rules for triangles have 1, 3, 4, 6 or 7 points");
  return rules[points];
}

CellMeasures measure_on_triangles(const Surface& surface, int points, double angle) {
  const Mesh mesh = tessellate(surface, by_angle(angle));
  return sum_over(mesh, points, Vec3(0), [&](int) { return std::pair(&surface, 0.0); });
}

CellMeasures measure_on_triangles(const Body& body, int points, double angle) {
  const Mesh mesh = tessellate(body, by_angle(angle));
  return sum_over(mesh, points, bounds(body).center(), [&](int f) {
    const Face& face = body.faces[f];
    const double side = face.forward == (face.surface->normal_sign() > 0) ? 1 : -1;
    return std::pair(face.surface.get(), body.is_closed() ? side : 0.0);
  });
}

}  // namespace lekalo::geometry
