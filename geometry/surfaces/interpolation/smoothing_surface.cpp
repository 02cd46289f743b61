// Surfaces that pass by the points of a grid for the sake of smoothness, tensor products of the curves' ways (Zavyalov
// et al. 1985, I.9, formulas 93 to 98; II.6, problem 8):
//
//   local      control points are made of few neighbours, first along the rows, then along the columns; in passes the
//              points are replaced by those of the surface and put back into a corridor about the first ones. Of even
//              steps and second order a pass multiplies by 1/6, 2/3, 1/6 both ways
//   stiffness  smoothing splines: the sum of squares and the integral of the squared second derivative along each line
#include <fmt/format.h>

#include <algorithm>

#include "geometry/curves/interpolation/local_spline.h"
#include "geometry/curves/interpolation/smoothing_spline.h"
#include "geometry/surfaces/interpolation/point_grid.h"

namespace lekalo::geometry {

namespace {

struct Lines {
  LineSpline along_u, along_v;
};

Lines local_lines(const PointGrid& grid, int order) {
  const auto along = [order](const std::vector<double>& at, bool closed) -> LineSpline {
    return [=](std::span<const Vec3> points) { return local_spline({points, at, closed}, order); };
  };
  return {along(grid.at_u, grid.closed_u), along(grid.at_v, grid.closed_v)};
}

Lines stiff_lines(const PointGrid& grid, double stiffness_u, double stiffness_v) {
  const auto along = [](const std::vector<double>& at, bool closed, double stiffness) -> LineSpline {
    return [=](std::span<const Vec3> points) { return smoothing_spline(points, at, closed, stiffness); };
  };
  return {along(grid.at_u, grid.closed_u, stiffness_u), along(grid.at_v, grid.closed_v, stiffness_v)};
}

NurbsSurface smoothed(PointGrid grid, const Lines& lines, int passes, double corridor) {
  const Grid<Vec3> first = grid.points;
  for (int pass = 0; pass < passes; ++pass) {
    const NurbsSurface surface = tensor_surface(grid.points, lines.along_u, lines.along_v);
    for (int i = 0; i < grid.points.rows; ++i)
      for (int j = 0; j < grid.points.columns; ++j)
        grid.points.at(i, j) =
            glm::clamp(surface.point(grid.at_u[i], grid.at_v[j]), first.at(i, j) - corridor, first.at(i, j) + corridor);
  }
  return tensor_surface(grid.points, lines.along_u, lines.along_v);
}

NurbsSurface build(const Fields& f) {
  const PointGrid grid = read_point_grid(f);
  if (std::min(grid.points.rows, grid.points.columns) < 3)
    throw FieldError("points", fmt::format("{} x {} points: three rows and columns are needed at least",
                                           grid.points.rows, grid.points.columns));
  if (f.has("stiffness.u")) {
    for (const char* other : {"order", "passes", "corridor"})
      if (f.given(other)) throw FieldError(other, "this belongs to local smoothing", "leave it or 'stiffness' out");
    return smoothed(grid, stiff_lines(grid, f.u<double>("stiffness"), f.v<double>("stiffness")), 0, kInfinity);
  }
  if (f.has("corridor") && f.integer("passes") == 0)
    throw FieldError("corridor", "points move in passes alone", "say how many: passes: 1");
  const int order = f.text("order") == "second" ? 2 : 4;
  return smoothed(grid, local_lines(grid, order), f.integer("passes"),
                  f.has("corridor") ? f.number("corridor") : kInfinity);
}

}  // namespace

TypeDeclaration smoothing_surface_type() {
  TypeDeclaration type = declare(Category::surface, "smoothing_surface",
                                 "Bicubic surface near the points of a grid, smoother than they are: by neighbours "
                                 "alone, in passes and within a corridor; or by a stiffness along both families of "
                                 "lines.");
  declare_point_grid(type);
  return type
      .field("order", choice({"second", "fourth"}),
             "second: smoother than the points, at open borders through them; fourth: as near as a bicubic can be, "
             "exact for points of bicubics",
             "fourth")
      .field("passes", integer().between(0, 10000), "how often points are replaced by points of the surface", "0")
      .optional("corridor", length().positive(), "how far each coordinate of a point may move in passes")
      .optional("stiffness", number().non_negative().for_each_direction(),
                "weight of the integral of the squared second derivative along the lines beside the sum of squares")
      .shows({"control_net", "knots"})
      .example(
          "order: second, passes: 2, points: [[[0, 0, 0], [0, 1, 1], [0, 2, 0]], [[1, 0, 1], [1, 1, 0], [1, 2, 1]], "
          "[[2, 0, 0], [2, "
          "1, "
          "1], [2, 2, 0]]]")
      .built_by(build);
}

}  // namespace lekalo::geometry
