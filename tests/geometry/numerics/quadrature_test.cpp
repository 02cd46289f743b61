// Quadrature against integrals known in closed form; the stated error must bound the true one.
#include "geometry/numerics/quadrature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lekalo::geometry::quadrature_test {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(GaussLegendre, integrates_polynomials_exactly) {
  for (const int n : {1, 2, 3, 5, 10, 33, 64, 200}) {
    const GaussRule rule = gauss_legendre(n);
    for (int degree = 0; degree <= 2 * n - 1; degree += n < 10 ? 1 : 13) {
      double sum = 0;
      for (int i = 0; i < n; ++i) sum += rule.weights[i] * std::pow(rule.nodes[i], degree);
      EXPECT_NEAR(sum, degree % 2 ? 0.0 : 2.0 / (degree + 1), 4e-15) << n << ' ' << degree;
    }
    for (int i = 1; i < n; ++i) EXPECT_LT(rule.nodes[i - 1], rule.nodes[i]);
  }
  // Abramowitz, Stegun 1964, table 25.4, n = 5.
  const GaussRule five = gauss_legendre(5);
  EXPECT_DOUBLE_EQ(five.nodes[4], 0.906179845938663992797626878299);
  EXPECT_DOUBLE_EQ(five.weights[4], 0.236926885056189087514264040720);
  EXPECT_EQ(five.nodes[2], 0.0);
}

TEST(Quadrature, fifteen_points_are_exact_to_degree_22) {
  const Integral integral =
      integrate([](double x, std::span<double> f) { f[0] = 23 * std::pow(x, 22); }, 1, Interval(0, 1), {1, 0});
  EXPECT_EQ(integral.evaluations, 15);
  EXPECT_NEAR(integral.value[0], 1.0, 1e-15);
}

struct Known {
  const char* name;
  double (*f)(double);
  Interval range;
  double integral;
};

TEST(Quadrature, known_integrals) {
  const Known cases[] = {
      {"sin", [](double x) { return std::sin(x); }, {0, kPi}, 2},
      {"sin over a period", [](double x) { return std::sin(x); }, {0, 2 * kPi}, 0},
      {"bell", [](double x) { return std::exp(-x * x); }, {-10, 10}, std::sqrt(kPi)},
      {"runge", [](double x) { return 1 / (1 + 25 * x * x); }, {-1, 1}, 0.4 * std::atan(5.0)},
      {"root", [](double x) { return std::sqrt(x); }, {0, 1}, 2.0 / 3},
      {"logarithm", [](double x) { return std::log(x); }, {0, 1}, -1},
      {"corner", [](double x) { return std::fabs(x - 1 / 3.0); }, {0, 1}, 5.0 / 18},
      {"step", [](double x) { return x < kPi / 10 ? 0.0 : 1.0; }, {0, 1}, 1 - kPi / 10},
      {"wave", [](double x) { return std::cos(200 * x); }, {0, 1}, std::sin(200.0) / 200},
  };
  for (const Known& known : cases) {
    const Integral integral =
        integrate([&](double x, std::span<double> f) { f[0] = known.f(x); }, 1, known.range, {1e-13, 1e-11});
    EXPECT_TRUE(integral.converged) << known.name;
    EXPECT_NEAR(integral.value[0], known.integral, std::max(integral.error[0], 1e-15)) << known.name;
    EXPECT_LE(integral.error[0], 1e-10) << known.name;
  }
}

TEST(Quadrature, breaks_make_corners_cheap) {
  const double breaks[] = {0, 1 / 3.0, 1};
  const Integral integral =
      integrate([](double x, std::span<double> f) { f[0] = std::fabs(x - 1 / 3.0); }, 1, breaks, {0, 1e-13});
  EXPECT_EQ(integral.evaluations, 30);
  EXPECT_NEAR(integral.value[0], 5.0 / 18, 1e-16);
}

// A torus of radii 2 and 0.5: area 4 pi^2 a b, volume 2 pi^2 a b^2, centroid 0, z moment of inertia of the solid
// volume (a^2 + 3/4 b^2): integrated over the surface by the divergence theorem, all at once.
TEST(Quadrature, mass_properties_of_a_torus) {
  constexpr double a = 2, b = 0.5;
  const auto f = [](double u, double v, std::span<double> out) {
    const double r = a + b * std::cos(v), x = r * std::cos(u), y = r * std::sin(u), z = b * std::sin(v);
    const double da = r * b;  // element of area; the unit normal is (cos v cos u, cos v sin u, sin v)
    const double nx = std::cos(v) * std::cos(u), ny = std::cos(v) * std::sin(u), nz = std::sin(v);
    out[0] = da;
    out[1] = (x * nx + y * ny + z * nz) / 3 * da;
    out[2] = z * z / 2 * nz * da;
    out[3] = (x * x * x * nx + y * y * y * ny) / 3 * da;
  };
  const Integral integral = integrate(f, 4, Interval(0, 2 * kPi), Interval(0, 2 * kPi));
  const double volume = 2 * kPi * kPi * a * b * b;
  const double expected[] = {4 * kPi * kPi * a * b, volume, 0, volume * (a * a + 0.75 * b * b)};
  EXPECT_TRUE(integral.converged);
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR(integral.value[k], expected[k], integral.error[k]) << k;
    EXPECT_LE(integral.error[k], 1e-11 * std::max(expected[k], 1.0)) << k;
  }
}

