// Jets against known series, against the same recurrences and closed derivatives in 113 bits, and (over intervals) as
// certified enclosures of derivatives on a range.
#include "geometry/numerics/jet.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <random>

#include "geometry/numerics/gradient.h"
#include "geometry/numerics/jet3.h"
#include "geometry/numerics/triple.h"
#include "geometry/quad.h"

namespace lekalo::geometry::jet_test {
namespace {

// A function of one number type for all.
#define FUNCTION(name, expression)   \
  struct name {                      \
    template <class T>               \
    T operator()(const T& x) const { \
      using namespace std;           \
      return expression;             \
    }                                \
  }

FUNCTION(Exp, exp(x));
FUNCTION(Log, log(x));
FUNCTION(Log10, log10(x));
FUNCTION(Sqrt, sqrt(x));
FUNCTION(Cbrt, cbrt(x));
FUNCTION(Sin, sin(x));
FUNCTION(Cos, cos(x));
FUNCTION(Tan, tan(x));
FUNCTION(Asin, asin(x));
FUNCTION(Acos, acos(x));
FUNCTION(Atan, atan(x));
FUNCTION(Sinh, sinh(x));
FUNCTION(Cosh, cosh(x));
FUNCTION(Tanh, tanh(x));
FUNCTION(Asinh, asinh(x));
FUNCTION(Acosh, acosh(x));
FUNCTION(Atanh, atanh(x));
FUNCTION(Square, sqr(x));
FUNCTION(Reciprocal, 1 / x);
FUNCTION(Cube, pow(x, 3));
FUNCTION(RealPower, pow(x, 2.5));
FUNCTION(InversePower, pow(x, -4));
FUNCTION(PowerOfTwo, pow(T(2), x));
FUNCTION(Angle, atan2(sin(x), cos(x) + 2));
FUNCTION(Length, hypot(x, 2 - x));
FUNCTION(Mixed, exp(-x* x) * sin(3 * x) / (2 + cos(x)) - abs(x - 10) + max(x, x - 1));

// Central differences in 113 bits: an independent reference for the first two derivatives. With h = 2^-26 the
// truncation error is about h^2 = 2e-16, the rounding error 1e-34 / h^2 = 5e-19.
template <class F>
void check_against_differences(F f, double x) {
  const Quad h = Quad(0x1p-26), t = x;
  const Quad first = (f(t + h) - f(t - h)) / (h * 2), second = (f(t + h) - f(t) * 2 + f(t - h)) / (h * h);
  const auto jet = f(Jet<double, 6>::variable(x));
  EXPECT_NEAR(jet.value(), double(f(t)), 1e-15 * (1 + std::fabs(jet.value())));
  EXPECT_NEAR(jet.derivative(1), double(first), 4e-14 * (1 + std::fabs(jet.derivative(3)))) << typeid(F).name() << x;
  EXPECT_NEAR(jet.derivative(2), double(second), 4e-14 * (1 + std::fabs(jet.derivative(4)))) << typeid(F).name() << x;
}

// All orders in double against 113 bits, and the double result inside the enclosure on an interval about x.
template <class F>
void check_against_quad(F f, double x) {
  const auto rounded = f(Jet<double, 6>::variable(x));
  const auto exact = f(Jet<Quad, 6>::variable(x));
  const auto point = f(Jet<Interval, 6>::variable(Interval(x)));
  const auto range = f(Jet<Interval, 6>::variable(Interval(x - 1e-3, x + 1e-3)));
  double scale = 0;
  for (int k = 0; k <= 6; ++k) scale = std::max(scale, std::fabs(rounded.c[k]));
  for (int k = 0; k <= 6; ++k) {
    EXPECT_NEAR(rounded.c[k], double(exact.c[k]), 64 * 0x1p-52 * scale) << typeid(F).name() << " order " << k;
    EXPECT_TRUE(Quad(point.c[k].lo) <= exact.c[k] && exact.c[k] <= Quad(point.c[k].hi)) << typeid(F).name() << k;
    EXPECT_TRUE(range.c[k].contains(point.c[k])) << typeid(F).name() << k;
  }
}

template <class... F>
void check_all(double from, double to) {
  std::mt19937 random(7);
  for (int i = 0; i < 20; ++i) {
    const double x = std::uniform_real_distribution<double>(from, to)(random);
    (check_against_differences(F{}, x), ...);
    (check_against_quad(F{}, x), ...);
  }
}

TEST(Jet, functions_agree_with_differences_and_with_113_bits) {
  check_all<Exp, Sin, Cos, Atan, Sinh, Cosh, Tanh, Asinh, Square, Cube, PowerOfTwo, Angle, Length, Mixed>(-2, 2);
  check_all<Log, Log10, Sqrt, Cbrt, Reciprocal, RealPower, InversePower>(0.5, 4);
  check_all<Tan, Asin, Acos, Atanh>(-0.8, 0.8);
  check_all<Acosh>(1.5, 4);
}

TEST(Jet, known_series) {
  const auto t = Jet<double, 6>::variable(0.0);
  const double exponential[] = {1, 1, 1.0 / 2, 1.0 / 6, 1.0 / 24, 1.0 / 120, 1.0 / 720};
  const double tangent[] = {0, 1, 0, 1.0 / 3, 0, 2.0 / 15, 0};
  const double arcsine[] = {0, 1, 0, 1.0 / 6, 0, 3.0 / 40, 0};
  const double catalan[] = {1, 1, 2, 5, 14, 42, 132};
  for (int k = 0; k <= 6; ++k) {
    EXPECT_DOUBLE_EQ(exp(t).c[k], exponential[k]);
    EXPECT_NEAR(tan(t).c[k], tangent[k], 1e-16);
    EXPECT_NEAR(asin(t).c[k], arcsine[k], 1e-16);
    EXPECT_DOUBLE_EQ((1 / (1 - t)).c[k], 1.0);
    if (k < 6) {
      EXPECT_NEAR(((1 - sqrt(1 - 4 * t)) / 2).c[k + 1], catalan[k], 1e-13);
    }
  }
  EXPECT_DOUBLE_EQ(exp(t).derivative(6), 1.0);
}

TEST(Jet, integer_powers_are_exact_at_zero) {
  const auto t = Jet<double, 4>::variable(0.0);
  EXPECT_EQ(pow(t, 3).c[3], 1.0);
  EXPECT_EQ(pow(t, 3).c[0], 0.0);
  EXPECT_EQ(pow(t, 2.0).c[2], 1.0);
  EXPECT_EQ(pow(t, Jet<double, 4>(2)).c[2], 1.0);
  EXPECT_EQ(pow(-1 + t, 3).derivative(1), 3.0);
}

TEST(Jet, singular_functions_of_constants_are_plain_numbers) {
  const Jet<double, 3> zero(0), one(1);
  for (int k = 1; k <= 3; ++k) {
    EXPECT_EQ(sqrt(zero).c[k], 0.0);
    EXPECT_EQ(cbrt(zero).c[k], 0.0);
    EXPECT_EQ(asin(one).c[k], 0.0);
    EXPECT_EQ(acosh(one).c[k], 0.0);
    EXPECT_EQ(pow(zero, 0.5).c[k], 0.0);
    EXPECT_EQ(atan2(zero, zero).c[k], 0.0);
  }
  EXPECT_TRUE(std::isinf(sqrt(Jet<double, 3>::variable(0.0)).c[1]));
}

// By hand: t^1.5 has the derivatives 0, 0, +inf, -inf; sqrt(t^2 (4 + t)) = t sqrt(4 + t) on the side t > 0;
// cbrt(8 t^3 + t^4) = 2 t + t^2 / 12 + ...
TEST(Jet, roots_of_zero_have_the_derivatives_that_exist) {
  const double infinity = std::numeric_limits<double>::infinity();
  const auto t = Jet<double, 3>::variable(0.0);
  for (const auto& root : {pow(t, 1.5), pow(abs(t), 1.5), pow(t, Jet<double, 3>(1.5))}) {
    EXPECT_EQ(root.c[0], 0.0);
    EXPECT_EQ(root.c[1], 0.0);
    EXPECT_EQ(root.c[2], infinity);
    EXPECT_EQ(root.c[3], -infinity);
  }
  const auto product = sqrt(t * t * (4 + t));
  EXPECT_EQ(product.c[0], 0.0);
  EXPECT_EQ(product.c[1], 2.0);
  EXPECT_EQ(product.c[2], 0.25);
  const auto cubic = cbrt(t * t * t * (8 + t));
  EXPECT_EQ(cubic.c[1], 2.0);
  EXPECT_TRUE(std::isnan(cubic.c[2]));  // it depends on t^4
  EXPECT_EQ(sqrt(sqr(sqr(Jet<double, 4>::variable(0.0)))).c[2], 1.0);
  EXPECT_EQ(pow(sqr(t), 0.75).c[1], 0.0);
  EXPECT_EQ(pow(t, -0.5).c[0], infinity);
}

// r^3 = (x^2 + y^2)^1.5 has the second derivatives 3 (2 x^2 + y^2) / r, 3 x y / r, 3 (x^2 + 2 y^2) / r, which are zero
// at the origin; those of r do not exist there.
TEST(Jet2, powers_of_zero_have_the_derivatives_that_exist) {
  using J = Jet2<double, 4>;
  const auto powers = [](const J& x, const J& y) {
    return std::array{pow(sqr(x) + sqr(y), 1.5), pow(sqr(x) + sqr(y), 2.5), sqrt(sqr(x) + sqr(y))};
  };
  const auto zero = powers(J::u_variable(0.0), J::v_variable(0.0));
  for (int k = 0; k < J::kCount; ++k) {
    if (J::degree(k) < 3) {
      EXPECT_EQ(zero[0].c[k], 0.0) << k;
    }
    EXPECT_EQ(zero[1].c[k], 0.0) << k;
    if (k > 0) {
      EXPECT_TRUE(std::isnan(zero[2].c[k])) << k;
    }
  }
  const double x = 0.3, y = -0.4, r = 0.5;
  const auto there = powers(J::u_variable(x), J::v_variable(y))[0];
  EXPECT_NEAR(there.derivative(1, 0), 3 * r * x, 1e-15);
  EXPECT_NEAR(there.derivative(2, 0), 3 * (2 * x * x + y * y) / r, 1e-15);
  EXPECT_NEAR(there.derivative(1, 1), 3 * x * y / r, 1e-15);
  const auto slopes = pow(sqr(Gradient<double>::variable(0.0, 0)) + sqr(Gradient<double>::variable(0.0, 1)), 1.5);
  for (int k = 0; k < 4; ++k) EXPECT_EQ(slopes.c[k], 0.0);
}

// The first derivative of |x|^1.5, 1.5 sqrt|x|, and those of r^3, 3 r x, over [-h, h]: bounded, and no wider than twice
// what they are; the derivatives of x^0.3 to an ulp's width of the interval.
TEST(Jet, over_intervals_powers_that_come_to_zero_have_bounds) {
  const double h = 0.01;
  const auto x = Jet2<Interval, 2>::u_variable({-h, h}), y = Jet2<Interval, 2>::v_variable({-h, h});
  const Interval slope = pow(abs(x), 1.5).c[1], slant = pow(sqr(x) + sqr(y), 1.5).c[1];
  EXPECT_TRUE(slope.contains(Interval(-1.5 * std::sqrt(h), 1.5 * std::sqrt(h))));
  EXPECT_LE(slope.width(), 1.0001 * 3 * std::sqrt(h));
  EXPECT_TRUE(slant.contains(Interval(-3 * std::sqrt(2) * h * h, 3 * std::sqrt(2) * h * h)));
  EXPECT_LE(slant.width(), 2 * 6 * std::sqrt(2) * h * h);
  for (const Interval t : {Interval(1e-3, 1), Interval(2, 3)}) {
    const auto power = pow(Jet<Interval, 2>::variable(t), 0.3), root = cbrt(Jet<Interval, 2>::variable(t));
    EXPECT_NEAR(power.c[1].lo, 0.3 * std::pow(t.hi, -0.7), 1e-12 * power.c[1].hi);
    EXPECT_NEAR(power.c[1].hi, 0.3 * std::pow(t.lo, -0.7), 1e-12 * power.c[1].hi);
    EXPECT_NEAR(root.c[2].lo, -std::pow(t.lo, -5.0 / 3) / 9, -1e-12 * root.c[2].lo);
    EXPECT_NEAR(root.c[2].hi, -std::pow(t.hi, -5.0 / 3) / 9, -1e-12 * root.c[2].lo);
  }
}

TEST(Jet, piecewise_functions_take_the_branch_of_the_value) {
  const auto t = Jet<double, 2>::variable(-2.0);
  EXPECT_EQ(abs(t).derivative(1), -1.0);
  EXPECT_EQ(max(t, 3 * t).derivative(1), 1.0);
  EXPECT_EQ(min(t, 3 * t).derivative(1), 3.0);
  EXPECT_EQ(floor(t * 1.2).value(), -3.0);
  EXPECT_EQ(floor(t * 1.2).derivative(1), 0.0);
  EXPECT_EQ(sign(t).value(), -1.0);
  const auto x = Jet<Interval, 1>::variable(Interval(-1, 2));
  EXPECT_EQ(abs(x).value(), Interval(0, 2));
  EXPECT_EQ(abs(x).c[1], Interval(-1, 1));  // undecided: the hull of both slopes
}

// The patch f(u, v) = exp(u v) sin(u + 2 v) / (1 + u^2), with factors over every number type.
struct Patch {
  template <class T>
  T operator()(const T& u, const T& v) const {
    using std::exp;
    using std::sin;
    using std::sqrt;
    return exp(u * v) * sin(u + 2 * v) / sqrt(1 + sqr(u)) + pow(u - v, 3) * atan2(v, u + 3) + hypot(u, v) * cbrt(u + 4);
  }
};

// The directional derivatives of every direction determine all partial ones: f(u + t a, v + t b) as a jet in t has the
// coefficients sum over i + j = k of c_ij a^i b^j.
TEST(Jet2, agrees_with_jets_along_lines) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int sample = 0; sample < 50; ++sample) {
    const double u = number(random), v = number(random), a = number(random), b = number(random);
    const auto both = Patch{}(Jet2<double, 4>::u_variable(u), Jet2<double, 4>::v_variable(v));
    const auto t = Jet<Quad, 4>::variable(0.0);
    const auto line = Patch{}(Quad(u) + Quad(a) * t, Quad(v) + Quad(b) * t);
    for (int k = 0; k <= 4; ++k) {
      double sum = 0, size = 1;
      for (int j = 0; j <= k; ++j) {
        const double term = both.c[Jet2<double, 4>::index(k - j, j)] * std::pow(a, k - j) * std::pow(b, j);
        sum += term;
        size += std::fabs(term);
      }
      EXPECT_NEAR(sum, double(line.c[k]), 1e-12 * size / std::hypot(u, v)) << k;
    }
  }
}

