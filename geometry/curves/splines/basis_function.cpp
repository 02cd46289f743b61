// Graphs of B-spline basis functions: the plane curves (t, N_i^p(t)) (Golovanov 2016, 2.8), over all knots.
//
// The function t is a spline with the Greville abscissae as coefficients, t = sum g_j N_j^p(t), g_j = (t_{j+1} + .. +
// t_{j+p})/p, so that the graph is a spline exactly. Where the end knots are not repeated p + 1 times further copies of
// them are put in: the functions asked for stay the same, and the graph reaches the ends.
#include <algorithm>

#include "geometry/curves/splines/bspline_basis.h"
#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/describe.h"

namespace lekalo::geometry {

namespace {

NurbsCurve basis_function(int degree, std::vector<double> knots, int index) {
  const auto copies = [&](double knot) { return static_cast<int>(std::count(knots.begin(), knots.end(), knot)); };
  const int before = std::max(0, degree + 1 - copies(knots.front())),
            behind = std::max(0, degree + 1 - copies(knots.back()));
  knots.insert(knots.begin(), static_cast<size_t>(before), knots.front());
  knots.insert(knots.end(), static_cast<size_t>(behind), knots.back());
  const int count = static_cast<int>(knots.size()) - degree - 1;
  std::vector<Vec3> points;
  for (int j = 0; j < count; ++j) {
    double sum = 0;
    for (int k = 1; k <= degree; ++k) sum += knots[static_cast<size_t>(j + k)];
    points.emplace_back(sum / degree, j == index + before ? 1.0 : 0.0, 0.0);
  }
  return NurbsCurve(make_axis(degree, {"", knots}, false, count, {}), points);
}

}  // namespace

TypeDeclaration basis_function_type() {
  return declare(Category::curve, "basis_function", "Graph of a B-spline basis function: the plane curve (t, N_i(t)).")
      .example("degree: 2, knots: [0, 0, 0, 1, 1, 1], index: 1")
      .field("degree", integer().between(1, kMaxDegree), "degree of the function")
      .field("knots", numbers().count(3), "the full knot vector of all the functions")
      .field("index", integer().at_least(0), "which of them, from 0 to number of knots - degree - 2")
      .shows({"knots", "control_polygon"})
      .built_by([](const Fields& f) {
        const int degree = f.integer("degree"), index = f.integer("index");
        const std::vector<double>& knots = f.numbers("knots");
        const int functions = static_cast<int>(knots.size()) - degree - 1;
        if (functions < 1)
          throw FieldError("knots", "a function of degree " + std::to_string(degree) + " has " +
                                        std::to_string(degree + 2) + " knots: there are too few");
        if (index >= functions)
          throw FieldError(
              "index",
              "these knots have " + std::to_string(functions) + " functions of degree " + std::to_string(degree),
              "the last is " + std::to_string(functions - 1));
        if (!std::is_sorted(knots.begin(), knots.end())) throw FieldError("knots", "knots do not decrease");
        for (size_t j = 0; j + static_cast<size_t>(degree) + 1 < knots.size(); ++j)
          if (knots[j] == knots[j + static_cast<size_t>(degree) + 1])
            throw FieldError("knots", "a knot stands " + std::to_string(degree + 2) + " times: at most degree + 1");
        return basis_function(degree, knots, index);
      });
}

}  // namespace lekalo::geometry
