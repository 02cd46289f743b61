// Roots of polynomials constructed from their roots: coefficients are formed in 113 bits; where they are exact in
// double the roots must come back to their conditioning, and every count must be right.
#include "geometry/numerics/polynomial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "geometry/quad.h"

namespace lekalo::geometry::polynomial_test {
namespace {

// Coefficients of leading * (x - r0)(x - r1)..., rounded once.
std::vector<double> with_roots(const std::vector<Quad>& roots, Quad leading = 1) {
  std::vector<Quad> c{leading};
  for (const Quad& r : roots) {
    c.insert(c.begin(), Quad(0));
    for (std::size_t i = 0; i + 1 < c.size(); ++i) c[i] -= r * c[i + 1];
  }
  std::vector<double> result;
  for (const Quad& x : c) result.push_back(double(x));
  return result;
}

// How far the root moves when every coefficient changes by one unit roundoff: u sum |c_i x^i| / |p'(x)|.
double conditioning(const std::vector<double>& c, double x) {
  double sum = 0, slope = 0, power = 1;
  for (std::size_t i = 0; i < c.size(); ++i) {
    sum += std::fabs(c[i] * power);
    if (i + 1 < c.size()) slope += (i + 1) * c[i + 1] * power;
    power *= x;
  }
  return 0x1p-53 * sum / std::fabs(slope);
}

std::array<double, 5> quartic(const std::vector<double>& c) {
  std::array<double, 5> result{};
  std::copy(c.begin(), c.end(), result.begin());
  return result;
}

TEST(QuadraticRoots, no_cancellation) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-8, 8);
  for (int i = 0; i < 2000; ++i) {
    const double a = std::pow(10, exponent(random)), b = (i % 2 ? 1 : -1) * std::pow(10, exponent(random));
    const double c0 = a * b, c1 = -(a + b);
    const Roots<2> roots = quadratic_roots({c0, c1, 1.0});
    ASSERT_EQ(roots.size(), 2);
    // The exact roots of the rounded coefficients, in 113 bits.
    const Quad half = Quad(c1) / 2, root = sqrt(half * half - Quad(c0));
    const Quad q = half < Quad(0) ? root - half : -root - half, other = Quad(c0) / q;
    const double x = double(min(q, other)), y = double(max(q, other));
    EXPECT_NEAR(roots[0].x, x, 4 * 0x1p-52 * std::fabs(x));
    EXPECT_NEAR(roots[1].x, y, 4 * 0x1p-52 * std::fabs(y));
  }
  const Roots<2> classic = quadratic_roots({1, -1e9, 1});
  EXPECT_DOUBLE_EQ(classic[0].x, 1e-9);
  EXPECT_DOUBLE_EQ(classic[1].x, 1e9);
}

TEST(QuadraticRoots, degenerate_cases) {
  EXPECT_EQ(quadratic_roots({1, 0, 1}).size(), 0);
  EXPECT_EQ(quadratic_roots({1, 0, 0}).size(), 0);
  EXPECT_EQ(quadratic_roots({0, 0, 0}).size(), 0);
  EXPECT_EQ(quadratic_roots({NAN, 1, 1}).size(), 0);
  const Roots<2> line = quadratic_roots({-3, 2, 0});
  ASSERT_EQ(line.size(), 1);
  EXPECT_EQ(line[0].x, 1.5);
  const Roots<2> square = quadratic_roots({2.25, -3, 1});
  ASSERT_EQ(square.size(), 1);
  EXPECT_TRUE(square[0].tangent);
  EXPECT_EQ(square[0].x, 1.5);
  const Roots<2> huge = quadratic_roots({-4e300, 0, 1e300});
  ASSERT_EQ(huge.size(), 2);
  EXPECT_EQ(huge[1].x, 2.0);
  // One ulp apart: the discriminant is exact enough to tell.
  EXPECT_EQ(quadratic_roots({std::nextafter(2.25, 3), -3, 1}).size(), 0);
  EXPECT_EQ(quadratic_roots({std::nextafter(2.25, 2), -3, 1}).size(), 2);
  EXPECT_EQ(quadratic_roots({std::nextafter(2.25, 3), -3, 1}, 1e-15).size(), 1);
}

