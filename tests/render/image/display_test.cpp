// The display transform against IEC 61966-2-1 and Narkowicz' formula worked out by hand.
#include "render/image/display.h"
#include "support/planes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lekalo::render::display_test {
namespace {

Image grey(const std::vector<float>& values) {
  Image image = make_image(static_cast<int>(values.size()), 1);
  add_channel(image, "Y").values = PixelPlane<float>(values);
  return image;
}

TEST(Display, SrgbIsExact) {
  EXPECT_EQ(srgb_encode(0), 0);
  EXPECT_DOUBLE_EQ(srgb_encode(1), 1);
  EXPECT_NEAR(srgb_encode(0.5), 0.7353569830524495, 1e-15);  // 1.055 0.5^(1/2.4) - 0.055
  EXPECT_NEAR(srgb_encode(0.18), 0.46135612950044164, 1e-15);
  EXPECT_DOUBLE_EQ(srgb_encode(0.001), 0.01292);
  for (int i = 0; i <= 1000; ++i) EXPECT_NEAR(srgb_decode(srgb_encode(i / 1000.0)), i / 1000.0, 1e-7);
}

TEST(Display, FilmicIsNarkowiczAtSixTenths) {
  EXPECT_EQ(filmic(0), 0);
  EXPECT_NEAR(filmic(1), 0.6 * 1.536 / (0.6 * 2.048 + 0.14), 1e-15);  // 2.51 0.6 + 0.03, 2.43 0.6 + 0.59
  EXPECT_NEAR(filmic(12.0678), 1, 1e-5);                              // the larger root of f = 1, over 0.6
}

TEST(Display, EverySrgbLevelSurvives) {
  std::vector<float> values;
  for (int i = 0; i < 256; ++i) values.push_back(static_cast<float>(srgb_decode(i / 255.0)));
  const DisplayResult result = to_display(grey(values), {});
  ASSERT_EQ(result.image.channels, 1);
  for (std::size_t i = 0; i < 256; ++i) EXPECT_EQ(result.image.samples[i], i);
  EXPECT_EQ(result.non_finite, 0u);
}

// By the curve itself, at even steps of light and on both sides of every change of level.
TEST(Display, LevelsAreThoseOfTheCurve) {
  std::vector<float> values;
  for (int i = 0; i <= 100000; ++i) values.push_back(static_cast<float>(i) / 100000);
  for (int i = 1; i < 256; ++i) {
    float value = static_cast<float>(srgb_decode((i - 0.5) / 255));
    for (int k = 0; k < 3; ++k) value = std::nextafter(value, 0.0f);
    for (int k = 0; k < 7; ++k, value = std::nextafter(value, 1.0f)) values.push_back(value);
  }
  for (const int bits : {8, 16}) {
    const DisplayImage shown = to_display(grey(values), {.bits = bits}).image;
    for (std::size_t i = 0; i < values.size(); ++i)
      ASSERT_EQ(shown.samples[i], std::lround(((1 << bits) - 1) * srgb_encode(values[i]))) << values[i];
  }
}

TEST(Display, ExposureIsInStops) {
  EXPECT_EQ(to_display(grey({0.125f}), {.exposure = 2}).image.samples[0], 188);  // half light: level 187.5
  EXPECT_EQ(to_display(grey({1.0f}), {.exposure = -1, .bits = 16}).image.samples[0],
            std::lround(65535 * 0.7353569830524495));
}

TEST(Display, NotFiniteAndOutOfRangeValuesAreShownAndCounted) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const Image image = grey({std::nanf(""), kInfinity, -kInfinity, -1.0f, 1e30f, 3.0f});
  for (const ToneCurve curve : {ToneCurve::none, ToneCurve::filmic}) {
    const DisplayResult result = to_display(image, {.curve = curve});
    EXPECT_EQ(result.non_finite, 3u);
    EXPECT_EQ(result.image.samples[0], 0);
    EXPECT_EQ(result.image.samples[1], 255);
    EXPECT_EQ(result.image.samples[2], 0);
    EXPECT_EQ(result.image.samples[3], 0);
    EXPECT_EQ(result.image.samples[4], 255);
    EXPECT_EQ(result.image.samples[5], curve == ToneCurve::none ? 255 : std::lround(255 * srgb_encode(filmic(3))));
  }
}

