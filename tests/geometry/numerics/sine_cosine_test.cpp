// Sine and cosine against 113 bits.
#include "geometry/numerics/sine_cosine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "geometry/quad.h"
#include "support/tier.h"

namespace lekalo::geometry {
namespace {

// In units of the last place of the true value.
double error(double value, Quad truth) {
  const double size = std::fabs(static_cast<double>(truth));
  const double unit = size - std::nextafter(size, 0);
  return static_cast<double>(abs(value - truth)) / unit;
}

double worst_error(double x) {
  double sine, cosine;
  sine_and_cosine(x, sine, cosine);
  return std::max(error(sine, sin(Quad(x))), error(cosine, cos(Quad(x))));
}

TEST(SineAndCosine, AreRightToTheLastPlace) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  const Quad quarter = 2 * atan(Quad(1));
  double worst = 0;
  for (int i = 0; i < tests::tier_count(10000000, 200000); ++i) {
    const double size = std::exp2(20 * unit(random));
    worst = std::max(worst, worst_error(size * unit(random)));
    // Beside multiples of pi / 2, where one of the two is small.
    const double turns = std::floor(size * std::fabs(unit(random)));
    worst = std::max(worst, worst_error(static_cast<double>(Quad(turns + 1) * quarter)));
    worst = std::max(worst, worst_error((turns + 0.5) * 1.5707963267948966));
  }
  EXPECT_LE(worst, 0.9);
  tests::report_figure("sine_and_cosine_worst_ulp", worst);
}

TEST(SineAndCosine, AreTheLibrarysWhereNumbersAreHugeOrNone) {
  for (const double x : {1e7, -1e300}) {
    double sine, cosine;
    sine_and_cosine(x, sine, cosine);
    EXPECT_EQ(sine, std::sin(x));
    EXPECT_EQ(cosine, std::cos(x));
  }
  double sine, cosine;
  sine_and_cosine(0, sine, cosine);
  EXPECT_EQ(sine, 0);
  EXPECT_EQ(cosine, 1);
  sine_and_cosine(std::numeric_limits<double>::quiet_NaN(), sine, cosine);
  EXPECT_TRUE(std::isnan(sine) && std::isnan(cosine));
}

}  // namespace
}  // namespace lekalo::geometry
