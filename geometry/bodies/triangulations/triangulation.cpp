#include "geometry/bodies/triangulations/triangulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/bodies/triangulations/flattening.h"
#include "geometry/composition.h"
#include "geometry/mesh.h"
#include "geometry/surfaces/triangles/parameter_triangle.h"
#include "geometry/surfaces/triangles/planar_cells.h"
#include "geometry/tessellation/cloud_triangulation.h"

namespace lekalo::geometry {

namespace {

std::vector<std::array<int, 3>> given_triangles(const Fields& f, size_t count) {
  std::vector<std::array<int, 3>> result;
  const std::vector<std::vector<int>>& rows = f.indices("triangles");
  for (size_t k = 0; k < rows.size(); ++k) {
    if (rows[k].size() != 3)
      throw FieldError("triangles", fmt::format("triangle {} has {} corners", k, rows[k].size()));
    for (const int corner : rows[k])
      if (corner < 0 || corner >= static_cast<int>(count))
        throw FieldError("triangles", fmt::format("triangle {} names point {}; there are points 0 to {}", k, corner,
                                                  static_cast<int>(count) - 1));
    result.push_back({rows[k][0], rows[k][1], rows[k][2]});
  }
  return result;
}

// Delaunay's of the parameters, but for triangles with a longer side in space.
std::vector<std::array<int, 3>> delaunay_triangles(const Fields& f, const std::vector<Vec3>& points,
                                                   const std::vector<Vec2>& uv) {
  const double longest = f.has("longest") ? f.number("longest") : kInfinity;
  std::vector<std::array<int, 3>> result;
  for (const IndexTriangle& t : delaunay(uv)) {
    double length = 0;
    for (size_t k = 0; k < 3; ++k)
      length = std::max(length,
                        glm::length(points[static_cast<size_t>(t[k])] - points[static_cast<size_t>(t[(k + 1) % 3])]));
    if (length <= longest) result.push_back(t);
  }
  if (result.empty())
    throw FieldError("points", "they make no triangle",
                     f.has("longest") ? "a larger 'longest'" : "all lie on one line");
  return result;
}

void check_sides(const std::vector<std::array<int, 3>>& triangles) {
  std::map<std::pair<int, int>, size_t> used;
  for (size_t k = 0; k < triangles.size(); ++k)
    for (size_t i = 0; i < 3; ++i) {
      const int a = triangles[k][i], b = triangles[k][(i + 1) % 3];
      if (a == b) throw FieldError("triangles", fmt::format("triangle {} names point {} twice", k, a));
      const auto [found, is_new] = used.try_emplace({a, b}, k);
      if (!is_new)
        throw FieldError("triangles",
                         fmt::format("triangles {} and {} both have the side from {} to {}", found->second, k, a, b),
                         "neighbours run along a common side in opposite directions, and two share it at most");
    }
}

void set_parameters(SpatialTriangulation& result, const std::vector<Vec2>& uv) {
  double orientation = 0;
  for (size_t k = 0; k < result.triangles.size(); ++k) {
    std::array<Vec2, 3> corners;
    for (size_t i = 0; i < 3; ++i) corners[i] = uv[static_cast<size_t>(result.triangles[k][i])];
    const double turn = homogeneous_determinant(corners[0], corners[1], corners[2]);
    if (turn == 0 || turn * orientation < 0)
      throw FieldError("parameters", fmt::format("triangle {} is {} in the plane of parameters", k,
                                                 turn == 0 ? "a line" : "turned over"));
    orientation = turn;
    result.parameters.push_back(corners);
  }
}

// Without common parameters: side by side.
void set_own_parameters(SpatialTriangulation& result) {
  result.is_parametrized = false;
  for (size_t k = 0; k < result.triangles.size(); ++k) {
    const double x = 2.0 * static_cast<double>(k);
    result.parameters.push_back({Vec2(x + 1, 0), Vec2(x, 1), Vec2(x, 0)});
  }
}

void set_given_normals(SpatialTriangulation& result, const std::vector<Vec3>& normals) {
  if (normals.size() != result.points.size())
    throw FieldError("normals", fmt::format("{} points need {} normals, not {}", result.points.size(),
                                            result.points.size(), normals.size()));
  for (size_t k = 0; k < normals.size(); ++k) {
    if (glm::length(normals[k]) == 0) throw FieldError("normals", fmt::format("normal {} is zero", k));
    result.normals.push_back(glm::normalize(normals[k]));
  }
}

// The derivatives of the plane orthogonal to the normal that fits the neighbours of each point best.
void estimate_derivatives(SpatialTriangulation& t) {
  struct Sums {
    double uu = 0, uv = 0, vv = 0;
    Vec3 u{0}, v{0};
  };
  std::vector<Sums> sums(t.points.size());
  for (size_t k = 0; k < t.triangles.size(); ++k)
    for (size_t i = 0; i < 3; ++i)
      for (size_t j = 1; j < 3; ++j) {
        const auto here = static_cast<size_t>(t.triangles[k][i]),
                   there = static_cast<size_t>(t.triangles[k][(i + j) % 3]);
        const Vec2 d = t.parameters[k][(i + j) % 3] - t.parameters[k][i];
        Vec3 r = t.points[there] - t.points[here];
        r -= glm::dot(t.normals[here], r) * t.normals[here];
        // Near neighbours count more.
        const double w = 1 / glm::dot(d, d);
        Sums& s = sums[here];
        s.uu += w * d.x * d.x, s.uv += w * d.x * d.y, s.vv += w * d.y * d.y;
        s.u += w * d.x * r, s.v += w * d.y * r;
      }
  for (const Sums& s : sums) {
    const double determinant = s.uu * s.vv - s.uv * s.uv;
    t.du.push_back(determinant > 0 ? (s.vv * s.u - s.uv * s.v) / determinant : Vec3(0));
    t.dv.push_back(determinant > 0 ? (s.uu * s.v - s.uv * s.u) / determinant : Vec3(0));
  }
}

}  // namespace

void set_mean_normals(SpatialTriangulation& t) {
  Mesh mesh;
  mesh.points = t.points;
  for (const std::array<int, 3>& triangle : t.triangles)
    mesh.triangles.push_back({{triangle[0], triangle[1], triangle[2]}});
  set_smooth_normals(mesh);
  t.normals.assign(t.points.size(), Vec3(0));
  for (const Mesh::Triangle& triangle : mesh.triangles)
    for (size_t i = 0; i < 3; ++i)
      t.normals[static_cast<size_t>(triangle.point[i])] = mesh.normals[static_cast<size_t>(triangle.normal[i])];
}

// Of points as they lie in space.
static SpatialTriangulation triangulation_of_neighbours(const Fields& f) {
  for (const char* field : {"triangles", "parameters"})
    if (f.has(field)) throw FieldError(field, "the neighbours in space are joined", "leave it out, or 'joined_by'");
  SpatialTriangulation result;
  result.points = f.points("points");
  CloudOptions options;
  if (f.has("longest")) options.longest = f.number("longest");
  options.largest_hole = f.integer("largest_hole");
  std::vector<Vec2> uv;
  try {
    result.triangles = triangulation_of_cloud(result.points, options);
    if (f.boolean("flattened")) uv = flattened_to_circle(result.points, result.triangles);
  } catch (const std::invalid_argument& error) {
    throw FieldError("points", error.what(), "more points, or 'triangles'");
  }
  if (uv.empty())
    set_own_parameters(result);
  else
    set_parameters(result, uv);
  return result;
}

static SpatialTriangulation triangulation_over_plane(const Fields& f) {
  for (const char* field : {"largest_hole", "flattened"})
    if (f.given(field))
      throw FieldError(field, "it belongs to points that are joined as they lie in space", "joined_by: neighbours");
  SpatialTriangulation result;
  result.points = f.points("points");
  const bool has_parameters = f.has("parameters");
  std::vector<Vec2> uv = plane_points(has_parameters ? f.points("parameters") : result.points);
  if (uv.size() != result.points.size())
    throw FieldError("parameters", fmt::format("{} points need {} pairs, not {}", result.points.size(),
                                               result.points.size(), uv.size()));
  const bool is_given = f.has("triangles");
  if (is_given && f.has("longest")) throw FieldError("longest", "the triangles are given", "leave it out");
  result.triangles = is_given ? given_triangles(f, result.points.size()) : delaunay_triangles(f, result.points, uv);
  check_sides(result.triangles);
  if (is_given && !has_parameters)
    set_own_parameters(result);
  else
    set_parameters(result, uv);
  return result;
}

SpatialTriangulation triangulation_of_points(const Fields& f) {
  SpatialTriangulation result =
      f.text("joined_by") == "neighbours" ? triangulation_of_neighbours(f) : triangulation_over_plane(f);
  if (f.has("normals"))
    set_given_normals(result, f.points("normals"));
  else
    set_mean_normals(result);
  if (result.is_parametrized) estimate_derivatives(result);
  return result;
}

SpatialTriangulation triangulation_of_surface(const Surface& surface, int cells_u, int cells_v) {
  const Rectangle domain = surface.domain();
  const DegenerateEdges edges = surface.degenerate_edges();
  const bool closed_u = is_closed_along(surface, Along::u), closed_v = is_closed_along(surface, Along::v);
  const int rows = closed_u ? cells_u : cells_u + 1, columns = closed_v ? cells_v : cells_v + 1;
  SpatialTriangulation result;
  const auto at = [&](int i, int j) {
    return Vec2(domain.u.clamp(domain.u.lo + domain.u.width() * i / cells_u),
                domain.v.clamp(domain.v.lo + domain.v.width() * j / cells_v));
  };
  const auto add = [&](const Vec2& uv) {
    const SurfaceJet jet = surface.evaluate(uv.x, uv.y, 1);
    result.points.push_back(jet.point());
    result.normals.push_back(surface.normal(uv.x, uv.y));
    result.du.push_back(jet.du()), result.dv.push_back(jet.dv());
    return static_cast<int>(result.points.size()) - 1;
  };
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) add(at(i, j));
  std::map<int, int> poles;
  const auto vertex = [&](int i, int j) {
    const int pole = edges.u_min && i == 0         ? 0
                     : edges.u_max && i == cells_u ? 1
                     : edges.v_min && j == 0       ? 2
                     : edges.v_max && j == cells_v ? 3
                                                   : -1;
    if (pole < 0) return (i % rows) * columns + j % columns;
    const auto [found, is_new] = poles.try_emplace(pole, 0);
    if (is_new) found->second = add(at(i, j));
    return found->second;
  };
  const auto add_triangle = [&](const std::array<std::pair<int, int>, 3>& corners) {
    std::array<int, 3> triangle;
    std::array<Vec2, 3> uv;
    for (size_t k = 0; k < 3; ++k) {
      triangle[k] = vertex(corners[k].first, corners[k].second);
      uv[k] = at(corners[k].first, corners[k].second);
    }
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) return;
    result.triangles.push_back(triangle);
    result.parameters.push_back(uv);
  };
  for (int i = 0; i < cells_u; ++i)
    for (int j = 0; j < cells_v; ++j) {
      add_triangle({{{i, j}, {i + 1, j}, {i + 1, j + 1}}});
      add_triangle({{{i, j}, {i + 1, j + 1}, {i, j + 1}}});
    }
  return result;
}

}  // namespace lekalo::geometry
