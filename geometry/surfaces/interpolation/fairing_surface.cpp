// Fairings: smooth surfaces whose lines of one family all run from a pole A to a pole B, those of the other shrink to
// points there (Zavyalov et al. 1985, VII.5).
//
//   r(u, v_0) = A,   r(u, v_M) = B,   r_v there across the normals n_A, n_B
//
// Along v runs the spline through A, the points of a row and B with derivatives at its ends that are those of the
// circle through three points, turned across the normal, t - (t n) n; along u the spline of their control points. The
// second control line of v, A + h r_v/3, lies in the tangent plane of the pole, so the normals there are n_A from all
// sides.
#include <fmt/format.h>

#include "geometry/curves/interpolation/spline_curve.h"
#include "geometry/describe.h"
#include "geometry/surfaces/interpolation/point_grid.h"

namespace lekalo::geometry {

namespace {

struct Pole {
  const char* point;
  const char* normal;
};
constexpr Pole kStart{"start", "start_normal"}, kEnd{"end", "end_normal"};

std::vector<double> summed(const std::vector<double>& steps, const char* names) {
  std::vector<double> at{0};
  for (const double step : steps) {
    if (!(step > 0))
      throw FieldError("points", fmt::format("{} {} and {} of the points coincide", names, at.size() - 1, at.size()),
                       "leave one of them out");
    at.push_back(at.back() + step);
  }
  return at;
}

// The points with the poles for first and last column.
Grid<Vec3> with_poles(const Fields& f) {
  const Grid<Vec3>& given = f.net("points");
  Grid<Vec3> grid{given.rows, given.columns + 2, {}};
  for (int i = 0; i < given.rows; ++i) {
    grid.values.push_back(f.vec3("start"));
    for (int j = 0; j < given.columns; ++j) grid.values.push_back(given.at(i, j));
    grid.values.push_back(f.vec3("end"));
  }
  return grid;
}

// Of lines that leave the pole: given, or the mean of those of neighbours.
Vec3 normal_of(const Fields& f, const Pole& pole, const std::vector<Vec3>& leaving, bool closed) {
  Vec3 normal(0);
  if (f.has(pole.normal)) {
    normal = f.vec3(pole.normal);
  } else {
    for (size_t i = 0; i + (closed ? 0 : 1) < leaving.size(); ++i)
      normal += glm::cross(leaving[i], leaving[(i + 1) % leaving.size()]);
    if (!(glm::length(normal) > 1e-9 * glm::dot(leaving[0], leaving[0])))
      throw FieldError(pole.point, "the lines that meet in the pole have no plane in common",
                       fmt::format("give '{}'", pole.normal));
  }
  return glm::normalize(normal);
}

// Derivatives by v of all rows at a pole.
std::vector<Vec3> derivatives(const Fields& f, const Pole& pole, const Grid<Vec3>& grid,
                              const std::vector<double>& at_v) {
  const bool at_start = pole.point == kStart.point;
  std::vector<Vec3> result;
  for (int i = 0; i < grid.rows; ++i) {
    const std::vector<Vec3> line = line_along_v(grid, i);
    const std::vector<Vec3> tangents = estimated_tangents("circle", {line, at_v, false});
    result.push_back(at_start ? tangents.front() : tangents.back());
  }
  const Vec3 n = normal_of(f, pole, result, f.boolean("closed"));
  for (size_t i = 0; i < result.size(); ++i) {
    const double speed = glm::length(result[i]);
    const Vec3 across = result[i] - glm::dot(result[i], n) * n;
    if (!(glm::length(across) > 1e-6 * speed))
      throw FieldError(pole.normal, fmt::format("row {} leaves the pole along the normal", i),
                       "a normal across the lines that meet in the pole");
    result[i] = speed * glm::normalize(across);
  }
  return result;
}

NurbsSurface fairing(const Fields& f) {
  const bool closed = f.boolean("closed");
  const Grid<Vec3> grid = with_poles(f);
  if (grid.rows < (closed ? 3 : 2))
    throw FieldError("points", fmt::format("{} rows make no {}fairing", grid.rows, closed ? "closed " : ""));
  const std::vector<double> at_u = summed(mean_steps(grid, true, closed), "rows"),
                            at_v = summed(mean_steps(grid, false, false), "columns");
  const std::vector<Vec3> starts = derivatives(f, kStart, grid, at_v), ends = derivatives(f, kEnd, grid, at_v);
  std::vector<NurbsCurve> along_v;
  for (int i = 0; i < grid.rows; ++i)
    along_v.push_back(spline_curve(line_along_v(grid, i), at_v, 3, {.tangent = starts[i]}, {.tangent = ends[i]}));
  const SplineAxis& axis_v = along_v.front().axis();
  Grid<Vec3> control{grid.rows, axis_v.count(), {}};
  for (const NurbsCurve& curve : along_v)
    for (const Vec4& p : curve.points()) control.values.emplace_back(p);
  const int degree = std::min(3, grid.rows - 1);
  std::optional<SplineAxis> axis_u;
  Grid<Vec3> columns{0, 0, {}};
  for (int k = 0; k < control.columns; ++k) {
    const std::vector<Vec3> line = line_along_u(control, k);
    const NurbsCurve curve = closed ? closed_spline_curve(line, at_u, 3) : spline_curve(line, at_u, degree, {}, {});
    if (!axis_u) {
      axis_u = curve.axis();
      columns = {axis_u->distinct(), control.columns, {}};
      columns.values.resize(static_cast<size_t>(columns.rows) * columns.columns);
    }
    for (int i = 0; i < columns.rows; ++i) columns.at(i, k) = Vec3(curve.points()[i]);
  }
  NurbsSurface surface(*axis_u, axis_v, columns.values);
  if (f.has(kStart.normal)) {
    const Rectangle domain = surface.domain();
    surface.set_reversed(glm::dot(surface.normal(domain.u.middle(), domain.v.lo), f.vec3(kStart.normal)) < 0);
  }
  return surface;
}

}  // namespace

TypeDeclaration fairing_surface_type() {
  return declare(
             Category::surface, "fairing_surface",
             "Smooth surface through rows of points that all begin in one pole and end in another: the borders of v "
             "are points with a tangent plane each.")
      .example(
          "points: [[[1, -1, 0], [2, -1, 0]], [[1, 0, 1], [2, 0, 1]], [[1, 1, 0], [2, 1, 0]]], start: [0, 0, 0], "
          "end: [3, 0, 0]")
      .field("points", net(), "points[i][j] between the poles, i runs with u around them, j with v from pole to pole")
      .field("start", point(), "the pole in which all rows begin")
      .field("end", point(), "the pole in which all rows end")
      .optional(
          "start_normal", direction(),
          "normal of the tangent plane there, and the side to which the surface's looks; else the mean one of the rows")
      .optional("end_normal", direction(), "normal of the tangent plane at the end")
      .field("closed", boolean(), "u closes smoothly about the poles", "false")
      .shows({"control_net", "knots"})
      .built_by(fairing);
}

}  // namespace lekalo::geometry
