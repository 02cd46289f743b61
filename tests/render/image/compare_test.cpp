// Comparisons against hand calculation and, for FLIP, the published pairs of tests/data/flip.
#include "render/image/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "render/image/exr.h"
#include "render/image/image_error.h"
#include "render/image/temporary_folder.h"
#include "support/planes.h"

namespace lekalo::render::compare_test {
namespace {

const std::filesystem::path kPairs = std::filesystem::path(LEKALO_SOURCE_DIR) / "tests/data/flip";
constexpr float kInfinity = std::numeric_limits<float>::infinity();

Image layered() {
  Image image = make_image(16, 12);
  for (const char* name :
       {"B", "G", "R", "A", "Z", "N.Z", "N.Y", "N.X", "uv.V", "uv.U", "albedo.B", "albedo.G", "albedo.R"}) {
    checks::fill(add_channel(image, name), 0.5f);
  }
  add_channel(image, "id.object", PixelType::uint32);
  find_channel(image, "Z")->values[3] = kInfinity;
  return image;
}

ComparisonResult compare(const Image& a, const Image& b, Metric metric, const std::string& layer = "") {
  return compare_images(a, b, "a.exr", "b.exr", {.metric = metric, .threshold = {}, .layer = layer});
}

TEST(Compare, FlipOfThePublishedPairs) {
  const ComparisonResult ldr =
      compare_images(kPairs / "ldr1_reference.png", kPairs / "ldr1_test.png", {.threshold = 0.2});
  EXPECT_NEAR(ldr.value, 0.112601, 1e-4);
  EXPECT_NEAR(ldr.statistics.weighted_median, 0.210875, 1e-4);
  EXPECT_EQ(ldr.exposure_count, 0);
  EXPECT_TRUE(ldr.passed);
  const ComparisonResult hdr =
      compare_images(kPairs / "hdr1_reference.exr", kPairs / "hdr1_test.exr", {.threshold = 0.05});
  EXPECT_NEAR(hdr.value, 0.092986, 1e-4);
  EXPECT_EQ(hdr.exposure_count, 4);
  EXPECT_FALSE(hdr.passed);
}

TEST(Compare, EqualPicturesPassEveryMetricWithoutThreshold) {
  const Image image = layered();
  for (const Metric metric : {Metric::flip, Metric::rmse, Metric::psnr, Metric::ssim, Metric::max}) {
    for (const char* layer : {"", "color", "normal", "depth", "uv", "albedo", "id.object", "A", "N.X"}) {
      const ComparisonResult result = compare(image, image, metric, layer);
      EXPECT_TRUE(result.passed) << metric_name(metric) << " " << layer << " " << result.value;
      EXPECT_EQ(result.statistics.maximum, 0);
    }
  }
}

TEST(Compare, ASmallDifferenceFailsEveryMetricWithoutThreshold) {
  const Image a = layered();
  Image b = a;
  for (Channel& channel : b.channels) {
    for (float& value : channel.values) value = std::isfinite(value) ? 0.498f : value;
    for (std::uint32_t& id : channel.ids) id = 3;
  }
  find_channel(b, "Z")->values[0] = 0.6f;
  for (const Metric metric : {Metric::flip, Metric::rmse, Metric::psnr, Metric::ssim, Metric::max}) {
    for (const char* layer : {"", "normal", "depth", "albedo", "id.object"}) {
      EXPECT_FALSE(compare(a, b, metric, layer).passed) << metric_name(metric) << " " << layer;
    }
  }
}

TEST(Compare, LayersAreMeasuredInTheirOwnNumbers) {
  const Image a = layered();
  Image b = a;
  find_channel(b, "Z")->values[40] = 2.0f;
  find_channel(b, "id.object")->ids[5] = 7;
  const ComparisonResult depth = compare(a, b, Metric::max, "depth");
  EXPECT_EQ(depth.value, 1.5);
  EXPECT_EQ(depth.statistics.maximum_x, 8);
  EXPECT_EQ(depth.statistics.maximum_y, 2);
  EXPECT_EQ(depth.non_finite_a, 1u);
  EXPECT_EQ(depth.non_finite_mismatches, 0u);
  EXPECT_EQ(compare(a, b, Metric::max, "id.object").value, 7);
  EXPECT_EQ(compare(a, b, Metric::max).value, 0);
  // The difference of one of 192 pixels by 1.5.
  EXPECT_DOUBLE_EQ(compare(a, b, Metric::rmse, "Z").value, std::sqrt(1.5 * 1.5 / 192));
}

TEST(Compare, NotFiniteValuesNeverPass) {
  const Image a = layered();
  Image b = a;
  find_channel(b, "R")->values[9] = std::nanf("");
  for (const auto& [metric, value] : {std::pair{Metric::max, static_cast<double>(kInfinity)},
                                      {Metric::rmse, static_cast<double>(kInfinity)},
                                      {Metric::psnr, -static_cast<double>(kInfinity)},
                                      {Metric::flip, 1.0 / 192},
                                      {Metric::ssim, 1 - 1.0 / 192}}) {
    const ComparisonResult result =
        compare_images(a, b, "a.exr", "b.exr", {.metric = metric, .threshold = larger_is_better(metric) ? -1e9 : 1e9});
    EXPECT_FALSE(result.passed) << metric_name(metric);
    if (std::isinf(value)) {
      EXPECT_EQ(result.value, value) << metric_name(metric);
    } else {
      EXPECT_NEAR(result.value, value, 1e-9) << metric_name(metric);
    }
    EXPECT_EQ(result.non_finite_b, 1u);
    EXPECT_EQ(result.non_finite_mismatches, 1u);
  }
}

TEST(Compare, TheLargestFloatsAreNumbers) {
  Image a = layered();
  for (const char* name : {"R", "G", "B"}) find_channel(a, name)->values[40] = std::numeric_limits<float>::max();
  Image b = a;
  for (const char* name : {"R", "G", "B"}) find_channel(b, name)->values[40] = -std::numeric_limits<float>::max();
  for (const Metric metric : {Metric::flip, Metric::rmse, Metric::psnr, Metric::ssim, Metric::max}) {
    const ComparisonResult same = compare(a, a, metric), other = compare(a, b, metric);
    EXPECT_TRUE(same.passed) << metric_name(metric) << " " << same.value;
    EXPECT_EQ(same.statistics.maximum, 0) << metric_name(metric);
    EXPECT_FALSE(other.passed) << metric_name(metric) << " " << other.value;
    EXPECT_GT(other.statistics.maximum, 0.1) << metric_name(metric);
    EXPECT_FALSE(std::isnan(other.value)) << metric_name(metric);
  }
}

TEST(Compare, AnExrAgainstItsPngDiffersByTheRounding) {
  const TemporaryFolder folder;
  Image a = make_image(64, 1);
  for (const char* name : {"R", "G", "B"}) {
    for (std::size_t i = 0; i < 64; ++i) {
      if (i == 0) add_channel(a, name);
      find_channel(a, name)->values[i] = static_cast<float>(i) / 40.0f;  // up to 1.6, clipped in a PNG
    }
  }
  const ComparisonResult exr = compare(a, a, Metric::max);
  write_png(folder / "a.png", exr.shown_a);
  write_exr(folder / "a.exr", a);
  const ComparisonResult result =
      compare_images(folder / "a.exr", folder / "a.png", {.metric = Metric::max, .threshold = {}});
  EXPECT_GT(result.value, 0);
  EXPECT_LE(result.value, 0.5 / 255 + 1e-7);
}

std::string message_of(const Image& a, const Image& b, const std::string& layer) {
  try {
    compare(a, b, Metric::flip, layer);
  } catch (const ImageError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Compare, SaysWhyPicturesCannotBeCompared) {
  const Image a = layered();
  Image small = make_image(8, 12), crop = a, bare = make_image(16, 12);
  crop.x = 3;
  add_channel(small, "Y");
  add_channel(bare, "Y");
  EXPECT_EQ(message_of(a, small, ""),
            "b.exr: is 8 x 12 pixels, but a.exr is 16 x 12 pixels (render both with the same --size)");
  EXPECT_NE(message_of(a, crop, "").find("--crop"), std::string::npos);
  EXPECT_EQ(message_of(a, bare, "normal"), "b.exr: has no layer 'normal' (it has: color)");
  EXPECT_EQ(message_of(a, a, "curvature"),
            "a.exr: has no layer 'curvature' (it has: albedo, color, depth, id, normal, uv)");
  EXPECT_EQ(message_of(a, bare, ""), "no error");  // grey against colour
}

TEST(Compare, MetricsHaveNames) {
  for (const Metric metric : {Metric::flip, Metric::rmse, Metric::psnr, Metric::ssim, Metric::max}) {
    EXPECT_EQ(metric_from_name(metric_name(metric)), metric);
  }
  EXPECT_EQ(metric_from_name("mse"), std::nullopt);
}

}  // namespace
}  // namespace lekalo::render::compare_test
