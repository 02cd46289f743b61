// Bicubic surfaces of class C^1 through a grid of points, with derivatives at its nodes (Ferguson 1964; Golovanov 2016,
// 3.6.1, 3.6.2; Zavyalov et al. 1985, I.5, II.4). On a cell, x = (u - u_i)/h, y = (v - v_j)/l,
//
//   r = F(x)^T M F(y),  F = [1 - 3x^2 + 2x^3, 3x^2 - 2x^3, h (x - 2x^2 + x^3), h (-x^2 + x^3)]
//
// M has the points, the derivatives by u, by v, and by both (twists). As a B-spline surface with double knots it has
// four control points about each node, p + a p_u + b p_v + a b p_uv, a = -h_(i-1)/3 or h_i/3, b likewise.
// Twists where they are not given:
//   tensor   the rule of the tangents used on the derivatives by v: of second order, exact for products of parabolas
//   central  (p_(i+1,j+1) - p_(i+1,j-1) - p_(i-1,j+1) + p_(i-1,j-1))/((u_(i+1) - u_(i-1)) (v_(j+1) - v_(j-1))),
//            indices beyond an open border moved to it
//   zero     flat spots at the nodes
// Where directions or normals are given instead of derivatives (Zavyalov et al. 1985, II.6), a direction that is not is
// that of the circle through three neighbours; with a normal n it is turned into the plane across, t - (t n) n; lengths
// are those of local_speeds.
#include <fmt/format.h>

#include "geometry/surfaces/interpolation/hermite_surface.h"