TEST(Jet2, partial_derivatives_of_polynomials_are_exact) {
  const auto u = Jet2<double, 4>::u_variable(2), v = Jet2<double, 4>::v_variable(3);
  const auto f = u * u * v + sqr(v) * sqr(u) - 5 * u / 2;  // u^2 v + u^2 v^2 - 5u/2
  EXPECT_EQ(f.value(), 4 * 3 + 9 * 4 - 5);
  EXPECT_EQ(f.derivative(1, 0), 2 * 2 * 3 + 2 * 2 * 9 - 2.5);
  EXPECT_EQ(f.derivative(0, 1), 4 + 2 * 4 * 3);
  EXPECT_EQ(f.derivative(1, 1), 4 + 4 * 2 * 3);
  EXPECT_EQ(f.derivative(2, 1), 2 + 4 * 3);
  EXPECT_EQ(f.derivative(2, 2), 4);
  EXPECT_EQ(f.derivative(0, 3), 0);
}

// A function of three variables that uses all rules: products, quotients, compositions, arguments of one variable.
struct Field {
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    using namespace std;
    return sin(x) * cos(y) + exp(x * z - y) / (2 + sqr(z)) + pow(hypot(y, z + 2), 3) + atan2(x + y, 3 + z) -
           sqrt(x + 4);
  }
};