TEST(QuarticRoots, four_simple_roots_to_their_conditioning) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-3, 3);
  for (int sample = 0; sample < 5000; ++sample) {
    std::vector<double> r{number(random), number(random), number(random), number(random)};
    std::sort(r.begin(), r.end());
    double gap = 10;
    for (int i = 0; i < 3; ++i) gap = std::min(gap, r[i + 1] - r[i]);
    if (gap < 1e-3) continue;
    const std::vector<double> c = with_roots({r[0], r[1], r[2], r[3]}, number(random) * 10);
    for (const Interval& domain : {Interval::entire(), Interval(-4, 4)}) {
      const Roots<4> roots = quartic_roots(quartic(c), domain);
      ASSERT_EQ(roots.size(), 4);
      for (int i = 0; i < 4; ++i) {
        EXPECT_FALSE(roots[i].tangent);
        EXPECT_NEAR(roots[i].x, r[i], 8 * conditioning(c, r[i]) + 0x1p-51);
      }
    }
    const Roots<4> some = quartic_roots(quartic(c), {r[0] + gap / 2, r[2] + gap / 2});
    ASSERT_EQ(some.size(), 2);
    EXPECT_NEAR(some[0].x, r[1], 1e-6);
  }
}

TEST(QuarticRoots, complex_pairs_are_not_roots) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-2, 2);
  for (int sample = 0; sample < 2000; ++sample) {
    const double a = number(random), b = 1e-3 + std::fabs(number(random)), p = number(random), q = p + 0.1 + b;
    // ((x - a)^2 + b^2) (x - p) (x - q)
    const double s = a * a + b * b;
    const std::array<double, 5> c{s * p * q, -s * (p + q) - 2 * a * p * q, s + 2 * a * (p + q) + p * q,
                                  -(p + q) - 2 * a, 1};
    ASSERT_EQ(quartic_roots(c).size(), 2) << a << ' ' << b << ' ' << p << ' ' << q;
  }
}

TEST(QuarticRoots, double_roots_are_reported_as_tangent) {
  std::mt19937 random(4);
  std::uniform_int_distribution<int> number(-40, 40);
  for (int sample = 0; sample < 2000; ++sample) {
    // Multiples of 1/8: all coefficients are exact.
    double d = number(random) / 8.0, p = number(random) / 8.0, q = number(random) / 8.0;
    if (d == p || d == q || p == q) continue;
    const Roots<4> roots = quartic_roots(quartic(with_roots({d, d, p, q})));
    ASSERT_EQ(roots.size(), 3) << d << ' ' << p << ' ' << q;
    int tangents = 0;
    for (const PolynomialRoot& root : roots) {
      if (!root.tangent) continue;
      ++tangents;
      EXPECT_NEAR(root.x, d, 2e-12);
    }
    EXPECT_EQ(tangents, 1);
  }
}

// The grazing ray: (x^2 - e)(x^2 + 4) for a tangent ray displaced by e. While e is below the rounding of the
// coefficients it is a tangent, above it there are two roots or none, and never one.
TEST(QuarticRoots, grazing_roots_are_never_lost) {
  for (const double shift : {0.0, 0.7, -3.3}) {
    for (int k = 4; k <= 20; ++k) {
      const Quad e = sqrt(Quad(std::pow(10.0, -k)));
      const Roots<4> roots = quartic_roots(quartic(with_roots({Quad(shift) + e, Quad(shift) - e, 5, -6})));
      const bool told_apart = roots.size() == 4 && !roots[1].tangent;
      const bool tangent = roots.size() == 3 && roots[1].tangent;
      EXPECT_TRUE(told_apart || tangent) << shift << ' ' << k << ' ' << roots.size();
      EXPECT_TRUE(told_apart || k > 11) << shift << " " << k;
      EXPECT_NEAR(roots[1].x, shift, 1.5 * double(e) + 1e-12);
    }
  }
}

TEST(QuarticRoots, multiple_and_special) {
  const Roots<4> quadruple = quartic_roots(quartic(with_roots({0.5, 0.5, 0.5, 0.5})));
  ASSERT_EQ(quadruple.size(), 1);
  EXPECT_TRUE(quadruple[0].tangent);
  EXPECT_NEAR(quadruple[0].x, 0.5, 1e-8);
  const Roots<4> triple = quartic_roots(quartic(with_roots({0.5, 0.5, 0.5, 2})));
  ASSERT_EQ(triple.size(), 2);
  EXPECT_FALSE(triple[0].tangent);
  EXPECT_NEAR(triple[0].x, 0.5, 1e-8);
  const Roots<4> pairs = quartic_roots(quartic(with_roots({-1, -1, 3, 3})));
  ASSERT_EQ(pairs.size(), 2);
  EXPECT_TRUE(pairs[0].tangent && pairs[1].tangent);
  const Roots<4> biquadratic = quartic_roots({4, 0, -5, 0, 1});
  ASSERT_EQ(biquadratic.size(), 4);
  const double expected[] = {-2, -1, 1, 2};
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(biquadratic[i].x, expected[i], 1e-15);
  EXPECT_EQ(quartic_roots({-6, 11, -6, 1, 0}).size(), 3);  // a cubic
  EXPECT_EQ(quartic_roots({-6, 11, 0, 0, 0}).size(), 1);
  EXPECT_EQ(quartic_roots({0, 0, 0, 0, 0}).size(), 0);
  EXPECT_EQ(quartic_roots({1, INFINITY, 0, 0, 1}).size(), 0);
  const Roots<4> at_ends = quartic_roots({4, 0, -5, 0, 1}, {-1, 2});
  ASSERT_EQ(at_ends.size(), 3);
  EXPECT_EQ(at_ends[0].x, -1);
  EXPECT_EQ(at_ends[2].x, 2);
  const Roots<4> wide = quartic_roots(quartic(with_roots({-1e8, 1e-8, 1, 1e6})));
  ASSERT_EQ(wide.size(), 4);
  EXPECT_NEAR(wide[1].x, 1e-8, 1e-22);
  EXPECT_NEAR(wide[3].x, 1e6, 1e-8);
}

