#include "geometry/numerics/special_functions.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/numerics/jet2.h"
#include "geometry/numerics/quadrature.h"

namespace lekalo::geometry::special_functions_test {
namespace {

// Composite Gauss in long double.
template <class F>
long double integral(F f, long double x) {
  static const GaussRule rule = gauss_legendre(20);
  const int cells = 8 + static_cast<int>(4 * x * x);
  long double sum = 0;
  for (int c = 0; c < cells; ++c)
    for (size_t k = 0; k < rule.nodes.size(); ++k) {
      const long double h = x / cells, v = h * (c + 0.5L + 0.5L * rule.nodes[k]);
      sum += 0.5L * h * rule.weights[k] * f(v);
    }
  return sum;
}

TEST(SpecialFunctions, fresnel_integrals_by_quadrature) {
  constexpr long double kHalfPi = 1.570796326794896619231321691639751442L;
  for (const double x : {0.0, 1e-8, 0.3, 1.0, 2.0, 2.49, 2.5, 2.51, 3.5, 6.0, 9.7}) {
    EXPECT_NEAR(fresnel_s(x), static_cast<double>(integral([](long double v) { return sinl(kHalfPi * v * v); }, x)),
                1e-15);
    EXPECT_NEAR(fresnel_c(x), static_cast<double>(integral([](long double v) { return cosl(kHalfPi * v * v); }, x)),
                1e-15);
    EXPECT_EQ(fresnel_s(-x), -fresnel_s(x));
  }
  // 30 digits: 0.49999624737061, 0.489389674442194 (mpmath)
  EXPECT_NEAR(fresnel_c(30), 0.49999624737061, 2e-15);
  EXPECT_NEAR(fresnel_s(30), 0.489389674442194, 2e-15);
  EXPECT_EQ(fresnel_c(1e18), 0.5);
}

// f' of jets against differences of f, and intervals against samples.
TEST(SpecialFunctions, jets_and_intervals) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-5, 5), width(-6, 1);
  const auto check = [&](auto function) {
    for (int k = 0; k < 300; ++k) {
      const double x = uniform(random), w = std::pow(10, width(random));
      const Interval box(x, x + w);
      const Jet<Interval, 2> over = function(Jet<Interval, 2>::variable(box));
      const Interval value = function(box);
      for (int i = 0; i <= 20; ++i) {
        const double at = box.clamp(x + w * i / 20);
        const Jet<double, 2> jet = function(Jet<double, 2>::variable(at));
        EXPECT_TRUE(value.contains(function(at)));
        for (int n = 0; n <= 2; ++n) EXPECT_TRUE(over.c[n].contains(jet.c[n])) << n << " at " << at;
      }
      const double h = 1e-4;
      const Jet<double, 2> jet = function(Jet<double, 2>::variable(x));
      EXPECT_NEAR(jet.c[0], function(x), 1e-15);
      EXPECT_NEAR(jet.c[1], (function(x + h) - function(x - h)) / (2 * h), 1e-5);
      if (w < 0.1) {
        EXPECT_LE(value.width(), 1.2 * w + 1e-13);
        EXPECT_LE(over.c[1].width(), 20 * w + 1e-13);
      }
    }
  };
  check([](const auto& x) {
    using std::erf;
    return erf(x);
  });
  check([](const auto& x) { return fresnel_s(x); });
  check([](const auto& x) { return fresnel_c(x); });
  check([](const auto& x) { return sinc(x); });
}

TEST(SpecialFunctions, sinc_derivatives_at_both_forms) {
  // Series and quotient meet at 1.
  for (const double x : {0.9999999, 1.0000001, -1.0000001, 0.0, 2.5}) {
    const auto jet = sinc(Jet<double, 6>::variable(x));
    for (int n = 0; n <= 6; ++n) {
      const long double exact =
          integral([&](long double s) { return powl(s, n) * cosl(s * x + n * 1.570796326794896619L); }, 1);
      EXPECT_NEAR(jet.derivative(n), static_cast<double>(exact), 1e-15) << n << " at " << x;
    }
  }
}

TEST(SpecialFunctions, whole_numbers) {
  EXPECT_EQ(factorial(5), 120);
  EXPECT_TRUE(std::isnan(factorial(-1)) && std::isnan(factorial(2.5)));
  EXPECT_EQ(binom(5.0, 2), 10);
  EXPECT_EQ(binom(2.0, 5), 0);
  EXPECT_DOUBLE_EQ(binom(0.5, 2), -0.125);
  EXPECT_TRUE(std::isnan(binom(5.0, 1.5)));
  const auto jet = sinc(Jet2<double, 2>::u_variable(0.5) * Jet2<double, 2>::v_variable(2.0));
  EXPECT_NEAR(jet.derivative(1, 0), 2 * (std::cos(1) - std::sin(1)), 1e-15);
}

}  // namespace
}  // namespace lekalo::geometry::special_functions_test
