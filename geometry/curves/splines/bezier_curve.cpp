#include "geometry/curves/splines/bezier_curve.h"

#include <fmt/format.h>

#include <algorithm>

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

namespace {

// The curve with some points at infinity, (p, 0) in homogeneous coordinates: their direction and length count, their
// weight is 0 (Golovanov 2016, 2.5: a semicircle has its middle point there).
NurbsCurve with_points_at_infinity(const Fields& f) {
  const std::vector<Vec3>& points = f.points("points");
  std::vector<double> weights = f.has("weights") ? f.numbers("weights") : std::vector<double>(points.size(), 1.0);
  if (weights.size() != points.size())
    throw FieldError("weights", fmt::format("{} points need as many weights, not {}", points.size(), weights.size()));
  if (f.range("domain") != Interval(0, 1))
    throw FieldError("domain", "a curve with points at infinity has the whole domain", "leave it out");
  NurbsCurveForm form{static_cast<int>(points.size()) - 1, std::vector<double>(2 * points.size(), 0.0), {}, {}};
  std::fill(form.knots.begin() + static_cast<std::ptrdiff_t>(points.size()), form.knots.end(), 1.0);
  for (size_t i = 0; i < points.size(); ++i) form.points.emplace_back(weights[i] * points[i], weights[i]);
  for (const double index : f.numbers("at_infinity")) {
    const auto i = static_cast<size_t>(index);
    if (static_cast<double>(i) != index || i >= points.size())
      throw FieldError("at_infinity", fmt::format("there is no point {:g}", index),
                       fmt::format("points are counted from 0 to {}", points.size() - 1));
    if (f.has("weights") && weights[i] != 0)
      throw FieldError("at_infinity", fmt::format("point {} has the weight {:g}", i, weights[i]),
                       "the weight of a point at infinity is 0");
    form.points[i] = Vec4(points[i], 0.0);
  }
  return NurbsCurve(form);
}

}  // namespace

TypeDeclaration bezier_curve_type() {
  return declare(Category::curve, "bezier_curve", "Bezier curve of any degree, polynomial or rational; t runs in 0..1.")
      .field("points", points().count(2, kMaxDegree + 1), "control points; the degree is one less than their number")
      .optional("weights", numbers(), "one weight for each point; all 1 when left out")
      .optional("at_infinity", numbers().at_least(0).count(1),
                "indices of points that are directions: at infinity, of weight 0")
      .field("domain", range(), "part of the curve, inside [0, 1]", "[0, 1]")
      .shows({"control_polygon", "de_casteljau"})
      .built_by([](const Fields& f) {
        if (f.has("at_infinity")) return with_points_at_infinity(f);
        return bezier_curve(f.points("points"), f.has("weights") ? f.numbers("weights") : std::vector<double>(),
                            f.range("domain"));
      });
}

}  // namespace lekalo::geometry
