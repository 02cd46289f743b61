// Against the values that the authors' own program gives for the pairs of tests/data/flip (its README has the table),
// and against what the definition says about equal and constant pictures.
#include "render/image/flip.h"

#include <gtest/gtest.h>

#include "render/image/exr.h"
#include "render/image/png.h"
#include "support/planes.h"

namespace lekalo::render::flip_test {
namespace {

const std::filesystem::path kPairs = std::filesystem::path(LEKALO_SOURCE_DIR) / "tests/data/flip";
constexpr double kTolerance = 1e-4;

void expect_statistics(const ErrorMap& map, const ErrorStatistics& published) {
  const ErrorStatistics own = pool(map);
  EXPECT_NEAR(own.mean, published.mean, kTolerance);
  EXPECT_NEAR(own.weighted_median, published.weighted_median, kTolerance);
  EXPECT_NEAR(own.weighted_first_quartile, published.weighted_first_quartile, kTolerance);
  EXPECT_NEAR(own.weighted_third_quartile, published.weighted_third_quartile, kTolerance);
  EXPECT_NEAR(own.minimum, published.minimum, kTolerance);
  EXPECT_NEAR(own.maximum, published.maximum, kTolerance);
}

TEST(Flip, ShiftByOnePixelIsAsPublished) {
  expect_statistics(ldr_flip(read_png(kPairs / "ldr1_reference.png"), read_png(kPairs / "ldr1_test.png")),
                    {.mean = 0.112601,
                     .weighted_median = 0.210875,
                     .weighted_first_quartile = 0.102565,
                     .weighted_third_quartile = 0.334353,
                     .minimum = 0.000000,
                     .maximum = 0.789435});
}

TEST(Flip, NoiseAndTintIsAsPublished) {
  expect_statistics(ldr_flip(read_png(kPairs / "ldr2_reference.png"), read_png(kPairs / "ldr2_test.png")),
                    {.mean = 0.124430,
                     .weighted_median = 0.154717,
                     .weighted_first_quartile = 0.111094,
                     .weighted_third_quartile = 0.190528,
                     .minimum = 0.004443,
                     .maximum = 0.381675});
}

TEST(Flip, HighDynamicRangeIsAsPublished) {
  const HdrFlip result = hdr_flip(read_exr(kPairs / "hdr1_reference.exr"), read_exr(kPairs / "hdr1_test.exr"));
  EXPECT_NEAR(result.start_exposure, -1.3845, kTolerance);
  EXPECT_NEAR(result.stop_exposure, 2.5097, kTolerance);
  EXPECT_EQ(result.exposure_count, 4);
  expect_statistics(result.error, {.mean = 0.092986,
                                   .weighted_median = 0.092825,
                                   .weighted_first_quartile = 0.085513,
                                   .weighted_third_quartile = 0.100498,
                                   .minimum = 0.029926,
                                   .maximum = 0.989454});
}

Image constant(float r, float g, float b) {
  Image image = make_image(40, 30);
  for (const auto& [name, value] : {std::pair{"R", r}, {"G", g}, {"B", b}}) {
    checks::fill(add_channel(image, name), value);
  }
  return image;
}

TEST(Flip, EqualPicturesDoNotDiffer) {
  const Image image = read_png(kPairs / "ldr2_test.png");
  EXPECT_EQ(pool(ldr_flip(image, image)).maximum, 0);
  EXPECT_EQ(pool(hdr_flip(image, image).error).maximum, 0);
}

TEST(Flip,
     GreenAgainstBlueIsTheLargestDifference) {  // by the definition of c_max; no edges, so FLIP is the colour term
  const ErrorStatistics statistics = pool(ldr_flip(constant(0, 1, 0), constant(0, 0, 1)));
  EXPECT_NEAR(statistics.minimum, 1, 1e-5);
  EXPECT_NEAR(statistics.maximum, 1, 1e-5);
}

TEST(Flip, BlackReferencesAreCompared) {
  const HdrFlip black = hdr_flip(constant(0, 0, 0), constant(1, 1, 1));
  EXPECT_EQ(black.exposure_count, 1);
  EXPECT_GT(pool(black.error).minimum, 0.5);
  Image mostly_black = constant(0, 0, 0);
  mostly_black.channels[1].values[0] = 1;  // median 0, and 0.7152 without the black pixels
  const HdrFlip figure = hdr_flip(mostly_black, mostly_black);
  EXPECT_EQ(figure.exposure_count, 2);
  EXPECT_FLOAT_EQ(figure.start_exposure, figure.stop_exposure);
}

}  // namespace
}  // namespace lekalo::render::flip_test