// Coefficients of any size, many of them zero: as many changes of sign as the signs at infinity ask for, in order.
TEST(QuarticRoots, parity_of_random_polynomials) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-2, 2);
  for (int sample = 0; sample < 5000; ++sample) {
    std::array<double, 5> c;
    for (double& x : c) {
      x = random() % 6 == 0 ? 0.0 : number(random);
      if (random() % 20 == 0) x *= std::pow(10.0, static_cast<int>(random() % 200) - 100);
    }
    int changes = 0;
    double previous = -std::numeric_limits<double>::infinity();
    for (const PolynomialRoot& root : quartic_roots(c)) {
      EXPECT_GT(root.x, previous);
      previous = root.x;
      changes += root.tangent ? 0 : 1;
    }
    EXPECT_TRUE(changes % 2 == 0 || c[4] == 0 || c[0] == 0)
        << c[0] << ' ' << c[1] << ' ' << c[2] << ' ' << c[3] << ' ' << c[4];
  }
}

TEST(CertifiedRoots, simple_roots_of_any_degree) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(0, 1);
  for (int degree = 1; degree <= 12; ++degree) {
    for (int sample = 0; sample < 20; ++sample) {
      std::vector<Quad> r;
      std::vector<double> inside;
      for (int i = 0; i < degree; ++i) {
        // Well separated: one in each slot of the double domain; half of them outside.
        const double x = 2.0 * (i + 0.2 + 0.6 * number(random)) / degree;
        r.push_back(x);
        if (x <= 1) inside.push_back(x);
      }
      const std::vector<double> c = with_roots(r);
      const std::vector<CertifiedRoot> roots = power_roots(c, {0, 1});
      ASSERT_EQ(roots.size(), inside.size()) << degree;
      for (std::size_t i = 0; i < roots.size(); ++i) {
        EXPECT_FALSE(roots[i].tangent);
        EXPECT_TRUE(roots[i].within.contains(roots[i].x));
        EXPECT_NEAR(roots[i].x, inside[i], std::ldexp(32 * degree, degree) * conditioning(c, inside[i]) + 1e-15);
      }
    }
  }
}

// The Chebyshev polynomial T_n in Bernstein form over [-1, 1]: b_j = (-1)^(n-j) C(2n, 2j) / C(n, j), roots cos((k +
// 1/2) pi / n).
TEST(CertifiedRoots, chebyshev) {
  for (const int n : {3, 8, 15, 24}) {
    std::vector<double> b;
    for (int j = 0; j <= n; ++j) {
      Quad ratio = (n - j) % 2 ? -1 : 1;
      for (int i = 1; i <= 2 * j; ++i) ratio *= Quad(2 * n + 1 - i) / i;
      for (int i = 1; i <= j; ++i) ratio *= Quad(i) / Quad(n + 1 - i);
      b.push_back(double(ratio));
    }
    const std::vector<CertifiedRoot> roots = bernstein_roots(b, {-1, 1});
    ASSERT_EQ(static_cast<int>(roots.size()), n);
    for (int k = 0; k < n; ++k) {
      const double exact = -std::cos((k + 0.5) * 3.14159265358979324 / n);
      EXPECT_NEAR(roots[k].x, exact, n < 20 ? 1e-12 : 1e-9);
      EXPECT_TRUE(roots[k].within.contains(exact) || roots[k].within.width() < 1e-14);
    }
  }
}

