// Certified arithmetic: the 113-bit result of every operation, on random operands and on random points of random
// intervals, lies in the interval's result; widths stay within the stated ulps; special cases as documented.
#include "geometry/numerics/interval.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "geometry/quad.h"

namespace lekalo::geometry::interval_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kSamples = 5000;

bool holds(const Interval& x, Quad q) { return Quad(x.lo) <= q && q <= Quad(x.hi); }

// Numbers of very different size: sign, exponent in [-range, range], mantissa; sometimes zero or a small integer.
class Operands {
 public:
  double number(int range) {
    const int kind = static_cast<int>(random_() % 16);
    if (kind == 0) return 0.0;
    if (kind < 3) return static_cast<int>(random_() % 9) - 4;
    return std::ldexp(uniform(-1, 1), static_cast<int>(random_() % (2 * range + 1)) - range);
  }
  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }
  Interval interval(double a, double b) {
    const double x = uniform(a, b), y = random_() % 4 == 0 ? x + std::ldexp(b - a, -40) : uniform(a, b);
    return {std::min(x, y), std::min(std::max(x, y), b)};
  }
  double point(const Interval& x) {
    const int kind = static_cast<int>(random_() % 4);
    return kind == 0 ? x.lo : kind == 1 ? x.hi : x.clamp(uniform(x.lo, x.hi));
  }

 private:
  std::mt19937_64 random_{20240611};
};

// f of a point is in f of the interval around it, and f of a point is at most `ulps` wide.
template <class F>
void check_function(const char* name, F f, double a, double b, double ulps = 24) {
  Operands operands;
  for (int i = 0; i < kSamples; ++i) {
    const Interval x = operands.interval(a, b);
    const double t = operands.point(x);
    const Quad exact = f(Quad(t));
    const Interval y = f(x), at = f(Interval(t));
    ASSERT_TRUE(holds(y, exact)) << name << " of " << t << " in [" << x.lo << ", " << x.hi << "]";
    ASSERT_TRUE(holds(at, exact)) << name << " of " << t;
    const double ulp = std::max(next_up(magnitude(at)) - magnitude(at), 0x1p-1060);
    ASSERT_LE(at.width(), ulps * ulp) << name << " of " << t;
  }
}

