// Majorants against the derivatives themselves: jets at random places of a box, in random pairs of directions.
#include "geometry/numerics/majorant.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/vectors.h"

namespace lekalo::geometry::majorant_test {
namespace {

double binomial(int n, int k) { return k == 0 ? 1 : binomial(n - 1, k - 1) * n / k; }

// F takes x, y, z of any kind of number. Every order must be bounded, and some by less than `loosest` times the
// largest.
template <class F>
void expect_bounds(F f, const Vec3& center, const Vec3& half, double loosest) {
  const auto variable = [&](int k) {
    return Majorant<4>::variable({center[k] - half[k], center[k] + half[k]}, half[k]);
  };
  const Majorant<4> bounds = f(variable(0), variable(1), variable(2));
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> side(-1, 1);
  const auto anywhere = [&] { return half * Vec3(side(random), side(random), side(random)); };
  const auto corner = [&] { return half * Vec3(side(random) < 0 ? -1 : 1, side(random) < 0 ? -1 : 1, 1); };
  double largest[5] = {};
  for (int n = 0; n < 20000; ++n) {
    const Vec3 p = center + anywhere(), w = n % 2 ? corner() : anywhere(), v = n % 3 ? corner() : anywhere();
    using Pair = Jet2<double, 4>;
    const auto along = [&](int k) {
      Pair r(p[k]);
      r.c[Pair::index(1, 0)] = w[k];
      r.c[Pair::index(0, 1)] = v[k];
      return r;
    };
    const Pair at = f(along(0), along(1), along(2));
    for (int i = 0; i <= 4; ++i)
      for (int j = 0; i + j <= 4; ++j) {
        const double bound = binomial(i + j, i) * magnitude(bounds.c[i + j]), size = std::abs(at.c[Pair::index(i, j)]);
        ASSERT_LE(size, bound) << i << j;
        if (j == 0) largest[i] = std::max(largest[i], size);
      }
  }
  for (int k = 0; k <= 4; ++k) EXPECT_LE(magnitude(bounds.c[k]), loosest * largest[k]) << k;
}

TEST(Majorant, BoundsAllDerivatives) {
  const Vec3 center(0.3, -0.7, 1.1), half(0.1, 0.15, 0.2);
  expect_bounds([](auto x, auto y, auto z) { return sin(x) * cos(y) + sin(y) * cos(z) + sin(z) * cos(x); }, center,
                half, 3);
  expect_bounds([](auto x, auto y, auto z) { return exp(-sqr(x) - sqr(y)) * cos(3 * z); }, center, half, 10);
  expect_bounds([](auto x, auto y, auto z) { return 1 / (2 + x * y) + z / (x + 2.0); }, center, half, 20);
  expect_bounds([](auto x, auto y, auto z) { return sqrt(4 + x * z) * log(3 + y); }, center, half, 20);
  expect_bounds([](auto x, auto y, auto z) { return pow(x, 3) * sqr(y) - atan(x - z); }, center, half, 20);
}

// The fourth coefficient of x^4 is the fourth power of the half side.
TEST(Majorant, IsSharpForPowers) {
  const auto x = Majorant<4>::variable({-1, 1}, 0.5);
  EXPECT_NEAR(magnitude(sqr(sqr(x)).c[4]), 0.0625, 1e-12);
}

TEST(Majorant, HasNoBoundAtAPole) {
  const auto x = Majorant<4>::variable({-1, 1}, 1);
  EXPECT_FALSE(std::isfinite(magnitude((1 / x).c[4])));
}

}  // namespace
}  // namespace lekalo::geometry::majorant_test
