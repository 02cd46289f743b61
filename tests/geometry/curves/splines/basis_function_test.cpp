// Graphs of B-spline basis functions against their own recursion (Golovanov 2016, 2.8).
#include <gtest/gtest.h>

#include "geometry/curve.h"
#include "geometry/describe.h"

namespace lekalo::geometry::basis_function_test {
namespace {

CurvePtr function(int degree, const std::vector<double>& knots, int index) {
  for (const TypeDeclaration& type : geometry_types())
    if (type.name == "basis_function") {
      Fields fields;
      fields.set("degree", degree), fields.set("knots", knots), fields.set("index", index);
      return std::any_cast<CurvePtr>(type.build(fields));
    }
  return nullptr;
}

double recursion(int degree, const std::vector<double>& t, int i, double x) {
  if (degree == 0) return t[i] <= x && x < t[i + 1] ? 1 : 0;
  double sum = 0;
  if (t[i + degree] > t[i]) sum += (x - t[i]) / (t[i + degree] - t[i]) * recursion(degree - 1, t, i, x);
  if (t[i + degree + 1] > t[i + 1])
    sum += (t[i + degree + 1] - x) / (t[i + degree + 1] - t[i + 1]) * recursion(degree - 1, t, i + 1, x);
  return sum;
}

TEST(BasisFunction, IsTheGraphOfItsRecursion) {
  const std::vector<std::pair<int, std::vector<double>>> cases = {{3, {0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 6, 6, 6}},
                                                                  {2, {0, 1, 2, 3, 4, 5, 6}},
                                                                  {1, {0, 0.5, 2, 2, 3}},
                                                                  {2, {0, 0, 1, 1, 2, 5}}};
  for (const auto& [degree, knots] : cases)
    for (int i = 0; i + degree + 1 < static_cast<int>(knots.size()); ++i) {
      const CurvePtr graph = function(degree, knots, i);
      EXPECT_EQ(graph->domain().lo, knots.front());
      EXPECT_EQ(graph->domain().hi, knots.back());
      for (double x = knots.front() + 0.013; x < knots.back(); x += 0.171) {
        const Vec3 p = graph->point(x);
        EXPECT_NEAR(p.x, x, 1e-14 * (1 + x));
        EXPECT_NEAR(p.y, recursion(degree, knots, i, x), 1e-14) << degree << " " << i << " " << x;
        EXPECT_EQ(p.z, 0);
      }
    }
  EXPECT_NEAR(function(3, cases[0].second, 4)->point(3).y, 2.0 / 3, 1e-15);
}

TEST(BasisFunction, Errors) {
  EXPECT_THROW(function(3, {0, 1, 2, 3}, 0), FieldError);
  EXPECT_THROW(function(2, {0, 0, 0, 1, 1, 1}, 3), FieldError);
  EXPECT_THROW(function(1, {0, 1, 0.5, 2}, 0), FieldError);
  EXPECT_THROW(function(1, {0, 0, 0, 1}, 0), FieldError);
}

}  // namespace
}  // namespace lekalo::geometry::basis_function_test