TEST(Display, AlphaIsDividedOutOrLeftBeforeBlack) {
  Image image = make_image(2, 1);
  for (const char* name : {"R", "G", "B"}) checks::set(add_channel(image, name), {0.25f, 0.0f});
  checks::set(add_channel(image, "A"), {0.5f, 0.0f});
  const DisplayImage kept = to_display(image, {.alpha = true}).image;
  EXPECT_EQ(kept.samples, (std::vector<std::uint16_t>{188, 188, 188, 128, 0, 0, 0, 0}));
  const DisplayImage before_black = to_display(image, {}).image;
  EXPECT_EQ(before_black.channels, 3);
  EXPECT_EQ(before_black.samples[0], std::lround(255 * srgb_encode(0.25)));
}

TEST(Tone, AgxKeepsGreyGreyAndEndsAtWhite) {
  // Middle grey through the published polynomial: log2(0.18) lies at (log2(0.18) + 12.47393) / 16.5, the matrices keep
  // grey to their printed digits.
  const double x = (std::log2(0.18) + 12.47393) / 16.499999, x2 = x * x, x4 = x2 * x2;
  const double curve =
      15.5 * x4 * x2 - 40.14 * x4 * x + 31.96 * x4 - 6.868 * x2 * x + 0.4298 * x2 + 0.1191 * x - 0.00232;
  for (const double lane : toned(ToneCurve::agx, {0.18, 0.18, 0.18})) EXPECT_NEAR(lane, std::pow(curve, 2.2), 2e-3);
  double before = -1;
  for (double light = 1e-5; light < 100; light *= 1.5) {
    const auto grey = toned(ToneCurve::agx, {light, light, light});
    EXPECT_NEAR(grey[0], grey[1], 2e-3);
    EXPECT_NEAR(grey[0], grey[2], 2e-3);
    EXPECT_GE(grey[1], before - 1e-12);
    EXPECT_LT(grey[1], 1.02);
    before = grey[1];
  }
  // A very bright red turns to white.
  const auto red = toned(ToneCurve::agx, {50, 0.5, 0.5});
  EXPECT_GT(red[1], 0.4);
}

TEST(Tone, PbrNeutralKeepsWhatIsNotBright) {
  // F90 of 0.04 is taken off base colours above 0.08, below that 6.25 x^2.
  const auto kept = toned(ToneCurve::pbr_neutral, {0.5, 0.3, 0.2});
  EXPECT_NEAR(kept[0], 0.46, 1e-12);
  EXPECT_NEAR(kept[1], 0.26, 1e-12);
  EXPECT_NEAR(kept[2], 0.16, 1e-12);
  const auto dark = toned(ToneCurve::pbr_neutral, {0.05, 0.04, 0.02});
  EXPECT_NEAR(dark[2], 6.25 * 0.02 * 0.02, 1e-12);
  // The peak 1 - 0.24^2 / (peak + 0.24 - 0.76) of bright ones, continuous at 0.76.
  const auto grey = toned(ToneCurve::pbr_neutral, {2.04, 2.04, 2.04});
  EXPECT_NEAR(grey[0], 1 - 0.24 * 0.24 / (2 + 0.24 - 0.76), 1e-12);
  EXPECT_NEAR(toned(ToneCurve::pbr_neutral, {0.8, 0.8, 0.8})[0], 0.76, 1e-12);
  EXPECT_LT(toned(ToneCurve::pbr_neutral, {1e6, 0, 0})[0], 1);
  EXPECT_GT(toned(ToneCurve::pbr_neutral, {1e6, 0, 0})[1], 0.9);
}

}  // namespace
}  // namespace lekalo::render::display_test
