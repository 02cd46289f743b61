// Chromaticities of illuminants and black bodies against published ones; wavelengths of paths.
#include "render/spectra/lamp_spectrum.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/spectra/hero_wavelengths.h"
#include "render/spectra/illuminants.h"
#include "render/spectra/observer.h"

namespace lekalo::render::lamp_spectrum_test {
namespace {

template <class Power>
Vec2 chromaticity(const Power& power) {
  Vec3 xyz(0);
  for (int i = 0; i < kSpectrumEntries; ++i)
    xyz += static_cast<double>(power(entry_nanometres(i))) * observer()[static_cast<size_t>(i)];
  return Vec2(xyz.x, xyz.y) / (xyz.x + xyz.y + xyz.z);
}

// CIE 015:2018, tables T.3 and T.10.1.
TEST(LampSpectrum, IlluminantsHaveTheirChromaticities) {
  const struct {
    const char* name;
    double x, y;
  } kPublished[] = {{"A", 0.44758, 0.40745},  {"D65", 0.31272, 0.32903}, {"D50", 0.34567, 0.35851},
                    {"F2", 0.37208, 0.37529}, {"F7", 0.31292, 0.32933},  {"F11", 0.38052, 0.37713}};
  for (const auto& one : kPublished) {
    const Vec2 xy = chromaticity([&](double l) { return illuminant_power(one.name, l); });
    EXPECT_NEAR(xy.x, one.x, 3e-4) << one.name;
    EXPECT_NEAR(xy.y, one.y, 3e-4) << one.name;
  }
  EXPECT_THROW(illuminant_power("B", 500), std::invalid_argument);
}

// The Planckian locus (Wyszecki and Stiles, "Color science", 1982, table 1(3.11)).
TEST(LampSpectrum, BlackBodiesLieOnThePlanckianLocus) {
  const struct {
    double kelvin, x, y;
  } kPublished[] = {{2000, 0.5267, 0.4133}, {3000, 0.4369, 0.4041}, {4000, 0.3804, 0.3767},
                    {5000, 0.3451, 0.3516}, {6500, 0.3135, 0.3236}, {10000, 0.2806, 0.2883}};
  for (const auto& one : kPublished) {
    const Vec2 xy = chromaticity([&](double l) { return black_body_power(one.kelvin, l); });
    EXPECT_NEAR(xy.x, one.x, 3e-4) << one.kelvin;
    EXPECT_NEAR(xy.y, one.y, 3e-4) << one.kelvin;
  }
}

TEST(LampSpectrum, HasTheLuminanceOne) {
  for (const double kelvin : {2500.0, 6504.0, 20000.0}) {
    const LampSpectrum lamp([&](double l) { return black_body_power(kelvin, l); });
    EXPECT_NEAR(glm::dot(lamp.color(), Vec3(0.2126729, 0.7151522, 0.0721750)), 1, 1e-9);
    const Vec3 back = color_of([&](double l) {
      const auto near = static_cast<float>(l);
      return static_cast<double>(lamp.at(3 * rgb(lamp.color()), {{near, near, near, near + 1e-3f}})[0]);
    });
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(back[c], 3 * lamp.color()[c], 1e-5) << kelvin;
  }
}

TEST(LampSpectrum, OfAColourThatIsCutHasTheLuminanceOneToo) {
  for (const double kelvin : {500.0, 1000.0, 1500.0}) {
    const LampSpectrum lamp([&](double l) { return black_body_power(kelvin, l); });
    EXPECT_EQ(lamp.color().z, 0) << kelvin;
    EXPECT_NEAR(luminance(lamp.color()), 1, 1e-9) << kelvin;
    const Vec3 back = color_of([&](double l) {
      const auto near = static_cast<float>(l);
      return static_cast<double>(lamp.at(rgb(lamp.color()), {{near, near, near, near + 1e-3f}})[0]);
    });
    EXPECT_NEAR(luminance(back), 1, 1e-5) << kelvin;
  }
}

TEST(Observer, TablesAreStraightBetweenEntriesAndConstantBeyond) {
  const auto square = [](size_t i) { return static_cast<double>(i * i); };
  EXPECT_DOUBLE_EQ(entry_at(381, square), 0.2);
  EXPECT_DOUBLE_EQ(entry_at(395, square), 9);
  EXPECT_DOUBLE_EQ(entry_at(300, square), 0);
  EXPECT_DOUBLE_EQ(entry_at(900, square), 6400);
}

TEST(LampSpectrum, BetweenTheEntriesOfItsTableIsNearThePower) {
  const auto power = [](double l) { return black_body_power(2700, l); };
  const LampSpectrum lamp(power);
  const Spectrum of_table = lamp.at(rgb(lamp.color()), {{402.5f, 502.5f, 602.5f, 702.5f}});
  for (int i = 0; i < 4; ++i) {
    const double l = 402.5 + 100 * i;
    EXPECT_NEAR(of_table[i] / of_table[1],
                power(l) / illuminant_power("D65", l) / (power(502.5) / illuminant_power("D65", 502.5)),
                2e-3 * of_table[i] / of_table[1])
        << l;
  }
}

TEST(LampSpectrum, OfD65IsWhite) {
  const LampSpectrum lamp([](double l) { return illuminant_power("D65", l); });
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(lamp.color()[c], 1, 1e-6);
}

TEST(HeroWavelengths, TogetherAreWhite) {
  constexpr int kCount = 1 << 14;
  Spectrum sum;
  for (int i = 0; i < kCount; ++i) {
    const HeroWavelengths hero = hero_wavelengths((i + 0.5) / kCount);
    EXPECT_TRUE(is_spectral(hero.wavelengths));
    sum += (1.0f / kCount) * hero.color(Spectrum(1.0f));
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], 1, 1e-3);
  EXPECT_FALSE(is_spectral(Wavelengths{}));
}

}  // namespace
}  // namespace lekalo::render::lamp_spectrum_test
