// Smooth splines through a grid of points (Zavyalov et al. 1985, I.6, II.6; Piegl, Tiller 1997, 9.2.5): the splines
// through the points of each column, then through their control points along each row. The result does not depend on
// which direction comes first.
#include <fmt/format.h>

#include "geometry/curves/interpolation/spline_curve.h"
#include "geometry/curves/splines/bspline_basis.h"
#include "geometry/surfaces/interpolation/point_grid.h"

namespace lekalo::geometry {

namespace {

SplineEnd end_of(const std::string& word) {
  SplineEnd end;
  end.rule = word == "natural" ? EndRule::natural : word == "parabolic" ? EndRule::parabolic : EndRule::not_a_knot;
  return end;
}

// What is known at the two ends of each line of a direction: derivatives of one order, or nothing.
struct Border {
  int order = 1;
  std::vector<Vec3> start, end;
};

struct LineRule {
  std::vector<double> at;
  bool closed = false;
  int degree = 3;
  SplineEnd end;
  Border border;

  // Through the points of line k.
  NurbsCurve operator()(std::span<const Vec3> points, size_t k) const {
    if (closed) return closed_spline_curve(points, at, degree);
    const auto with = [&](const std::vector<Vec3>& given) {
      SplineEnd result = end;
      if (!given.empty()) (border.order == 1 ? result.tangent : result.second) = given[k];
      return result;
    };
    return spline_curve(points, at, degree, with(border.start), with(border.end));
  }
};

std::vector<Vec3> vectors(const Fields& f, const char* field, int count) {
  if (!f.has(field)) return {};
  if (static_cast<int>(f.points(field).size()) != count)
    throw FieldError(field, fmt::format("{} lines end there, not {}", count, f.points(field).size()),
                     "one vector for each");
  return f.points(field);
}

LineRule read_rule(const Fields& f, const PointGrid& grid, bool along_u) {
  LineRule rule{along_u ? grid.at_u : grid.at_v,
                along_u ? grid.closed_u : grid.closed_v,
                along_u ? f.u<int>("degree") : f.v<int>("degree"),
                end_of(along_u ? f.u<std::string>("ends") : f.v<std::string>("ends")),
                {f.integer("border_derivatives"), {}, {}}};
  const int lines = along_u ? grid.points.columns : grid.points.rows;
  rule.border.start = vectors(f, along_u ? "u_start" : "v_start", lines);
  rule.border.end = vectors(f, along_u ? "u_end" : "v_end", lines);
  if (rule.closed && !(rule.border.start.empty() && rule.border.end.empty()))
    throw FieldError(
        along_u ? (rule.border.start.empty() ? "u_end" : "u_start") : (rule.border.start.empty() ? "v_end" : "v_start"),
        "a closed direction has no borders");
  return rule;
}

std::vector<Vec3> control_of(const NurbsCurve& curve) {
  std::vector<Vec3> points;
  for (int i = 0; i < curve.axis().distinct(); ++i) points.emplace_back(curve.points()[i]);
  return points;
}

// The control points along u of what is given at a border of v: its own derivatives by u at the corners are the mixed
// ones of the surface.
std::vector<Vec3> control_of_border(const Fields& f, LineRule u, const std::vector<Vec3>& given, int corner) {
  if (given.empty()) return {};
  const bool mixed = f.has("corner_twists");
  if (mixed) {
    const Grid<Vec3>& twists = f.net("corner_twists");
    if (!u.border.start.empty()) u.border.start = {twists.at(0, corner)};
    if (!u.border.end.empty()) u.border.end = {twists.at(1, corner)};
  } else {
    u.border.start.clear(), u.border.end.clear();
  }
  return control_of(u(given, 0));
}

NurbsSurface spline_surface(const Fields& f, const PointGrid& grid) {
  const LineRule u = read_rule(f, grid, true);
  LineRule v = read_rule(f, grid, false);
  if (f.has("corner_twists") && (f.net("corner_twists").rows != 2 || f.net("corner_twists").columns != 2))
    throw FieldError("corner_twists", "the corners are 2 x 2");
  std::vector<std::vector<Vec3>> columns;
  std::optional<SplineAxis> axis_u, axis_v;
  for (int j = 0; j < grid.points.columns; ++j) {
    const NurbsCurve curve = u(line_along_u(grid.points, j), j);
    axis_u = curve.axis();
    columns.push_back(control_of(curve));
  }
  v.border.start = control_of_border(f, u, v.border.start, 0), v.border.end = control_of_border(f, u, v.border.end, 1);
  std::vector<Vec3> all;
  for (size_t i = 0; i < columns.front().size(); ++i) {
    std::vector<Vec3> row;
    for (const std::vector<Vec3>& column : columns) row.push_back(column[i]);
    const NurbsCurve curve = v(row, i);
    axis_v = curve.axis();
    const std::vector<Vec3> points = control_of(curve);
    all.insert(all.end(), points.begin(), points.end());
  }
  return NurbsSurface(*axis_u, *axis_v, all);
}

}  // namespace

TypeDeclaration spline_surface_type() {
  TypeDeclaration type = declare(
      Category::surface, "spline_surface",
      "Smooth surface through a grid of points, of any degrees: bicubic with continuous second derivatives, ...");
  declare_point_grid(type);
  return type
      .field("degree", integer().between(1, kMaxDegree).for_each_direction(), "degrees of the polynomial patches", "3")
      .field("ends", choice({"natural", "parabolic", "not_a_knot"}).for_each_direction(),
             "what holds at the borders of an open direction: no second derivative across, none of the third, or the "
             "line next to the border is no knot",
             "not_a_knot")
      .optional("u_start", points(), "derivatives by u at the first row, one for each column")
      .optional("u_end", points(), "derivatives by u at the last row")
      .optional("v_start", points(), "derivatives by v at the first column, one for each row")
      .optional("v_end", points(), "derivatives by v at the last column")
      .optional(
          "corner_twists", net(),
          "2 x 2 vectors: the derivatives of those at the borders of v along u, where both are given; else by the "
          "rule of 'ends'")
      .field("border_derivatives", integer().between(1, 2), "order of those given at the borders; mixed: of both", "1")
      .shows({"control_net"})
      .example(
          "points: [[[0, 0, 0], [0, 1, 1], [0, 2, 0]], [[1, 0, 1], [1, 1, 0], [1, 2, 1]], [[2, 0, 0], [2, 1, 1], "
          "[2, 2, 0]]]")
      .built_by([](const Fields& f) { return spline_surface(f, read_point_grid(f)); });
}

}  // namespace lekalo::geometry