namespace lekalo::geometry {

namespace {

Grid<Vec3> same_shape(const Grid<Vec3>& grid) { return {grid.rows, grid.columns, grid.values}; }

Grid<Vec3> derivatives_by_u(const std::string& rule, const PointGrid& grid, const Grid<Vec3>& of) {
  Grid<Vec3> result = same_shape(of);
  for (int j = 0; j < of.columns; ++j) {
    const std::vector<Vec3> line = line_along_u(of, j);
    const std::vector<Vec3> tangents = estimated_tangents(rule, {line, grid.at_u, grid.closed_u});
    for (int i = 0; i < of.rows; ++i) result.at(i, j) = tangents[i];
  }
  return result;
}

Grid<Vec3> derivatives_by_v(const std::string& rule, const PointGrid& grid, const Grid<Vec3>& of) {
  Grid<Vec3> result = same_shape(of);
  for (int i = 0; i < of.rows; ++i) {
    const std::vector<Vec3> line = line_along_v(of, i);
    const std::vector<Vec3> tangents = estimated_tangents(rule, {line, grid.at_v, grid.closed_v});
    for (int j = 0; j < of.columns; ++j) result.at(i, j) = tangents[j];
  }
  return result;
}

Vec3 central_twist(const PointGrid& grid, int i, int j) {
  // The node beside, its number in the grid and its parameter.
  const auto beside = [](int k, int by, int count, bool closed, const std::vector<double>& at) {
    const std::vector<Vec3> none(count);
    const PointSequence line{none, at, closed};
    const int other = closed ? k + by : std::clamp(k + by, 0, count - 1);
    return std::pair((other + count) % count, line.parameter(other));
  };
  const int rows = grid.points.rows, columns = grid.points.columns;
  const auto [i0, u0] = beside(i, -1, rows, grid.closed_u, grid.at_u);
  const auto [i1, u1] = beside(i, 1, rows, grid.closed_u, grid.at_u);
  const auto [j0, v0] = beside(j, -1, columns, grid.closed_v, grid.at_v);
  const auto [j1, v1] = beside(j, 1, columns, grid.closed_v, grid.at_v);
  const Grid<Vec3>& p = grid.points;
  return (p.at(i1, j1) - p.at(i1, j0) - p.at(i0, j1) + p.at(i0, j0)) / ((u1 - u0) * (v1 - v0));
}

const Grid<Vec3>& given(const Fields& f, const char* field, const Grid<Vec3>& points) {
  const Grid<Vec3>& net = f.net(field);
  if (net.rows != points.rows || net.columns != points.columns)
    throw FieldError(field, fmt::format("{} x {} points need as many vectors, not {} x {}", points.rows, points.columns,
                                        net.rows, net.columns));
  return net;
}

// Derivatives along one line of points, of given directions and normals; a zero vector is none.
std::vector<Vec3> directed(const PointSequence& line, const std::vector<Vec3>& directions,
                           const std::vector<Vec3>& normals) {
  const std::vector<Vec3> estimated = estimated_tangents("circle", line);
  const std::vector<double> speeds = local_speeds(line);
  std::vector<Vec3> result;
  for (int i = 0; i < line.size(); ++i) {
    const bool has_own = !directions.empty() && directions[i] != Vec3(0);
    Vec3 along = has_own ? directions[i] : estimated[i];
    if (!normals.empty() && normals[i] != Vec3(0)) {
      const Vec3 n = glm::normalize(normals[i]);
      along -= glm::dot(along, n) * n;
    }
    if (!(glm::length(along) > 0))
      throw FieldError("normals", fmt::format("normal ({:.6g}, {:.6g}, {:.6g}) points along the surface", normals[i].x,
                                              normals[i].y, normals[i].z));
    result.push_back(std::abs(speeds[i]) * glm::normalize(along));
  }
  return result;
}

// By u or v: given in full, by directions and normals, or estimated.
Grid<Vec3> derivatives_along(const Fields& f, const PointGrid& grid, bool along_u) {
  const char* tangents = along_u ? "u_tangents" : "v_tangents";
  const char* directions = along_u ? "u_directions" : "v_directions";
  if (f.has(tangents)) {
    if (f.has(directions)) throw FieldError(directions, fmt::format("{} has them already", tangents), "leave one out");
    return given(f, tangents, grid.points);
  }
  if (!f.has(directions) && !f.has("normals"))
    return along_u ? derivatives_by_u(f.text("estimate"), grid, grid.points)
                   : derivatives_by_v(f.text("estimate"), grid, grid.points);
  const auto line_of = [&](const char* field, int k) -> std::vector<Vec3> {
    if (!f.has(field)) return {};
    const Grid<Vec3>& of = given(f, field, grid.points);
    return along_u ? line_along_u(of, k) : line_along_v(of, k);
  };
  Grid<Vec3> result = same_shape(grid.points);
  for (int k = 0; k < (along_u ? result.columns : result.rows); ++k) {
    const std::vector<Vec3> points = along_u ? line_along_u(grid.points, k) : line_along_v(grid.points, k);
    const PointSequence line{points, along_u ? grid.at_u : grid.at_v, along_u ? grid.closed_u : grid.closed_v};
    const std::vector<Vec3> own = directed(line, line_of(directions, k), line_of("normals", k));
    for (size_t i = 0; i < own.size(); ++i)
      (along_u ? result.at(static_cast<int>(i), k) : result.at(k, static_cast<int>(i))) = own[i];
  }
  return result;
}

NodeDerivatives derivatives_of(const Fields& f, const PointGrid& grid) {
  const std::string &rule = f.text("estimate"), &twist = f.text("twist");
  NodeDerivatives d;
  d.u = derivatives_along(f, grid, true);
  d.v = derivatives_along(f, grid, false);
  if (f.has("twists")) {
    d.uv = given(f, "twists", grid.points);
  } else if (twist == "tensor") {
    d.uv = derivatives_by_u(rule, grid, d.v);
  } else {
    d.uv = same_shape(grid.points);
    for (int i = 0; i < d.uv.rows; ++i)
      for (int j = 0; j < d.uv.columns; ++j) d.uv.at(i, j) = twist == "zero" ? Vec3(0) : central_twist(grid, i, j);
  }
  return d;
}

// One direction: the control points' nodes and how far they are from them, and the axis.
struct Controls {
  std::vector<std::pair<int, double>> of;
  SplineAxis axis;
};

Controls controls(int count, const std::vector<double>& at, bool closed) {
  const std::vector<Vec3> none(count);
  const PointSequence line{none, at, closed};
  std::vector<std::pair<int, double>> of;
  for (int i = 0; i < count; ++i) {
    of.emplace_back(i, closed || i > 0 ? -line.step(i - 1) / 3 : 0);
    of.emplace_back(i, closed || i < count - 1 ? line.step(i) / 3 : 0);
  }
  std::vector<double> knots;
  if (closed) {
    for (int i = -1; i <= count + 2; ++i) knots.insert(knots.end(), 2, line.parameter(i));
    knots.pop_back();
  } else {
    for (int i = 0; i < count; ++i) knots.insert(knots.end(), i == 0 || i == count - 1 ? 4 : 2, at[i]);
  }
  return {std::move(of), SplineAxis(3, std::move(knots), closed ? Extension::periodic : Extension::tangent)};
}

}  // namespace

NurbsSurface hermite_surface(const PointGrid& grid, const NodeDerivatives& d) {
  const Controls u = controls(grid.points.rows, grid.at_u, grid.closed_u);
  const Controls v = controls(grid.points.columns, grid.at_v, grid.closed_v);
  std::vector<Vec3> points;
  for (const auto& [i, a] : u.of)
    for (const auto& [j, b] : v.of)
      points.push_back(grid.points.at(i, j) + a * d.u.at(i, j) + b * d.v.at(i, j) + a * b * d.uv.at(i, j));
  return NurbsSurface(u.axis, v.axis, points);
}

TypeDeclaration hermite_surface_type() {
  TypeDeclaration type = declare(
      Category::surface, "hermite_surface",
      "Bicubic surface through a grid of points with given or estimated derivatives at them (Ferguson, Hermite); a "
      "point moves the surface nearby alone. On two by two points with knots [0, 1] it is one bicubic patch.");
  declare_point_grid(type);
  return type.field("estimate", choice(tangent_estimates()), "rule for derivatives that are not given", "bessel")
      .field("twist", choice({"tensor", "central", "zero"}),
             "mixed derivatives that are not given: the rule used in both directions, of differences of four points, "
             "or none (flat spots)",
             "tensor")
      .optional("u_tangents", net(), "derivatives by u, in the order of the points")
      .optional("v_tangents", net(), "derivatives by v")
      .optional("twists", net(), "derivatives by u and v")
      .optional("u_directions", net(), "directions along u alone, of any length; [0, 0, 0] where one is not known")
      .optional("v_directions", net(), "directions along v")
      .optional("normals", net(),
                "normals at the points, to which directions are turned; [0, 0, 0] where one is not known")
      .shows({"control_net"})
      .example(
          "points: [[[0, 0, 0], [0, 1, 1], [0, 2, 0]], [[1, 0, 1], [1, 1, 0], [1, 2, 1]], [[2, 0, 0], [2, 1, 1], "
          "[2, 2, 0]]]")
      .built_by([](const Fields& f) {
        const PointGrid grid = read_point_grid(f);
        return hermite_surface(grid, derivatives_of(f, grid));
      });
}

}  // namespace lekalo::geometry
