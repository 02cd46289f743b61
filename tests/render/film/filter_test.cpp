// Reconstruction filters: partition of unity where the filter promises it, known values.
#include "render/film/filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace lekalo::render::filter_test {
namespace {

double sum_over_pixels(const Filter& filter, double place) {
  double sum = 0;
  for (int i = -10; i <= 10; ++i) sum += filter.weight(place - i - 0.5);
  return sum;
}

TEST(Filter, BoxAndMitchellSumToOneEverywhere) {
  const auto box = make_filter("box", 0), mitchell = make_filter("mitchell", 0);
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(sum_over_pixels(*box, i / 100.0), 1);
    EXPECT_NEAR(sum_over_pixels(*mitchell, i / 100.0), 1, 2e-14);  // its cubics have terms up to 48
  }
}

TEST(Filter, MitchellHasItsPublishedValues) {
  const auto mitchell = make_filter("mitchell", 0);
  EXPECT_NEAR(mitchell->weight(0), 8.0 / 9, 1e-15);
  EXPECT_NEAR(mitchell->weight(1), 1.0 / 18, 1e-15);
  EXPECT_LT(mitchell->weight(1.5), 0);
  EXPECT_EQ(mitchell->weight(2), 0);
  EXPECT_NEAR(make_filter("mitchell", 3)->weight(1.5), 1.0 / 18, 1e-15);
}

TEST(Filter, GaussianFallsContinuouslyToZero) {
  const auto gaussian = make_filter("gaussian", 0);
  EXPECT_EQ(gaussian->radius(), 1.5);
  EXPECT_NEAR(gaussian->weight(0), 1 - std::exp(-4.5), 1e-15);
  EXPECT_NEAR(gaussian->weight(1.5 - 1e-9), 0, 1e-9);
  EXPECT_EQ(gaussian->weight(-0.7), gaussian->weight(0.7));
}

TEST(Filter, UnknownNamesAndRadiiAreRefused) {
  EXPECT_THROW(make_filter("lanczos", 0), std::invalid_argument);
  EXPECT_THROW(make_filter("box", 0.3), std::invalid_argument);
  EXPECT_THROW(make_filter("box", 17), std::invalid_argument);
}

}  // namespace
}  // namespace lekalo::render::filter_test
