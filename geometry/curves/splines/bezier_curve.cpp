#include "geometry/curves/splines/bezier_curve.h"

#include <fmt/format.h>

#include "geometry/curves/splines/bspline_basis.h"

namespace lekalo::geometry {

NurbsCurve bezier_curve(std::span<const Vec3> points, std::span<const double> weights, const Interval& domain) {
  const int degree = static_cast<int>(points.size()) - 1;
  if (degree < 1 || degree > kMaxDegree)
    throw FieldError("points", fmt::format("a Bezier curve has 2 to {} points, not {}", kMaxDegree + 1, points.size()),
                     "more points: use a nurbs_curve of low degree");
  std::vector<double> knots(2 * points.size(), 0.0);
  std::fill(knots.begin() + degree + 1, knots.end(), 1.0);
  SplineAxis axis(degree, std::move(knots), Extension::analytic);
  if (domain != Interval(0, 1)) axis.restrict_to(domain);
  return NurbsCurve(std::move(axis), points, weights);
}

TypeDeclaration bezier_curve_type() {
  return declare(Category::curve, "bezier_curve", "Bezier curve of any degree, polynomial or rational; t runs in 0..1.")
      .field("points", points().count(2, kMaxDegree + 1), "control points; the degree is one less than their number")
      .optional("weights", numbers(), "one weight for each point; all 1 when left out")
      .field("domain", range(), "part of the curve, inside [0, 1]", "[0, 1]")
      .shows({"control_polygon", "de_casteljau"})
      .built_by([](const Fields& f) {
        return bezier_curve(f.points("points"), f.has("weights") ? f.numbers("weights") : std::vector<double>(),
                            f.range("domain"));
      });
}

}  // namespace lekalo::geometry
