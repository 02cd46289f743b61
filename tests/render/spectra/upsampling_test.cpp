// Spectra for colours against the integrals of the CIE functions under D65.
#include "render/spectra/upsampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "render/spectra/hero_wavelengths.h"
#include "render/spectra/illuminants.h"
#include "render/spectra/observer.h"

namespace lekalo::render::upsampling_test {
namespace {

// Lanes about one wavelength that still count as spectral.
Wavelengths about(double nanometres) {
  const auto l = static_cast<float>(nanometres);
  return {{l, l, l, l + 1e-3f}};
}

// By trapezoids of 1 nm over CIE functions and D65 that are straight between their entries; not the sums of the fit.
template <class Multiple>
Vec3 color_by_integral(const Multiple& multiple) {
  Vec3 sum(0), white(0);
  for (int l = 380; l <= 780; ++l) {
    const double place = (l - kFirstNanometre) / kNanometreStep;
    const int i = std::min(static_cast<int>(place), kSpectrumEntries - 2);
    const Vec3 eye = glm::mix(observer()[static_cast<size_t>(i)], observer()[static_cast<size_t>(i) + 1], place - i);
    const double power = (l == 380 || l == 780 ? 0.5 : 1) * illuminant_power("D65", l);
    white += power * eye;
    sum += power * multiple(l) * eye;
  }
  return rec709(sum) / rec709(white);
}

double reflectance(const Spectrum& color, double nanometres) {
  return static_cast<double>(upsampled_reflectance(color, about(nanometres))[0]);
}

double linear(double display) {
  const double c = display / 255;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

// sRGB of the 24 patches of the ColorChecker (X-Rite's published values of 2005). Cyan lies outside: its red is 0.
TEST(Upsampling, ColorCheckerComesBack) {
  constexpr int kPatches[24][3] = {{115, 82, 68},   {194, 150, 130}, {98, 122, 157}, {87, 108, 67},   {133, 128, 177},
                                   {103, 189, 170}, {214, 126, 44},  {80, 91, 166},  {193, 90, 99},   {94, 60, 108},
                                   {157, 188, 64},  {224, 163, 46},  {56, 61, 150},  {70, 148, 73},   {175, 54, 60},
                                   {231, 199, 31},  {187, 86, 149},  {8, 133, 161},  {243, 243, 242}, {200, 200, 200},
                                   {160, 160, 160}, {122, 122, 121}, {85, 85, 85},   {52, 52, 52}};
  for (const auto& patch : kPatches) {
    const Vec3 color(linear(patch[0]), linear(patch[1]), linear(patch[2]));
    const Spectrum asked = rgb(color);
    const auto spectrum = [&](double l) { return reflectance(asked, l); };
    const Vec3 back = color_by_integral(spectrum), by_sums = color_of(spectrum);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(back[c], color[c], 5e-4) << patch[0] << ' ' << patch[1] << ' ' << patch[2];
      EXPECT_NEAR(by_sums[c], color[c], 3e-5) << patch[0] << ' ' << patch[1] << ' ' << patch[2];
    }
  }
}

TEST(Upsampling, AllColoursAreReflectances) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> share(0, 1);
  for (int i = 0; i < 200; ++i) {
    // Half of them at the edges of the cube.
    const auto lane = [&] { return i % 2 == 0 ? share(random) : std::round(share(random) * 2) / 2; };
    const Spectrum color(lane(), lane(), lane());
    const auto spectrum = [&](double l) { return reflectance(color, l); };
    for (double l = 380; l <= 780; l += 20) {
      EXPECT_GE(spectrum(l), 0);
      EXPECT_LE(spectrum(l), 1);
    }
    const Vec3 back = color_of(spectrum);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(back[c], static_cast<double>(color[c]), 5e-5) << i;
  }
}

TEST(Upsampling, GreysAndRgbStayAsTheyAre) {
  for (const float grey : {0.0f, 0.18f, 1.0f})
    for (const double l : {400.0, 550.0, 700.0}) {
      EXPECT_EQ(upsampled_reflectance(Spectrum(grey, grey, grey), about(l)), Spectrum(grey));
      EXPECT_EQ(upsampled_light(7 * Spectrum(grey, grey, grey), about(l)), Spectrum(7 * grey));
    }
  const Spectrum color(0.2f, 0.5f, 0.9f);
  EXPECT_EQ(upsampled_reflectance(color, Wavelengths{}), color);
  EXPECT_EQ(upsampled_light(color, Wavelengths{}), color);
  EXPECT_EQ(LinearUpsampling(Wavelengths{})(color), color);
}

TEST(Upsampling, LightOfAnyBrightnessComesBack) {
  for (const Spectrum& color : {Spectrum(30, 5, 0.1f), Spectrum(0, 0, 2), Spectrum(1e-4f, 2e-4f, 3e-4f)}) {
    const Vec3 back = color_of([&](double l) { return static_cast<double>(upsampled_light(color, about(l))[0]); });
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(back[c], color[c], 5e-5 * color.largest());
  }
}

TEST(Upsampling, LinearLightComesBackWithItsSigns) {
  for (const Spectrum& color : {Spectrum(1, 0, 0), Spectrum(-0.3f, 0.7f, 2)}) {
    const Vec3 back = color_of([&](double l) { return static_cast<double>(LinearUpsampling(about(l))(color)[0]); });
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(back[c], color[c], 1e-5);
  }
  for (const double l : {381.0, 502.5, 640.0}) EXPECT_NEAR(LinearUpsampling(about(l))(Spectrum(1, 1, 1))[0], 1, 1e-5);
}

}  // namespace
}  // namespace lekalo::render::upsampling_test