TEST(Quadrature, rectangles_split_where_it_is_needed) {
  // A hemisphere's area over its projection's u, a singular derivative at one edge only.
  const auto f = [](double u, double v, std::span<double> out) { out[0] = std::exp(v) / std::sqrt(1 + 1e-6 - u); };
  const Integral integral = integrate(f, 1, Interval(0, 1), Interval(0, 1), {0, 1e-9});
  EXPECT_TRUE(integral.converged);
  const double exact = (std::exp(1.0) - 1) * 2 * (std::sqrt(1 + 1e-6) - std::sqrt(1e-6));
  EXPECT_NEAR(integral.value[0], exact, integral.error[0]);
  EXPECT_LT(integral.evaluations, 225 * 40);  // only u is split
}

// An integrand that is nothing but the rounding of a factor ends where that is all its error, whatever its own size.
TEST(Quadrature, known_noise_is_not_refined) {
  const auto f = [](double x, std::span<double> values) {
    const double far = 1e6 + 1e-3 * std::sin(12345 * x);
    values[0] = std::exp(x);
    values[1] = values[0] * (far - 1e6 - 1e-3 * std::sin(12345 * x));
  };
  const IntegrationGoal goal{0, 1e-12, 200000, 1e-9};
  const Integral found = integrate(f, 2, Interval(0, 1), goal);
  EXPECT_TRUE(found.converged);
  EXPECT_LT(found.evaluations, 100);
  EXPECT_NEAR(found.value[0], std::exp(1.0) - 1, 1e-14);
  EXPECT_NEAR(found.value[1], 0, found.error[1]);
}

TEST(Quadrature, says_when_it_fails) {
  const Integral spent =
      integrate([](double x, std::span<double> f) { f[0] = std::sin(1 / x); }, 1, Interval(1e-9, 1), {0, 1e-14, 5000});
  EXPECT_FALSE(spent.converged);
  EXPECT_LT(spent.evaluations, 5100);
  EXPECT_NEAR(spent.value[0], 0.504067061906928, spent.error[0]);  // the limit for a lower end of 0
  const Integral nan = integrate([](double x, std::span<double> f) { f[0] = std::sqrt(x); }, 1, Interval(-1, 1));
  EXPECT_FALSE(nan.converged);
  EXPECT_TRUE(std::isnan(nan.value[0]));
}

// The integral of |x - a|^p over [-1, 1] is ((1 + a)^(p + 1) + (1 - a)^(p + 1)) / (p + 1): exactly at a = 0, where the
// places are told apart down to nothing, and elsewhere as far as the rounding of x - a lets it.
TEST(Quadrature, integrates_over_places_where_the_integrand_is_infinite) {
  for (const double a : {0.0, 0.3, -0.71})
    for (const double p : {-0.5, -2.0 / 3, -0.75}) {
      const Integral integral = integrate([&](double x, std::span<double> f) { f[0] = std::pow(std::abs(x - a), p); },
                                          1, Interval(-1, 1), {0, 1e-12});
      const double exact = (std::pow(1 + a, p + 1) + std::pow(1 - a, p + 1)) / (p + 1);
      EXPECT_NEAR(integral.value[0], exact, integral.error[0]) << a << " " << p;
      EXPECT_LE(integral.error[0], (a == 0 ? 1e-11 : 1e-3) * exact) << a << " " << p;
      EXPECT_EQ(integral.converged, a == 0) << a << " " << p;
      EXPECT_LT(integral.evaluations, 20000);
    }
  for (const double a : {0.0, 0.3}) {
    const Integral none = integrate([&](double x, std::span<double> f) { f[0] = 1 / sqr(x - a); }, 1, Interval(-1, 1));
    EXPECT_FALSE(none.converged) << a;
    EXPECT_FALSE(none.error[0] < 0.1 * none.value[0]) << a;
  }
  // Over [-1, 1]^2 the integral of |x|^(-1/2) is 8.
  const Integral wall = integrate([](double x, double, std::span<double> f) { f[0] = 1 / std::sqrt(std::abs(x)); }, 1,
                                  Interval(-1, 1), Interval(-1, 1), {0, 1e-9});
  EXPECT_TRUE(wall.converged);
  EXPECT_NEAR(wall.value[0], 8, wall.error[0]);
}

}  // namespace
}  // namespace lekalo::geometry::quadrature_test
