// Optical constants against the catalogues' own figures; Fresnel's formulas against published and closed-form values.
#include "render/materials/optical_constants.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/lobes/fresnel.h"

namespace lekalo::render::optical_constants_test {
namespace {

TEST(OpticalConstants, DispersionFormulasGiveTheCataloguesIndices) {
  // n_d at 587.5618 nm as listed by refractiveindex.info for the same data sets.
  const std::pair<const char*, double> table[] = {
      {"N-BK7", 1.516800},    {"N-K5", 1.522489},    {"F2", 1.620040},       {"N-F2", 1.620053},
      {"SF10", 1.728250},     {"N-SF6", 1.805180},   {"N-SF11", 1.784720},   {"N-SF66", 1.922860},
      {"N-LASF9", 1.850249},  {"N-FK51A", 1.486561}, {"N-LAK33B", 1.755000}, {"fused_silica", 1.458464},
      {"sapphire", 1.768172}, {"CaF2", 1.433849},    {"MgF2", 1.377744},     {"diamond", 2.417486},
      {"water", 1.333403},    {"rutile", 2.614265}};
  EXPECT_EQ(std::size(table), dielectric_names().size());
  for (const auto& [name, n_d] : table) EXPECT_NEAR(dielectric_index(name, 587.5618), n_d, 6e-7) << name;
}

TEST(OpticalConstants, AbbeNumberOfBorosilicateCrown) {
  const double n_d = dielectric_index("N-BK7", 587.5618), n_f = dielectric_index("N-BK7", 486.1327),
               n_c = dielectric_index("N-BK7", 656.2725);
  EXPECT_NEAR((n_d - 1) / (n_f - n_c), 64.167, 6e-4);
}

TEST(OpticalConstants, MetalsFollowTheirTables) {
  // Johnson and Christy 1972, copper: 0.5821 um 0.70 2.704, 0.6168 um 0.30 3.205.
  const ComplexIndex at = metal_index("Cu", {{582.1f, 599.45f, 616.8f, 100.0f}});
  EXPECT_NEAR(at.n[0], 0.70, 1e-4);
  EXPECT_NEAR(at.k[0], 2.704, 1e-4);
  EXPECT_NEAR(at.n[1], 0.50, 1e-4);
  EXPECT_NEAR(at.k[1], 2.9545, 1e-4);
  EXPECT_NEAR(at.n[2], 0.30, 1e-4);
  EXPECT_GT(at.n[3], 1);  // beyond the table: its end
  EXPECT_EQ(metal_names().size(), 21u);
  EXPECT_THROW(metal_index("Unobtainium", {}), std::invalid_argument);
}

// N-BK7 by Schott's data sheet: n_d = 1.51680, Abbe number 64.17; n_F = 1.52238, n_C = 1.51432.
TEST(OpticalConstants, CauchyHasTheAbbeNumber) {
  const double f = cauchy_index(1.5168, 64.17, 486.1327), c = cauchy_index(1.5168, 64.17, 656.2725);
  EXPECT_NEAR(0.5168 / (f - c), 64.17, 1e-9);
  EXPECT_NEAR(f, 1.52238, 2e-4);
  EXPECT_NEAR(c, 1.51432, 2e-4);
  EXPECT_EQ(cauchy_index(1.5168, 64.17, kLineD), 1.5168);
}

TEST(Fresnel, DielectricAtPublishedAngles) {
  // 1 to 1.5, unpolarised, at 0, 45, 60, 80 degrees.
  const std::pair<double, double> table[] = {{0, 0.04}, {45, 0.0502399}, {60, 0.0891867}, {80, 0.3877043}};
  for (const auto& [degrees, reflectance] : table)
    EXPECT_NEAR(fresnel_dielectric(std::cos(degrees * geometry::kPi / 180), 1, 1.5), reflectance, 1e-7) << degrees;
  EXPECT_EQ(fresnel_dielectric(std::cos(0.75), 1.5, 1), 1);  // beyond the critical angle
  // Reversible: the same from inside along the refracted ray.
  const double inside = std::asin(std::sin(0.5) / 1.5);
  EXPECT_NEAR(fresnel_dielectric(std::cos(inside), 1.5, 1), fresnel_dielectric(std::cos(0.5), 1, 1.5), 1e-15);
}

TEST(Fresnel, ConductorAgreesWithClosedForms) {
  const double n = 0.7, k = 2.704;
  EXPECT_NEAR(fresnel_conductor(1, n, k), ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k), 1e-15);
  EXPECT_NEAR(fresnel_conductor(0, n, k), 1, 1e-12);
  for (const double c : {1.0, 0.8, 0.4, 0.1})
    EXPECT_NEAR(fresnel_conductor(c, 1.5, 0), fresnel_dielectric(c, 1, 1.5), 1e-14) << c;
}

}  // namespace
}  // namespace lekalo::render::optical_constants_test
