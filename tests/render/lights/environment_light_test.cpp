// Panoramas: samples of the density that is said, and all of the picture's light.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "render/lights/lights.h"
#include "render/samplers/sampler.h"

namespace lekalo::render::environment_light_test {

namespace {

using geometry::kPi;

// Dim, with one bright pixel.
EnvironmentLight panorama() {
  EnvironmentLight light;
  light.image = make_image(16, 8);
  for (const char* name : {"R", "G", "B"}) {
    Channel& channel = add_channel(light.image, name);
    for (float& value : channel.values) value = 0.1f;
    channel.values[2 * 16 + 5] = 50;
  }
  return light;
}

Vec3 direction(double z, double angle) {
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

TEST(EnvironmentLight, DensityIsThatOfSamplesAndSumsToOne) {
  const LightPtr light = make_light(panorama());
  double sum = 0, radiance = 0;
  constexpr int kN = 400;
  for (int i = 0; i < kN; ++i)
    for (int j = 0; j < kN; ++j) {
      const auto seen = light->towards({}, direction(-1 + 2 * (i + 0.5) / kN, 2 * kPi * (j + 0.5) / kN));
      ASSERT_TRUE(seen.has_value());
      sum += seen->density;
      radiance += seen->density * seen->irradiance[1];
    }
  const double cell = 4 * kPi / (kN * kN);
  EXPECT_NEAR(sum * cell, 1, 2e-3);
  double estimated = 0;
  constexpr int kSamples = 4096;
  for (int i = 0; i < kSamples; ++i) {
    SampleStream random(0, 0, i, kSamples, 0);
    const LightSample sample = light->sample_all({}, random.next_sobol_pair());
    const auto seen = light->towards({}, sample.direction);
    EXPECT_NEAR(glm::length(sample.direction), 1, 1e-12);
    EXPECT_NEAR(seen->density, sample.density, 1e-6 * sample.density);
    estimated += sample.irradiance[1] / kSamples;
  }
  EXPECT_NEAR(estimated, radiance * cell, 0.02 * estimated);
}

TEST(EnvironmentLight, MiddleOfThePictureLiesAlongY) {
  EnvironmentLight light = panorama();
  for (Channel& channel : light.image.channels) {
    for (float& value : channel.values) value = 0;
    channel.values[3 * 16 + 11] = channel.values[4 * 16 + 11] = 1;  // right of the middle by 3.5 pixels of 16
  }
  const double right = 3.5 / 16 * 2 * kPi;
  const auto radiance = [](const LightPtr& lamp, const Vec3& w) {
    const auto seen = lamp->towards({}, w);
    return seen->density * seen->irradiance[0];
  };
  EXPECT_NEAR(radiance(make_light(light), {std::sin(right), std::cos(right), 0}), 1, 1e-5);
  EXPECT_NEAR(radiance(make_light(light), {-std::sin(right), std::cos(right), 0}), 0, 1e-5);
  light.rotation = right;  // back to the middle
  EXPECT_NEAR(radiance(make_light(light), {0, 1, 0}), 1, 1e-5);
}

TEST(EnvironmentLight, WantsColours) {
  EnvironmentLight light;
  light.image = make_image(2, 1);
  EXPECT_THROW(make_light(light), std::invalid_argument);
}

TEST(EnvironmentLight, WantsFiniteNumbers) {
  for (const float wrong : {std::numeric_limits<float>::infinity(), std::nanf("")}) {
    EnvironmentLight light = panorama();
    light.image.channels[1].values[2 * 16 + 5] = wrong;
    try {
      make_light(light);
      FAIL();
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find("pixel (5, 2)"), std::string::npos) << error.what();
    }
  }
}

const char* const kLuminaire =
    "IESNA:LM-63-2002\n[TEST] none\nTILT=NONE\n1 1000 2 3 2 1 2 0 0 0\n1 1 50\n0 45 90\n0 90\n"
    "100 60 0\n100 20 0\n";

TEST(ProfileLight, IesFileByItsAngles) {
  const IesProfile profile{kLuminaire};
  EXPECT_EQ(profile.largest(), 200);
  EXPECT_NEAR(profile.share({0, 0, 1}), 1, 1e-12);
  const double r = std::sqrt(0.5);
  EXPECT_NEAR(profile.share({r, 0, r}), 0.6, 1e-9);
  EXPECT_NEAR(profile.share({0, r, r}), 0.2, 1e-9);
  EXPECT_NEAR(profile.share({-r, 0, r}), 0.6, 1e-9);  // of two planes of symmetry
  EXPECT_NEAR(profile.share({-0.5, -0.5, r}), 0.4, 1e-9);
  EXPECT_EQ(profile.share({0, 0, -1}), 0);
}

std::string complaint(std::string text) {
  try {
    IesProfile profile{text};
  } catch (const IesError& error) {
    return error.what();
  }
  return {};
}

TEST(ProfileLight, CommasSeparateNumbers) {
  std::string text = kLuminaire;
  text.replace(text.find("0 45 90"), 7, "0,45,90");
  text.replace(text.find("100 60 0"), 8, "100, 60, 0");
  const IesProfile profile{text};
  EXPECT_EQ(profile.largest(), 200);
  EXPECT_NEAR(profile.share({std::sqrt(0.5), 0, std::sqrt(0.5)}), 0.6, 1e-9);
}

TEST(ProfileLight, DamagedFilesSayWhatIsWrong) {
  const std::string good = kLuminaire;
  EXPECT_NE(complaint("hello").find("TILT="), std::string::npos);
  EXPECT_NE(complaint(good.substr(0, good.size() - 6)).find("ends after"), std::string::npos);
  std::string wrong = good;
  wrong.replace(wrong.find("100 60"), 6, "100 xx");
  EXPECT_NE(complaint(wrong).find("'xx' stands where an intensity"), std::string::npos);
  wrong = good;
  wrong.replace(wrong.find("100 60"), 6, "100 6x");
  EXPECT_NE(complaint(wrong).find("'6x' stands where an intensity"), std::string::npos);
  wrong = good;
  wrong.replace(wrong.find("0 45 90"), 7, "0 45 45");
  EXPECT_NE(complaint(wrong).find("do not grow"), std::string::npos);
  wrong = good;
  wrong.replace(wrong.find(" 3 2 1 2 "), 9, " 3 2 2 2 ");
  EXPECT_NE(complaint(wrong).find("type C"), std::string::npos);
}

}  // namespace

}  // namespace lekalo::render::environment_light_test
