// Noise by what is known of it: zeros on its lattice, no jumps, no direction, mean zero; and the seed.
#include "render/textures/noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lekalo::render::noise_test {
namespace {

using geometry::Vec3;

TEST(GradientNoise, IsZeroOnItsLattice) {
  for (int i = -3; i <= 3; ++i) EXPECT_EQ(gradient_noise({1.0 * i, 2.0 - i, 5.0 * i}, 7), 0);
}

TEST(GradientNoise, IsSmoothAndStaysWithinItsBounds) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-50, 50);
  double sum = 0, most = 0;
  constexpr int kCount = 20000;
  for (int i = 0; i < kCount; ++i) {
    const Vec3 p(place(random), place(random), place(random));
    const double n = gradient_noise(p, 1);
    sum += n;
    most = std::max(most, std::fabs(n));
    EXPECT_LT(std::fabs(gradient_noise(p + Vec3(1e-6), 1) - n), 1e-5);
  }
  EXPECT_LE(most, 1);
  EXPECT_GT(most, 0.6);
  EXPECT_NEAR(sum / kCount, 0, 0.01);
}

TEST(GradientNoise, HasASlopeThatDoesNotJumpBetweenCells) {
  const double h = 1e-5;
  for (const double y : {0.3, 0.71}) {
    const auto at = [&](double x) { return gradient_noise({x, y, 0.45}, 5); };
    EXPECT_NEAR((at(2) - at(2 - h)) / h, (at(2 + h) - at(2)) / h, 1e-3);
  }
}

TEST(FractalNoise, OfOneOctaveIsTheNoiseAndOtherSeedsAreOthers) {
  const Vec3 p(0.3, 1.7, -2.2);
  EXPECT_NE(fractal_noise(p, 1, 1), 0);
  EXPECT_NE(fractal_noise(p, 1, 1), fractal_noise(p, 1, 2));
  EXPECT_EQ(fractal_noise(p, 5, 4), fractal_noise(p, 5, 4));
  EXPECT_LE(std::fabs(fractal_noise(p, 12, 4)), 1);
}

TEST(GradientNoise, FarAwayIsANumber) {
  EXPECT_EQ(gradient_noise(Vec3(1e300), 0), 0);
  EXPECT_EQ(gradient_noise(Vec3(NAN), 0), 0);
}

}  // namespace
}  // namespace lekalo::render::noise_test
