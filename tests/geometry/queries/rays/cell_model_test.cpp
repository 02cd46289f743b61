// What cells keep of their bounds in few bits.
#include "geometry/queries/rays/cell_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/tier.h"

namespace lekalo::geometry::cell_model_test {
namespace {

TEST(HalfFloat, BoundsFromAboveAndBelow) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> mantissa(-1, 1), exponent(-37, 37);
  for (int i = 0; i < tests::tier_count(1000000); ++i) {
    const double value = mantissa(random) * std::pow(10.0, exponent(random));
    const double above = HalfFloat::above(value), below = HalfFloat::below(value);
    ASSERT_GE(above, value);
    ASSERT_LE(below, value);
    // One part in 2^7 apart, where floats have all their digits.
    if (std::abs(value) > 1e-36) {
      ASSERT_LE(above - below, std::abs(value) / 127) << value;
    }
  }
}

TEST(HalfFloat, KeepsWhatItHasAndGoesToInfinity) {
  for (const double value : {0.0, 1.0, -1.0, 0.5, -1.5, 1.0 + 1.0 / 128, 96.0, kInfinity, -kInfinity}) {
    EXPECT_EQ(double(HalfFloat::above(value)), value);
    EXPECT_EQ(double(HalfFloat::below(value)), value);
  }
  EXPECT_EQ(double(HalfFloat::above(1 + 1e-15)), 1 + 1.0 / 128);
  EXPECT_EQ(double(HalfFloat::below(-1 - 1e-15)), -1 - 1.0 / 128);
  EXPECT_EQ(double(HalfFloat::above(3.4e38)), kInfinity);
  EXPECT_EQ(double(HalfFloat::above(1e300)), kInfinity);
  EXPECT_EQ(double(HalfFloat::below(-1e300)), -kInfinity);
  EXPECT_GT(double(HalfFloat::above(1e-300)), 0);
}

TEST(PatchCell, KeepsItsPlaceExactly) {
  const std::vector<Vec4> points{{0, 0, 0, 1}, {0, 1, 0, 1}, {1, 0, 0, 1}, {1, 1, 1, 1}};
  const PatchView patch{points.data(), 1, 1};
  std::mt19937_64 random(2);
  for (int i = 0; i < 1000; ++i) {
    CellPlace place;
    for (int depth = static_cast<int>(random() % 10); depth > 0; --depth) {
      const bool along_x = random() % 2 == 0;
      double &h = along_x ? place.hx : place.hy, &at = along_x ? place.x : place.y;
      h *= 0.5;
      at += random() % 2 == 0 ? h : -h;
    }
    const CellPlace kept = PatchCell(patch, model_of(patch), place).place();
    ASSERT_EQ(kept.x, place.x);
    ASSERT_EQ(kept.y, place.y);
    ASSERT_EQ(kept.hx, place.hx);
    ASSERT_EQ(kept.hy, place.hy);
  }
}

}  // namespace
}  // namespace lekalo::geometry::cell_model_test
