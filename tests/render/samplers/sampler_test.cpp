// Stratification by counting, uniformity by moments.
#include "render/samplers/sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace lekalo::render::sampler_test {
namespace {

TEST(StratifiedSampler, OneSampleIsTheCentre) {
  EXPECT_EQ(make_stratified_sampler(1, 5)->pixel_position(17, 4, 0), Vec2(0.5));
}

TEST(StratifiedSampler, EveryRowStripAndEveryCellHoldsOneSample) {
  for (const int n : {4, 16, 64, 256}) {
    const SamplerPtr sampler = make_stratified_sampler(n, 0);
    const int side = static_cast<int>(std::sqrt(n));
    std::set<int> cells, rows, columns;
    for (int s = 0; s < n; ++s) {
      const Vec2 p = sampler->pixel_position(3, 9, s);
      ASSERT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
      cells.insert(static_cast<int>(p.x * side) + side * static_cast<int>(p.y * side));
      rows.insert(static_cast<int>(p.y * n));
      columns.insert(static_cast<int>(p.x * n));
    }
    EXPECT_EQ(static_cast<int>(cells.size()), n);
    EXPECT_EQ(static_cast<int>(rows.size()), n);
    EXPECT_EQ(static_cast<int>(columns.size()), n);
  }
}

TEST(StratifiedSampler, AnyNumberOfSamplesFillsTheRows) {
  for (const int n : {2, 3, 7, 11, 30}) {
    const SamplerPtr sampler = make_stratified_sampler(n, 1);
    std::set<int> rows;
    for (int s = 0; s < n; ++s) rows.insert(static_cast<int>(sampler->pixel_position(0, 0, s).y * n));
    EXPECT_EQ(static_cast<int>(rows.size()), n);
  }
}

TEST(StratifiedSampler, PixelsAndSeedsDiffer) {
  const SamplerPtr a = make_stratified_sampler(16, 0), b = make_stratified_sampler(16, 1);
  EXPECT_EQ(a->pixel_position(1, 2, 3), make_stratified_sampler(16, 0)->pixel_position(1, 2, 3));
  EXPECT_NE(a->pixel_position(1, 2, 3), a->pixel_position(2, 1, 3));
  EXPECT_NE(a->pixel_position(1, 2, 3), b->pixel_position(1, 2, 3));
}

TEST(SampleStream, IsUniformAndUncorrelatedBetweenNeighbours) {
  // 10,000 first numbers of as many streams: mean 1/2, variance 1/12, correlation of neighbours 0, within 4 deviations.
  double sum = 0, square = 0, product = 0, last = 0.5;
  const int n = 100;
  for (uint32_t y = 0; y < n; ++y)
    for (uint32_t x = 0; x < n; ++x) {
      const double r = SampleStream(x, y, 0, 1, 0).next_pair().x;
      ASSERT_TRUE(r >= 0 && r < 1);
      sum += r - 0.5;
      square += (r - 0.5) * (r - 0.5);
      product += (r - 0.5) * (last - 0.5);
      last = r;
    }
  const double count = n * n;
  EXPECT_LT(std::fabs(sum / count), 4 * std::sqrt(1 / 12.0 / count));
  EXPECT_NEAR(square / count, 1 / 12.0, 4 * std::sqrt(1 / 180.0 / count));
  EXPECT_LT(std::fabs(product / count), 4 / 12.0 / std::sqrt(count));
}

TEST(SampleStream, DimensionsDiffer) {
  SampleStream stream(1, 2, 3, 4, 5);
  const Vec2 first = stream.next_pair(), second = stream.next_pair();
  EXPECT_NE(first.x, first.y);
  EXPECT_NE(first, second);
  EXPECT_EQ(SampleStream(1, 2, 3, 4, 5).next_pair(), first);
}

TEST(SampleStream, SobolPairsFillEveryCellOfEqualArea) {
  // A (0, m, 2)-net: each way of cutting the square into 2^m equal boxes by halving leaves one point in each.
  constexpr int kM = 8, kN = 1 << kM;
  for (int wide = 0; wide <= kM; ++wide) {
    std::set<int> cells;
    for (int i = 0; i < kN; ++i) {
      SampleStream stream(3, 4, i, kN, 5);
      stream.skip_pairs(2);
      const Vec2 p = stream.next_sobol_pair();
      cells.insert((static_cast<int>(p.x * (1 << wide)) << (kM - wide)) + static_cast<int>(p.y * (1 << (kM - wide))));
    }
    EXPECT_EQ(static_cast<int>(cells.size()), kN) << wide;
  }
}

// How many of the 2^m boxes that cut the square in 2^wide columns hold a pair of the streams of a square of pixels.
int boxes_met(uint32_t x0, uint32_t y0, uint32_t side, uint32_t count, int m, int wide) {
  std::set<int> cells;
  for (uint32_t y = y0; y < y0 + side; ++y)
    for (uint32_t x = x0; x < x0 + side; ++x)
      for (uint32_t i = 0; i < count; ++i) {
        SampleStream stream = SampleStream::in_picture(x, y, i, count, 5);
        stream.skip_pairs(3);
        const Vec2 p = stream.next_sobol_pair();
        cells.insert((static_cast<int>(p.x * (1 << wide)) << (m - wide)) + static_cast<int>(p.y * (1 << (m - wide))));
      }
  return static_cast<int>(cells.size());
}

TEST(SampleStream, SquaresOfPixelsAreEvenTogether) {
  // Whole stretches of a sequence, a (0, m, 2)-net each: one pixel, 2 x 2, 4 x 4 and 8 x 8 pixels of 4 samples.
  for (const int steps : {0, 1, 2, 3}) {
    const uint32_t side = 1u << steps;
    const int m = 2 + 2 * steps;
    for (int wide = 0; wide <= m; ++wide)
      EXPECT_EQ(boxes_met(3 * side, 37 * side, side, 4, m, wide), 1 << m) << side << ' ' << wide;
  }
  // Squares out of step are not whole stretches.
  EXPECT_LT(boxes_met(3, 5, 4, 4, 6, 3), 64);
}

TEST(SampleStream, SharedSequenceLeavesOtherPairsAsTheyAre) {
  SampleStream apart(300, 70, 3, 8, 5), shared = SampleStream::in_picture(300, 70, 3, 8, 5);
  EXPECT_EQ(apart.next_pair(), shared.next_pair());
  EXPECT_NE(apart.next_sobol_pair(), shared.next_sobol_pair());
  EXPECT_EQ(apart.next_pair(), shared.next_pair());
}

TEST(StratifiedSampler, SamplesBeyondItsOwnAreDrawnApart) {
  const SamplerPtr sampler = make_stratified_sampler(8, 5);
  EXPECT_EQ(sampler->stream(3, 4, 7).next_sobol_pair(), SampleStream::in_picture(3, 4, 7, 8, 5).next_sobol_pair());
  EXPECT_EQ(sampler->stream(3, 4, 8).next_sobol_pair(), SampleStream(3, 4, 8, 8, 5).next_sobol_pair());
}

TEST(SampleStream, SkippedPairsAreThoseNotDrawn) {
  SampleStream drawn(1, 2, 3, 4, 5), skipped(1, 2, 3, 4, 5);
  drawn.next_pair(), drawn.next_sobol_pair();
  skipped.skip_pairs(2);
  EXPECT_EQ(drawn.next_sobol_pair(), skipped.next_sobol_pair());
}

}  // namespace
}  // namespace lekalo::render::sampler_test
