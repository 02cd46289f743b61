// Divided differences and interpolating polynomials.
#include "geometry/curves/interpolation/lagrange_curve.h"

#include "geometry/curves/curve_checks.h"
#include "geometry/numerics/divided_differences.h"

namespace lekalo::geometry::lagrange_curve_test {
namespace {

using checks::distance;
using List = std::vector<double>;

// Golovanov 2016, 2.7.
TEST(DividedDifferences, HaveTheBooksValues) {
  EXPECT_EQ(divided_differences(List{-1, 0.5, 2, 3}, List{-1, 0.125, 8, 27}).back(), 1);
  EXPECT_EQ(divided_differences(List{1, 2, 4}, List{1, 0.5, 0.25}).back(), 0.125);
  EXPECT_EQ(divided_differences(List{4, 1, 2}, List{0.25, 1, 0.5}).back(), 0.125);
  EXPECT_EQ(divided_differences(List{1, 1, 2}, List{1, -1, 0.5}).back(), 0.5);
  EXPECT_EQ(divided_differences(List{2, 2, 2}, List{0.5, -0.25, 0.25}).back(), 0.125);
}

// Golovanov 2016, 2.3: Newton's coefficients; a point more leaves them.
TEST(DividedDifferences, AreNewtonsCoefficients) {
  const List t = {0, 1, 2, 3, 4};
  const List x = divided_differences(t, List{0, 1, 3, 4, 6}), y = divided_differences(t, List{0, 2, 3, 0, 1});
  const List book_x = {0, 1, 0.5, -1. / 3, 1. / 6}, book_y = {0, 2, -0.5, -0.5, 11. / 24};
  for (int k = 0; k < 5; ++k) {
    EXPECT_NEAR(x[k], book_x[k], 1e-16);
    EXPECT_NEAR(y[k], book_y[k], 1e-16);
  }
  const List shorter = divided_differences(List{0, 1, 2, 3}, List{0, 1, 3, 4});
  EXPECT_EQ(shorter, List(x.begin(), x.end() - 1));
}

TEST(LagrangeCurve, IsTheSumOfLagrangesPolynomials) {
  const std::vector<Vec3> points = {{0, 0, 1e3}, {1, 2, 1e3}, {3, 3, 0}, {4, 0, 1}, {6, 1, 7}, {5, 5, 5}};
  const List t = {-1, -0.7, 0.2, 0.5, 1.9, 2};
  const NurbsCurve curve = lagrange_curve(points, t);
  EXPECT_EQ(curve.degree(), 5);
  for (const double at : {-1.2, -1., -0.9, 0.3, 1.2, 1.95, 2., 2.3}) {  // beyond its ends it goes on
    Vec3 sum(0);
    for (size_t i = 0; i < t.size(); ++i) {
      double product = 1;
      for (size_t j = 0; j < t.size(); ++j)
        if (j != i) product *= (at - t[j]) / (t[i] - t[j]);
      sum += product * points[i];
    }
    EXPECT_LE(distance(curve.point(at), sum), 1e-11) << at;
  }
  EXPECT_EQ(curve.point(-1), points.front());
  EXPECT_EQ(curve.point(2), points.back());
  checks::check_pieces(curve);
  checks::check_enclosures(curve, curve.domain());
}

TEST(LagrangeCurve, RefusesDegreesOfNoUse) {
  std::vector<Vec3> points;
  List t;
  for (int i = 0; i < 27; ++i) points.push_back({1. * i, 0, 0}), t.push_back(i);
  try {
    lagrange_curve(points, t);
    FAIL();
  } catch (const FieldError& error) {
    EXPECT_STREQ(error.what(), "a polynomial through 27 points has degree 26, above 25");
  }
}

}  // namespace
}  // namespace lekalo::geometry::lagrange_curve_test
