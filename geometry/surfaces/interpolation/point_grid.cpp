#include "geometry/surfaces/interpolation/point_grid.h"

#include <fmt/format.h>

#include <cmath>

#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// Sums over the lines of the steps between neighbours, the closing one included.
std::vector<double> summed_steps(const std::vector<std::vector<Vec3>>& lines, bool closed) {
  std::vector<double> sums;
  for (const std::vector<Vec3>& line : lines) {
    const std::vector<double> steps = polygon_steps(line, closed);
    sums.resize(steps.size(), 0.0);
    for (size_t i = 0; i < steps.size(); ++i) sums[i] += steps[i] / lines.size();
  }
  return sums;
}

std::vector<double> by_rule(const std::string& rule, const std::vector<double>& steps, const char* lines) {
  const double power = rule == "uniform" ? 0 : rule == "centripetal" ? 0.5 : 1;
  std::vector<double> parameters{0.0};
  for (const double step : steps) parameters.push_back(parameters.back() + std::pow(step, power));
  for (size_t i = 1; i < parameters.size(); ++i)
    if (!(parameters[i] - parameters[i - 1] > kSameKnot * parameters.back()))
      throw FieldError("points", fmt::format("{} {} and {} of the points coincide", lines, i - 1, i),
                       "leave one of them out, or say knots: uniform");
  return parameters;
}

std::vector<double> parameters_of(const Knots& knots, const std::vector<std::vector<Vec3>>& lines, bool closed,
                                  const char* direction, const char* names) {
  const size_t count = lines.front().size(), needed = count + (closed ? 1 : 0);
  if (count < (closed ? 3 : 2))
    throw FieldError("points", fmt::format("a {}surface needs at least {} {} of points, not {}",
                                           closed ? "closed " : "", closed ? 3 : 2, names, count));
  if (knots.rule == "clamped")
    throw FieldError("knots", "'clamped' is a rule for control points, not for points on a surface",
                     "uniform, chord_length or centripetal");
  if (!knots.rule.empty()) return by_rule(knots.rule, summed_steps(lines, closed), names);
  const std::vector<double>& values = knots.values;
  if (values.size() != needed)
    throw FieldError("knots",
                     fmt::format("{} {}{} need {} values of {}, not {}", count, names, closed ? ", closed," : "",
                                 needed, direction, values.size()),
                     closed ? "the last one is where the surface comes back to the first line" : "one for each line");
  for (size_t i = 1; i < values.size(); ++i)
    if (!(values[i] - values[i - 1] > kSameKnot * (values.back() - values.front())))
      throw FieldError(
          "knots", fmt::format("values of {} must increase, but {} follows {}", direction, values[i], values[i - 1]));
  return values;
}

}  // namespace

std::vector<Vec3> line_along_u(const Grid<Vec3>& grid, int j) {
  std::vector<Vec3> line;
  for (int i = 0; i < grid.rows; ++i) line.push_back(grid.at(i, j));
  return line;
}

std::vector<Vec3> line_along_v(const Grid<Vec3>& grid, int i) {
  const auto begin = grid.values.begin() + static_cast<std::ptrdiff_t>(i) * grid.columns;
  return {begin, begin + grid.columns};
}

std::vector<double> mean_steps(const Grid<Vec3>& grid, bool along_u, bool closed) {
  std::vector<std::vector<Vec3>> lines;
  for (int k = 0; k < (along_u ? grid.columns : grid.rows); ++k)
    lines.push_back(along_u ? line_along_u(grid, k) : line_along_v(grid, k));
  return summed_steps(lines, closed);
}

namespace {

PointGrid with_parameters(const Fields& fields, PointGrid grid) {
  std::vector<std::vector<Vec3>> columns, rows;
  for (int j = 0; j < grid.points.columns; ++j) columns.push_back(line_along_u(grid.points, j));
  for (int i = 0; i < grid.points.rows; ++i) rows.push_back(line_along_v(grid.points, i));
  grid.at_u = parameters_of(fields.u<Knots>("knots"), columns, grid.closed_u, "u", "rows");
  grid.at_v = parameters_of(fields.v<Knots>("knots"), rows, grid.closed_v, "v", "columns");
  return grid;
}

}  // namespace

PointGrid read_point_grid(const Fields& fields) {
  return with_parameters(fields, {fields.net("points"), {}, {}, fields.u<bool>("closed"), fields.v<bool>("closed")});
}

PointGrid read_open_grid(const Fields& fields, const char* field) {
  return with_parameters(fields, {fields.net(field), {}, {}, false, false});
}

void declare_point_grid(TypeDeclaration& type) {
  type.field("points", net(),
             "points of the surface: points[i][j], i runs with u, j with v; of a closed direction not "
             "repeated");
  type.field("knots", knots().for_each_direction(),
             "values of u at the rows and of v at the columns (when closed one more: the end of the period), or a "
             "rule: uniform, chord_length, centripetal (of the mean distances)",
             "chord_length");
  type.field("closed", boolean().for_each_direction(), "periodic, smooth over its seam", "false");
}

NurbsSurface tensor_surface(const Grid<Vec3>& points, const LineSpline& along_u, const LineSpline& along_v) {
  std::optional<SplineAxis> axis_u, axis_v;
  const auto control = [](const NurbsCurve& curve, std::optional<SplineAxis>& axis) {
    if (!axis) axis = curve.axis();
    std::vector<Vec3> result;
    for (int i = 0; i < axis->distinct(); ++i) result.emplace_back(curve.points()[i]);
    return result;
  };
  std::vector<std::vector<Vec3>> columns;
  for (int j = 0; j < points.columns; ++j) columns.push_back(control(along_u(line_along_u(points, j)), axis_u));
  std::vector<Vec3> all;
  for (size_t i = 0; i < columns.front().size(); ++i) {
    std::vector<Vec3> row;
    for (const std::vector<Vec3>& column : columns) row.push_back(column[i]);
    const std::vector<Vec3> of_row = control(along_v(row), axis_v);
    all.insert(all.end(), of_row.begin(), of_row.end());
  }
  return NurbsSurface(*axis_u, *axis_v, all);
}

}  // namespace lekalo::geometry
