#include "geometry/surfaces/splines/bezier_surface.h"

#include <fmt/format.h>

#include "geometry/curves/splines/bspline_basis.h"

namespace lekalo::geometry {

namespace {

SplineAxis bezier_axis(int count, const Interval& domain) {
  const int degree = count - 1;
  std::vector<double> knots(2 * static_cast<size_t>(count), 0.0);
  std::fill(knots.begin() + count, knots.end(), 1.0);
  SplineAxis axis(degree, std::move(knots), Extension::analytic);
  if (domain != Interval(0, 1)) axis.restrict_to(domain);
  return axis;
}

}  // namespace

NurbsSurface bezier_surface(const Grid<Vec3>& points, std::span<const double> weights, const Rectangle& domain) {
  for (const int count : {points.rows, points.columns})
    if (count < 2 || count > kMaxDegree + 1)
      throw FieldError("points",
                       fmt::format("a Bezier surface has 2 to {} rows and columns of points, not {} x {}",
                                   kMaxDegree + 1, points.rows, points.columns),
                       "more points: use a nurbs_surface of low degree");
  return NurbsSurface(bezier_axis(points.rows, domain.u), bezier_axis(points.columns, domain.v), points.values,
                      weights);
}

TypeDeclaration bezier_surface_type() {
  return declare(Category::surface, "bezier_surface",
                 "Bezier surface of any degrees, polynomial or rational; u and v run in 0..1.")
      .field("points", net(), "control points: points[i][j], i runs with u, j with v; degrees are one less")
      .optional("weights", number_grid(), "one weight for each point, in the same rows; all 1 when left out")
      .field("domain", rectangle(), "part of the surface, inside 0..1", "{ u: [0, 1], v: [0, 1] }")
      .shows({"control_net", "de_casteljau"})
      .built_by(
          [](const Fields& f) { return bezier_surface(f.net("points"), weights_of_net(f), f.rectangle("domain")); });
}

}  // namespace lekalo::geometry
