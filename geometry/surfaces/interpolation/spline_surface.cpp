// Smooth splines through a grid of points (Zavyalov et al. 1985, I.6, II.6; Piegl, Tiller 1997, 9.2.5): the splines
// through the points of each column, then through their control points along each row. The result does not depend on
// which direction comes first.
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

LineSpline spline_along(const std::vector<double>& at, bool closed, int degree, const SplineEnd& end) {
  return [=](std::span<const Vec3> points) {
    return closed ? closed_spline_curve(points, at, degree) : spline_curve(points, at, degree, end, end);
  };
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
      .shows({"control_net"})
      .example(
          "points: [[[0, 0, 0], [0, 1, 1], [0, 2, 0]], [[1, 0, 1], [1, 1, 0], [1, 2, 1]], [[2, 0, 0], [2, 1, 1], "
          "[2, 2, 0]]]")
      .built_by([](const Fields& f) {
        const PointGrid grid = read_point_grid(f);
        return tensor_surface(
            grid.points, spline_along(grid.at_u, grid.closed_u, f.u<int>("degree"), end_of(f.u<std::string>("ends"))),
            spline_along(grid.at_v, grid.closed_v, f.v<int>("degree"), end_of(f.v<std::string>("ends"))));
      });
}

}  // namespace lekalo::geometry
