#include "geometry/curves/splines/bspline_basis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "geometry/curves/spline_oracle.h"
#include "geometry/curves/splines/spline_axis.h"

namespace lekalo::geometry::bspline_basis_test {
namespace {

const std::vector<double> kNine = {0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 6, 6, 6};

std::vector<double> values(int degree, const std::vector<double>& knots, double t, int derivative = 0) {
  std::vector<double> result(degree + 1);
  basis_derivative(degree, knots, find_span(degree, knots, t), t, derivative, result);
  return result;
}

void expect_near(const std::vector<double>& a, const std::vector<double>& b, double tolerance = 1e-15) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], tolerance) << i;
}

// Golovanov 2016, 2.8: values at 2.5 and 0.5; uniform cubic at 1.5; the dashed curve of figure 2.9.1 at 12.
TEST(BsplineBasis, HasTheBooksValues) {
  expect_near(values(3, kNine, 2.5), {1. / 48, 23. / 48, 23. / 48, 1. / 48});
  expect_near(values(3, kNine, 0.5), {1. / 8, 19. / 32, 25. / 96, 1. / 48});
  const std::vector<double> uneven = {0, 1, 11, 12, 22, 23, 33, 34, 44, 45, 55};
  const std::vector<double> at12 = values(3, uneven, 12);
  expect_near({at12[0], at12[1], at12[2]}, {0.432900432900433, 0.55952380952381, 0.00757575757575758}, 1e-14);
  std::vector<double> uniform;
  for (int i = 0; i <= 10; ++i) uniform.push_back(i);
  EXPECT_NEAR(values(3, uniform, 4.5)[1], 23. / 48, 1e-15);
}

// Coursework 2024, 1.4.3: rows of derivatives of the quadratic on {0,0,0,1/4,1,1,1} at 1/2.
TEST(BsplineBasis, DerivativesAreScaledToTheLastFunction) {
  const std::vector<double> knots = {0, 0, 0, 0.25, 1, 1, 1};
  expect_near(values(2, knots, 0.5), {1. / 3, 5. / 9, 1. / 9});
  expect_near(values(2, knots, 0.5, 1), {-4. / 3, 4. / 9, 8. / 9}, 1e-15);
  expect_near(values(2, knots, 0.5, 2), {8. / 3, -56. / 9, 32. / 9}, 1e-14);
  expect_near(values(2, knots, 0.5, 3), {0, 0, 0});
}

TEST(BsplineBasis, SpansAreHalfOpenAndTheLastIsClosed) {
  EXPECT_EQ(find_span(3, kNine, 0), 3);
  EXPECT_EQ(find_span(3, kNine, 1), 4);
  EXPECT_EQ(find_span(3, kNine, std::nextafter(1.0, 0.0)), 3);
  EXPECT_EQ(find_span(3, kNine, 6), 8);
  EXPECT_EQ(find_span(3, kNine, -5), 3);
  EXPECT_EQ(find_span(3, kNine, 50), 8);
  const std::vector<double> repeated = {0, 0, 0, 1, 1, 2, 2, 2};
  EXPECT_EQ(find_span(2, repeated, 1), 4);
  const std::vector<double> inside = {0, 1, 1, 1, 2, 3, 3, 3, 4};  // domain [1, 3] with empty spans at both ends
  EXPECT_EQ(find_span(2, inside, 1), 3);
  EXPECT_EQ(find_span(2, inside, 3), 4);
}

// Partition of unity and vanishing sums of derivatives, any degree, random knots with multiplicities; single functions
// against the recursion in 113 bits.
TEST(BsplineBasis, SumsToOneAndItsDerivativesToZero) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int sample = 0; sample < 300; ++sample) {
    const int degree = 1 + sample % 9;
    std::vector<double> knots{-uniform(random)};
    while (knots.size() < 2u * degree + 8) {
      const bool repeat = uniform(random) < 0.3 && std::count(knots.begin(), knots.end(), knots.back()) <= degree;
      knots.push_back(knots.back() + (repeat ? 0 : std::pow(10, 2 * uniform(random) - 1)));
    }
    if (!(knots[degree] < knots[knots.size() - 1 - degree])) continue;
    const Interval domain(knots[degree], knots[knots.size() - 1 - degree]);
    const double t = domain.clamp(domain.lo + uniform(random) * domain.width());
    const int span = find_span(degree, knots, t);
    for (int k = 0; k <= 3; ++k) {
      const std::vector<double> d = values(degree, knots, t, k);
      double sum = 0, terms = 0;
      for (int j = 0; j <= degree; ++j) {
        sum += d[j];
        terms += oracle::absolute_derivative(k, degree, knots, span - degree + j, span, t);
      }
      EXPECT_NEAR(sum, k == 0 ? 1 : 0, 1e-15 * (degree + 1) * (k == 0 ? 1 : terms));
    }
    const std::vector<double> n = values(degree, knots, t);
    for (int j = 0; j <= degree; ++j) {
      const double exact = static_cast<double>(oracle::basis(degree, knots, span - degree + j, span, Quad(t)));
      EXPECT_GE(n[j], 0);
      EXPECT_NEAR(n[j], exact, 8e-16 * degree * exact);
    }
  }
}

// Integral of N_3 over its support is (t_7 - t_3)/4 = 1 on unit knots (Golovanov 2016, 2.8.16): Simpson is exact for
// cubics.
TEST(BsplineBasis, IntegralOfAFunctionIsItsSupportOverDegreePlusOne) {
  std::vector<double> knots;
  for (int i = 0; i <= 10; ++i) knots.push_back(i);
  double integral = 0;
  for (int span = 3; span < 7; ++span)
    for (const auto& [x, weight] : {std::pair(0.0, 1. / 6), {0.5, 4. / 6}, {1.0, 1. / 6}}) {
      double n[4];
      basis_derivative(3, knots, span, span + x, 0, n);
      integral += weight * n[3 - (span - 3)];
    }
  EXPECT_NEAR(integral, 1, 1e-15);
}

}  // namespace
}  // namespace lekalo::geometry::bspline_basis_test
