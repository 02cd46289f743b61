// Error metrics against hand calculation; SSIM against its definition summed directly over the window in long double.
#include "render/image/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lekalo::render::metrics_test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

Image plane(int width, int height, const std::vector<float>& values) {
  Image image = make_image(width, height);
  add_channel(image, "Y").values = PixelPlane<float>(values);
  return image;
}

TEST(Metrics, RmsePsnrAndMaximumByHand) {
  const Image a = plane(2, 2, {0, 0.5f, 1, 0});
  const Image b = plane(2, 2, {0, 0.25f, 1, 0.5f});
  EXPECT_DOUBLE_EQ(rmse(a, b), std::sqrt((0.0625 + 0.25) / 4));
  EXPECT_DOUBLE_EQ(psnr(0.1, 1), 20);
  EXPECT_EQ(psnr(rmse(a, a), 1), std::numeric_limits<double>::infinity());
  const ErrorStatistics statistics = pool(absolute_difference(a, b));
  EXPECT_EQ(statistics.maximum, 0.5);
  EXPECT_EQ(statistics.maximum_x, 1);
  EXPECT_EQ(statistics.maximum_y, 1);
  EXPECT_EQ(statistics.mean, 0.1875);
}

TEST(Metrics, ObjectNumbersAreComparedExactly) {
  Image a = make_image(1, 1), b = make_image(1, 1);
  add_channel(a, "id.object", PixelType::uint32).ids[0] = 4000000000u;
  add_channel(b, "id.object", PixelType::uint32).ids[0] = 4000000001u;
  EXPECT_EQ(rmse(a, b), 1);
}

TEST(Metrics, EqualInfinitiesDoNotDiffer) {
  EXPECT_EQ(rmse(plane(1, 1, {kInfinity}), plane(1, 1, {kInfinity})), 0);
  EXPECT_EQ(rmse(plane(1, 1, {kInfinity}), plane(1, 1, {1})), kInfinity);
}

TEST(Metrics, WeightedPercentilesByHand) {
  // Sum 10: running sums 1, 3, 6, 10 pass 2.5, 5 and 7.5 at 2, 3 and 4.
  const ErrorStatistics statistics = pool({4, 1, {3, 1, 4, 2}});
  EXPECT_EQ(statistics.weighted_first_quartile, 2);
  EXPECT_EQ(statistics.weighted_median, 3);
  EXPECT_EQ(statistics.weighted_third_quartile, 4);
  EXPECT_EQ(statistics.minimum, 1);
  EXPECT_EQ(statistics.mean, 2.5);
  EXPECT_EQ(pool({2, 1, {0, 0}}).weighted_median, 0);
}

TEST(Ssim, EqualIsOneAndConstantsFollowTheLuminanceTerm) {
  const std::vector<float> dark(400, 0.25f), bright(400, 0.75f);
  EXPECT_EQ(ssim(dark, dark, 20, 20, 1).mean, 1);
  // Without variance SSIM is (2 a b + C1) / (a^2 + b^2 + C1), C1 = 1e-4.
  EXPECT_NEAR(ssim(dark, bright, 20, 20, 1).mean, (2 * 0.25 * 0.75 + 1e-4) / (0.0625 + 0.5625 + 1e-4), 1e-12);
}

TEST(Ssim, IsItsDefinition) {
  constexpr int kWidth = 16, kHeight = 14;
  std::vector<float> a, b;
  unsigned state = 7;
  const auto random = [&] { return static_cast<float>((state = state * 1664525u + 1013904223u) >> 8) / 16777216.0f; };
  for (int i = 0; i < kWidth * kHeight; ++i) {
    a.push_back(random());
    b.push_back(0.7f * a.back() + 0.2f * random());
  }
  long double mean = 0;
  for (int y = 5; y < kHeight - 5; ++y) {
    for (int x = 5; x < kWidth - 5; ++x) {
      long double sum = 0, ma = 0, mb = 0, aa = 0, bb = 0, ab = 0;
      for (int pass = 0; pass < 2; ++pass) {
        for (int dy = -5; dy <= 5; ++dy) {
          for (int dx = -5; dx <= 5; ++dx) {
            const long double weight = std::exp(-static_cast<long double>(dx * dx + dy * dy) / 4.5L);
            const long double va = a[static_cast<std::size_t>((y + dy) * kWidth + x + dx)];
            const long double vb = b[static_cast<std::size_t>((y + dy) * kWidth + x + dx)];
            if (pass == 0) {
              sum += weight;
              ma += weight * va;
              mb += weight * vb;
            } else {
              aa += weight / sum * (va - ma) * (va - ma);
              bb += weight / sum * (vb - mb) * (vb - mb);
              ab += weight / sum * (va - ma) * (vb - mb);
            }
          }
        }
        if (pass == 0) ma /= sum, mb /= sum;
      }
      mean += (2 * ma * mb + 1e-4L) * (2 * ab + 9e-4L) / ((ma * ma + mb * mb + 1e-4L) * (aa + bb + 9e-4L));
    }
  }
  mean /= (kWidth - 10) * (kHeight - 10);
  EXPECT_NEAR(ssim(a, b, kWidth, kHeight, 1).mean, static_cast<double>(mean), 1e-13);
}

}  // namespace
}  // namespace lekalo::render::metrics_test