#define CHECK_FUNCTION(function, a, b) \
  check_function(                      \
      #function, [](const auto& x) { return function(x); }, a, b)

TEST(Interval, arithmetic_contains_the_exact_result) {
  Operands operands;
  for (const int range : {2, 60, 900}) {
    for (int i = 0; i < kSamples; ++i) {
      double p[4];
      for (double& x : p) x = operands.number(range);
      const Interval a{std::min(p[0], p[1]), std::max(p[0], p[1])}, b{std::min(p[2], p[3]), std::max(p[2], p[3])};
      const Quad x = operands.point(a), y = operands.point(b);
      ASSERT_TRUE(holds(a + b, x + y));
      ASSERT_TRUE(holds(a - b, x - y));
      ASSERT_TRUE(holds(a * b, x * y));
      ASSERT_TRUE(holds(sqr(a), x * x));
      if (!(y == Quad(0))) {
        ASSERT_TRUE(holds(a / b, x / y));
      }
      ASSERT_TRUE(holds(abs(a), abs(x)));
      ASSERT_TRUE(holds(min(a, b), min(x, y)));
      ASSERT_TRUE(holds(max(a, b), max(x, y)));
      ASSERT_TRUE(holds(floor(a), floor(x)));
      ASSERT_TRUE(holds(ceil(a), ceil(x)));
      ASSERT_TRUE(holds(round(a), round(x)));
      ASSERT_TRUE(holds(hypot(a, b), hypot(x, y)));
    }
  }
}

TEST(Interval, arithmetic_of_numbers_is_two_ulps_wide) {
  const Interval third = Interval(1.0) / 3.0;
  EXPECT_TRUE(third.contains(1.0 / 3.0));
  EXPECT_LE(third.width(), 0x1p-53);
  const Interval sum = Interval(0.1) + 0.2;
  EXPECT_EQ(sum.lo, std::nextafter(0.1 + 0.2, -1.0));
  EXPECT_EQ(sum.hi, std::nextafter(0.1 + 0.2, 1.0));
}

TEST(Interval, functions_contain_the_exact_result) {
  using std::cbrt;
  CHECK_FUNCTION(sqrt, 0, 1e3);
  CHECK_FUNCTION(cbrt, -1e3, 1e3);
  CHECK_FUNCTION(exp, -700, 700);
  CHECK_FUNCTION(log, 1e-300, 10);
  CHECK_FUNCTION(log, 0.5, 2);
  CHECK_FUNCTION(log10, 1e-5, 1e5);
  CHECK_FUNCTION(sin, -7, 7);
  CHECK_FUNCTION(sin, -1e4, 1e4);
  CHECK_FUNCTION(cos, -7, 7);
  CHECK_FUNCTION(cos, 1e9, 1e9 + 10);
  CHECK_FUNCTION(tan, -1.5, 1.5);
  CHECK_FUNCTION(tan, -20, 20);
  CHECK_FUNCTION(asin, -1, 1);
  CHECK_FUNCTION(acos, -1, 1);
  CHECK_FUNCTION(atan, -30, 30);
  CHECK_FUNCTION(sinh, -5, 5);
  CHECK_FUNCTION(cosh, -5, 5);
  CHECK_FUNCTION(tanh, -5, 5);
  CHECK_FUNCTION(asinh, -50, 50);
  CHECK_FUNCTION(acosh, 1, 50);
  CHECK_FUNCTION(atanh, -0.999, 0.999);
}

TEST(Interval, powers_contain_the_exact_result) {
  for (const int n : {-5, -2, -1, 1, 2, 3, 4, 7, 20, 63}) {
    check_function(
        "integer power",
        [n](const auto& x) {
          if constexpr (std::is_same_v<std::decay_t<decltype(x)>, Quad>)
            return pow(x, Quad(n));
          else
            return pow(x, n);
        },
        n > 0 ? -3 : 0.1, 3, 260);
  }
  for (const double p : {-2.5, -0.5, 0.5, 1.0 / 3, 1.5, 17.25, 100.0, 101.0}) {
    check_function(
        "real power", [p](const auto& x) { return pow(x, std::decay_t<decltype(x)>(p)); }, 0.01, 3);
  }
  EXPECT_TRUE(pow(Interval(-2, 3), 101.0).contains(Interval(-0x1p101, 0x1p101)));
  Operands operands;
  for (int i = 0; i < kSamples; ++i) {
    const Interval x = operands.interval(0, 4), y = operands.interval(-3, 3);
    const double s = operands.point(x), t = operands.point(y);
    if (s > 0) {
      ASSERT_TRUE(holds(pow(x, y), pow(Quad(s), Quad(t))));
    }
  }
}

TEST(Interval, angle_of_a_point_contains_the_exact_result) {
  Operands operands;
  for (int i = 0; i < kSamples; ++i) {
    const Interval x = operands.interval(-1, 1), y = operands.interval(-1, 1);
    const Interval angle = atan2(y, x);
    ASSERT_TRUE(holds(angle, atan2(Quad(operands.point(y)), Quad(operands.point(x)))));
  }
  EXPECT_LT(atan2(Interval(0, 1), Interval(-2, -1)).width(), 0.8);    // above the cut, touching it
  EXPECT_GE(atan2(Interval(-1, 1), Interval(-2, -1)).width(), 6.28);  // across the cut
  EXPECT_LE(atan2(Interval(-1, 1), Interval(0, 1)).hi, 1.5708);
}

TEST(Interval, sine_and_cosine_reach_their_extrema) {
  constexpr double kPi = std::numbers::pi;
  EXPECT_EQ(sin(Interval(0, 2)).hi, 1.0);
  EXPECT_NEAR(sin(Interval(0, 2)).lo, 0.0, 1e-15);
  EXPECT_EQ(cos(Interval(3, 4)).lo, -1.0);
  EXPECT_EQ(cos(Interval(-1, 1)).hi, 1.0);
  EXPECT_LT(sin(Interval(0, 1.57)).hi, 1.0);  // just before the extremum
  EXPECT_EQ(sin(Interval(0, kPi)), Interval(sin(Interval(0, kPi)).lo, 1.0));
  EXPECT_EQ(cos(Interval(0, 7)), Interval(-1, 1));
  EXPECT_EQ(sin(Interval(1e300)), Interval(-1, 1));
}

TEST(Interval, special_cases_are_as_documented) {
  const Interval entire = Interval::entire();
  EXPECT_EQ(Interval(1, 2) / Interval(-1, 1), entire);
  EXPECT_EQ(Interval(1, 2) / Interval(0.0), entire);
  EXPECT_EQ((Interval(1, 2) / Interval(0, 4)).hi, kInfinity);
  EXPECT_NEAR((Interval(1, 2) / Interval(0, 4)).lo, 0.25, 1e-16);
  EXPECT_EQ((Interval(1, 2) / Interval(-4, 0)).lo, -kInfinity);
  EXPECT_EQ(tan(Interval(1, 2)), entire);
  EXPECT_EQ(sqrt(Interval(-4, 4)).lo, 0.0);
  EXPECT_NEAR(sqrt(Interval(-4, 4)).hi, 2.0, 1e-15);
  for (const Interval& outside :
       {sqrt(Interval(-2, -1)), log(Interval(-2, -1)), log(Interval(0.0)), asin(Interval(2, 3)), acos(Interval(2, 3)),
        acosh(Interval(0, 0.5)), atanh(Interval(2, 3))}) {
    EXPECT_EQ(outside, entire);
  }
  EXPECT_EQ(asin(Interval(0, 5)).lo, 0.0);
  EXPECT_EQ(log(Interval(0, 1)).hi, 0.0);
  EXPECT_EQ(log(Interval(0, 1)).lo, -kInfinity);
  const Interval infinite = Interval(1e308) * 10.0;
  EXPECT_EQ(infinite.hi, kInfinity);
  EXPECT_TRUE(std::isfinite(infinite.lo));
  EXPECT_FALSE((infinite - infinite).lo != (infinite - infinite).lo);  // no NaN
  EXPECT_EQ(Interval(0.0) * entire, Interval(0.0));
}

TEST(Interval, zero_stays_zero_and_signs_are_kept) {
  EXPECT_EQ(Interval(1.0) - 1.0, Interval(0.0));
  EXPECT_EQ(sin(Interval(0.0)), Interval(0.0));
  EXPECT_EQ((Interval(0, 1) * Interval(0, 1)).lo, 0.0);
  EXPECT_EQ((Interval(0, 1) * Interval(-1, 0)).hi, 0.0);
  EXPECT_EQ(sqr(Interval(-1, 2)).lo, 0.0);
  const Interval tiny = Interval(1e-200) * 1e-200;  // underflows, but not to zero
  EXPECT_EQ(tiny.lo, 0.0);
  EXPECT_GT(tiny.hi, 0.0);
}

TEST(Interval, ranges) {
  constexpr Interval a{1, 3}, b{2, 5};
  EXPECT_EQ(hull(a, b), Interval(1, 5));
  EXPECT_EQ(intersect(a, b), Interval(2, 3));
  EXPECT_TRUE(intersects(a, b));
  EXPECT_TRUE(intersect(a, Interval(4, 5)).empty());
  EXPECT_FALSE(intersects(a, Interval(4, 5)));
  EXPECT_EQ(a.middle(), 2.0);
  EXPECT_EQ(Interval(-1e308, 1.5e308).middle(), 0.25e308);
  EXPECT_EQ(a.clamp(9), 3.0);
  EXPECT_TRUE(a.contains(Interval(1, 2)));
  EXPECT_EQ(magnitude(Interval(-4, 3)), 4.0);
  EXPECT_EQ(mignitude(Interval(-4, 3)), 0.0);
  EXPECT_EQ(mignitude(Interval(-4, -3)), 3.0);
  EXPECT_EQ(less(a, Interval(4, 5)), Truth::yes);
  EXPECT_EQ(less(a, b), Truth::unknown);
  EXPECT_EQ(less(b, Interval(0, 2)), Truth::no);
}

}  // namespace
}  // namespace lekalo::geometry::interval_test
