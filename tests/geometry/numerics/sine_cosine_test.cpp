// Sine and cosine against those of long double.
#include "geometry/numerics/sine_cosine.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace lekalo::geometry::sine_cosine_test {
namespace {

double ulp(long double value) {
  const double size = static_cast<double>(std::abs(value));
  return std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
}

void expect_within_an_ulp(double x) {
  double sine, cosine;
  sine_and_cosine(x, sine, cosine);
  const long double s = std::sin(static_cast<long double>(x)), c = std::cos(static_cast<long double>(x));
  ASSERT_LE(std::abs(static_cast<double>(sine - s)), ulp(s)) << std::hexfloat << x;
  ASSERT_LE(std::abs(static_cast<double>(cosine - c)), ulp(c)) << std::hexfloat << x;
}

TEST(SineCosine, WithinAnUlp) {
  std::mt19937_64 random(1);
  for (const double size : {1e-300, 1e-8, 0.1, 1.0, 3.2, 30.0, 1000.0, 1e6})
    for (int i = 0; i < 200000; ++i) expect_within_an_ulp(std::uniform_real_distribution(-size, size)(random));
}

// The doubles about each multiple of pi/4: where one of the two is small, and where the quarters meet.
TEST(SineCosine, WithinAnUlpBesideMultiplesOfAnEighthTurn) {
  constexpr long double kPi = 3.14159265358979323846264338327950288L;
  for (int k = -1400; k <= 1400; ++k) {
    double x = static_cast<double>(k * (kPi / 4));
    for (int i = 0; i < 8; ++i) x = std::nextafter(x, -2000.0);
    for (int i = 0; i < 16; ++i, x = std::nextafter(x, 2000.0)) expect_within_an_ulp(x);
  }
}

TEST(SineCosine, OfZeroAndOfNoNumber) {
  double sine, cosine;
  for (const double zero : {0.0, -0.0}) {
    sine_and_cosine(zero, sine, cosine);
    EXPECT_EQ(sine, 0);
    EXPECT_EQ(std::signbit(sine), std::signbit(zero));
    EXPECT_EQ(cosine, 1);
  }
  for (const double x : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    sine_and_cosine(x, sine, cosine);
    EXPECT_TRUE(std::isnan(sine) && std::isnan(cosine));
  }
}

}  // namespace
}  // namespace lekalo::geometry::sine_cosine_test
