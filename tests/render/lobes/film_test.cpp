// Thin films against other forms of Airy's sum and their limits.
#include "render/lobes/film.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/lobes/fresnel.h"
#include "render/spectra/observer.h"

namespace lekalo::render::film_test {
namespace {

using Complex = std::complex<double>;
using geometry::kPi;

TEST(Film, OfNoThicknessIsTheBoundaryItself) {
  for (const double c : {1.0, 0.7, 0.2, 0.01}) {
    EXPECT_NEAR(film_reflectance(c, 1, 1.33, 1.5, 0, 550), fresnel_dielectric(c, 1, 1.5), 1e-12);
    EXPECT_NEAR(film_reflectance(c, 1, 1.33, Complex(0.2, -3.4), 0, 550), fresnel_conductor(c, 0.2, 3.4), 1e-12);
  }
}

TEST(Film, OfTheIndexOfWhatLiesBelowIsNotSeen) {
  EXPECT_NEAR(film_reflectance(0.8, 1, 1.5, 1.5, 420, 550), fresnel_dielectric(0.8, 1, 1.5), 1e-12);
}

// Born and Wolf 1999, 7.6.1: of a film between equal substances R = F sin^2(b) / (1 + F sin^2(b)), F = 4 r^2 / (1 -
// r^2)^2 for each polarisation.
TEST(Film, OfASoapBubbleIsAirysFormula) {
  const double n = 1.33, thickness = 430;
  for (const double c : {1.0, 0.8, 0.35}) {
    const double c1 = std::sqrt(1 - (1 - c * c) / (n * n));
    const double s = (c - n * c1) / (c + n * c1), p = (n * c - c1) / (n * c + c1);
    for (const double wavelength : {400.0, 550.0, 700.0}) {
      const double half = 2 * kPi * n * thickness * c1 / wavelength, sine = std::sin(half) * std::sin(half);
      const auto of = [&](double r) {
        const double f = 4 * r * r / ((1 - r * r) * (1 - r * r));
        return f * sine / (1 + f * sine);
      };
      EXPECT_NEAR(film_reflectance(c, 1, n, 1, thickness, wavelength), 0.5 * (of(s) + of(p)), 1e-12);
    }
  }
}

// A quarter-wave coat of index sqrt(n) leaves no reflection (Born and Wolf 1999, 1.6.4).
TEST(Film, OfAQuarterWaveTakesTheReflectionAway) {
  EXPECT_NEAR(film_reflectance(1, 1, std::sqrt(1.9), 1.9, 550 / (4 * std::sqrt(1.9)), 550), 0, 1e-15);
}

// Characteristic matrices (Abeles 1950): the same from quite another calculation.
TEST(Film, AgreesWithCharacteristicMatrices) {
  const Complex below(2.9, -3.1);
  const double n = 2.2, thickness = 57, wavelength = 580;
  for (const double c : {1.0, 0.6, 0.25}) {
    const Complex sine2 = 1 - c * c;
    const Complex c1 = std::sqrt(1.0 - sine2 / (n * n)), c2 = std::sqrt(1.0 - sine2 / (below * below));
    const Complex phase = 2 * kPi * n * thickness / wavelength * c1, i(0, 1);
    double mean = 0;
    for (const bool parallel : {false, true}) {
      const auto admittance = [&](const Complex& index, const Complex& cosine) {
        return parallel ? index / cosine : index * cosine;
      };
      const Complex y0 = admittance(1, c), y1 = admittance(n, c1), y2 = admittance(below, c2);
      const Complex b = std::cos(phase) + i * std::sin(phase) * y2 / y1,
                    e = i * y1 * std::sin(phase) + std::cos(phase) * y2;
      mean += 0.5 * std::norm((y0 * b - e) / (y0 * b + e));
    }
    EXPECT_NEAR(film_reflectance(c, 1, n, below, thickness, wavelength), mean, 1e-12);
  }
}

TEST(FilmTable, HoldsTheColoursOfTheFormula) {
  const auto glass = [](double) { return Complex(1.5); };
  const FilmTable table(1.33, 200, 900, glass), alone(1.33, 450, 450, glass);
  const Vec3 white = observed([](double) { return 1; });
  for (const double thickness : {200.0, 450.0, 733.0, 900.0})
    for (const double c : {1.0, 0.77, 0.3}) {
      const Vec3 exact = observed([&](double nm) { return film_reflectance(c, 1, 1.33, 1.5, thickness, nm); }) / white;
      const Vec3 found = rgb(table.reflectance(thickness, c));
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i], std::max(0.0, exact[i]), 1e-3) << thickness << ' ' << c;
    }
  EXPECT_NEAR(alone.reflectance(450, 0.6)[1], table.reflectance(450, 0.6)[1], 1e-3);
  const FilmTable metal(1.33, 0, 0, [](double) { return Complex(0.2, -3.4); });
  EXPECT_NEAR(metal.reflectance(0, 0.5)[0], fresnel_conductor(0.5, 0.2, 3.4), 1e-4);
}

TEST(Observer, SeesConstantPowerWithTheIntegralOfY) {
  const Vec3 white = observed([](double) { return 1; });
  EXPECT_NEAR(glm::dot(white, Vec3(0.2126729, 0.7151522, 0.0721750)), 106.857, 0.05);
}

}  // namespace
}  // namespace lekalo::render::film_test