TEST(CertifiedRoots, double_roots_and_clusters) {
  // (x - 1/4)^2 (x - 3/4) over [0, 1]: exact coefficients.
  const std::vector<CertifiedRoot> roots = power_roots(with_roots({0.25, 0.25, 0.75}), {0, 1});
  ASSERT_EQ(roots.size(), 2u);
  EXPECT_TRUE(roots[0].tangent);
  EXPECT_TRUE(roots[0].within.contains(0.25));
  EXPECT_LT(roots[0].within.width(), 1e-6);
  EXPECT_NEAR(roots[0].x, 0.25, 1e-14);
  EXPECT_FALSE(roots[1].tangent);
  EXPECT_DOUBLE_EQ(roots[1].x, 0.75);
  // A triple root changes sign; two roots 1e-5 apart are two, 1e-12 apart one.
  const std::vector<CertifiedRoot> triple = power_roots(with_roots({0.3, 0.3, 0.3}), {0, 1});
  ASSERT_EQ(triple.size(), 1u);
  EXPECT_FALSE(triple[0].tangent);
  EXPECT_NEAR(triple[0].x, 0.3, 1e-4);
  EXPECT_TRUE(triple[0].within.contains(0.3));
  EXPECT_EQ(power_roots(with_roots({0.3, 0.30001, 0.9}), {0, 1}).size(), 3u);
  const std::vector<CertifiedRoot> close = power_roots(with_roots({0.3, Quad(0.3) + Quad(1e-12), 0.9}), {0, 1});
  ASSERT_EQ(close.size(), 2u);
  EXPECT_TRUE(close[0].tangent);
  // Almost touching, but certainly apart: (x - 1/2)^2 + 1e-9.
  EXPECT_TRUE(power_roots(std::vector<double>{0.25 + 1e-9, -1, 1}, {0, 1}).empty());
}

TEST(CertifiedRoots, ends_of_the_domain_and_degenerate_input) {
  const std::vector<CertifiedRoot> ends = power_roots(with_roots({0, 0.5, 1}), {0, 1});
  ASSERT_EQ(ends.size(), 3u);
  EXPECT_EQ(ends[0].x, 0.0);
  EXPECT_NEAR(ends[1].x, 0.5, 1e-15);
  EXPECT_NEAR(ends[2].x, 1.0, 3e-16);
  EXPECT_FALSE(ends[0].tangent || ends[1].tangent || ends[2].tangent);
  const std::vector<CertifiedRoot> touching = power_roots(with_roots({0, 0, 2}), {0, 1});
  ASSERT_EQ(touching.size(), 1u);
  EXPECT_TRUE(touching[0].tangent);
  const std::vector<CertifiedRoot> zero = bernstein_roots(std::vector<double>{0, 0, 0}, {2, 3});
  ASSERT_EQ(zero.size(), 1u);
  EXPECT_EQ(zero[0].within, Interval(2, 3));
  EXPECT_TRUE(zero[0].tangent);
  EXPECT_TRUE(bernstein_roots(std::vector<double>{}, {0, 1}).empty());
  EXPECT_TRUE(bernstein_roots(std::vector<double>{1, NAN}, {0, 1}).empty());
  EXPECT_TRUE(bernstein_roots(std::vector<double>{1}, {0, 1}).empty());
  EXPECT_TRUE(bernstein_roots(std::vector<double>{-1, 1}, Interval::entire()).empty());
  EXPECT_EQ(bernstein_roots(std::vector<double>{-1e-300, 1e-300}).size(), 1u);
  EXPECT_EQ(bernstein_roots(std::vector<double>{-1e300, 1e300}).size(), 1u);
  EXPECT_NEAR(bernstein_roots(std::vector<double>{-1, 3}, {1000, 1001})[0].x, 1000.25, 1e-12);
}

// Inexact coefficients stand for every polynomial in them: a root of any member lies in some `within`.
TEST(CertifiedRoots, interval_coefficients) {
  const std::vector<Interval> b{{-1.1, -0.9}, {-0.2, 0.3}, {0.9, 1.2}};
  const std::vector<CertifiedRoot> roots = bernstein_roots(b);
  ASSERT_FALSE(roots.empty());
  std::mt19937 random(6);
  for (int sample = 0; sample < 500; ++sample) {
    std::vector<double> member;
    for (const Interval& x : b) member.push_back(std::uniform_real_distribution<double>(x.lo, x.hi)(random));
    for (const CertifiedRoot& root : bernstein_roots(member)) {
      EXPECT_TRUE(
          std::any_of(roots.begin(), roots.end(), [&](const CertifiedRoot& r) { return r.within.contains(root.x); }));
    }
  }
}

}  // namespace
}  // namespace lekalo::geometry::polynomial_test