TEST(Jet3, agrees_with_jets_along_lines) {
  using Space = Jet3<double, 3>;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int n = 0; n < 50; ++n) {
    const double p[3] = {unit(random), unit(random), unit(random)}, d[3] = {unit(random), unit(random), unit(random)};
    const auto all = Field{}(Space::variable(p[0], 0), Space::variable(p[1], 1), Space::variable(p[2], 2));
    Jet<double, 3> at[3];
    for (int axis = 0; axis < 3; ++axis) at[axis].c[0] = p[axis], at[axis].c[1] = d[axis];
    const auto line = Field{}(at[0], at[1], at[2]);
    for (int degree = 0; degree <= 3; ++degree) {
      double sum = 0, scale = 1;
      for (int i = 0; i <= degree; ++i)
        for (int j = 0; i + j <= degree; ++j) {
          const int k = degree - i - j;
          const double term = all.c[Space::index(i, j, k)] * std::pow(d[0], i) * std::pow(d[1], j) * std::pow(d[2], k);
          sum += term;
          scale += std::fabs(term);
        }
      EXPECT_NEAR(sum, line.c[degree], 1e-14 * scale) << degree;
    }
  }
}

TEST(Jet2, over_intervals_encloses_the_derivatives_on_the_box) {
  const Interval u(0.2, 0.3), v(0.5, 0.55);
  const auto box = Patch{}(Jet2<Interval, 2>::u_variable(u), Jet2<Interval, 2>::v_variable(v));
  std::mt19937 random(5);
  for (int sample = 0; sample < 1000; ++sample) {
    const double s = std::uniform_real_distribution<double>(u.lo, u.hi)(random);
    const double t = std::uniform_real_distribution<double>(v.lo, v.hi)(random);
    const auto at = Patch{}(Jet2<Quad, 2>::u_variable(s), Jet2<Quad, 2>::v_variable(t));
    for (int k = 0; k < 6; ++k) ASSERT_TRUE(Quad(box.c[k].lo) <= at.c[k] && at.c[k] <= Quad(box.c[k].hi)) << k;
  }
  EXPECT_LT(box.c[0].width(), 1.0);
}

TEST(Triple, mixes_number_types) {
  const Triple<double> x{1, 0, 0}, y{0, 1, 0};
  const auto t = Jet<double, 2>::variable(0.5);
  const Triple<Jet<double, 2>> circle = cos(t) * x + sin(t) * y;
  const auto along = cross(x, y);
  EXPECT_EQ(along, (Triple<double>{0, 0, 1}));
  EXPECT_DOUBLE_EQ(dot(circle, circle).value(), 1.0);
  EXPECT_NEAR(dot(circle, circle).derivative(1), 0.0, 1e-16);
  EXPECT_DOUBLE_EQ(length(circle * 2.0).value(), 2.0);
  EXPECT_DOUBLE_EQ((circle / 2).y.derivative(1), std::cos(0.5) / 2);
}

}  // namespace
}  // namespace lekalo::geometry::jet_test
