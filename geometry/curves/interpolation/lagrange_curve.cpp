// Newton's form r(t) = a_0 + a_1 (t - t_0) + .. + a_n (t - t_0) .. (t - t_{n-1}) with divided differences a_k is the
// same curve as Lagrange's sum_i p_i prod_{j != i} (t - t_j) / (t_i - t_j) (Golovanov 2016, 2.3.4, 2.3.5). It becomes a
// Bezier curve by Horner's rule on Bernstein coefficients, in extended precision because terms cancel.
#include "geometry/curves/interpolation/lagrange_curve.h"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/curves/interpolation/point_parameters.h"
#include "geometry/curves/splines/bspline_basis.h"
#include "geometry/numerics/divided_differences.h"

namespace lekalo::geometry {

namespace {

using Real = long double;
using Real3 = glm::vec<3, Real>;

struct Nodes {
  std::vector<Real> t;
  std::vector<Real3> values;  // relative to the first point
};

Nodes nodes_of(std::span<const Vec3> points, std::span<const double> parameters,
               std::span<const PointTangent> tangents) {
  Nodes nodes;
  for (size_t i = 0; i < points.size(); ++i) {
    nodes.t.push_back(parameters[i]);
    nodes.values.push_back(Real3(points[i]) - Real3(points[0]));
    for (const PointTangent& one : tangents) {
      if (one.point != static_cast<int>(i)) continue;
      nodes.t.push_back(parameters[i]);
      nodes.values.emplace_back(one.tangent);
    }
  }
  return nodes;
}

// Bernstein coefficients over [lo, hi] of (t - node) times a polynomial of those.
std::vector<Real3> times_linear(const std::vector<Real3>& b, Real node, Real lo, Real hi) {
  const size_t degree = b.size();
  std::vector<Real3> result(degree + 1, Real3(0));
  for (size_t k = 0; k < degree; ++k) {
    result[k] += Real(degree - k) / Real(degree) * (lo - node) * b[k];
    result[k + 1] += Real(k + 1) / Real(degree) * (hi - node) * b[k];
  }
  return result;
}

}  // namespace

NurbsCurve lagrange_curve(std::span<const Vec3> points, std::span<const double> parameters,
                          std::span<const PointTangent> tangents) {
  check_tangents(tangents, static_cast<int>(points.size()));
  const size_t degree = points.size() + tangents.size() - 1;
  if (degree > kMaxDegree)
    throw FieldError("points",
                     fmt::format("a polynomial through {} points{} has degree {}, above {}", points.size(),
                                 tangents.empty() ? "" : " with tangents", degree, kMaxDegree),
                     "such degrees oscillate without use: a spline_curve goes through any number of points");
  const Nodes nodes = nodes_of(points, parameters, tangents);
  const std::vector<Real3> newton = divided_differences(nodes.t, nodes.values);
  const Real lo = parameters.front(), hi = parameters.back();
  std::vector<Real3> bezier{newton[degree]};
  for (size_t k = degree; k-- > 0;) {
    bezier = times_linear(bezier, nodes.t[k], lo, hi);
    for (Real3& b : bezier) b += newton[k];
  }
  std::vector<Vec3> control;
  for (const Real3& b : bezier) control.emplace_back(b + Real3(points[0]));
  control.front() = points.front();
  control.back() = points.back();
  std::vector<double> knots(degree + 1, parameters.front());
  knots.insert(knots.end(), degree + 1, parameters.back());
  return NurbsCurve(SplineAxis(static_cast<int>(degree), std::move(knots), Extension::analytic), control);
}

TypeDeclaration lagrange_curve_type() {
  return declare(Category::curve, "lagrange_curve",
                 "The polynomial through points (Lagrange's, Newton's), and with tangents at some. Beyond ten even "
                 "parameters it swings widely near the ends (Runge 1901); a spline_curve does not.")
      .example("points: [[0, 0], [1, 2], [3, 3], [4, 0], [6, 1]]")
      .field("points", points().count(2), "points of the curve")
      .field("knots", knots(), kPointKnots, "chord_length")
      .optional("tangents", point_tangents(), "derivatives at some points; each makes the degree higher by one")
      .shows({"control_polygon", "knots"})
      .built_by([](const Fields& f) {
        const std::vector<Vec3>& points = f.points("points");
        return lagrange_curve(points, point_parameters(f.knots("knots"), points, false), point_tangents(f, "tangents"));
      });
}

}  // namespace lekalo::geometry
