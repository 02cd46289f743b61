// Formulas of the classic light model against numbers worked out in double precision from Golovanov 2016, 8.4.
#include "render/integrators/phong_model.h"

#include <gtest/gtest.h>

#include "render/integrators/media.h"

namespace lekalo::render::phong_model_test {
namespace {

using geometry::kPi;

constexpr double kDegree = kPi / 180;

TEST(ClassicModel, PhongLobeFallsToHalfAtTheKnownAngles) {
  const std::pair<double, double> table[] = {{1, 60},         {2, 45},        {5, 29.477318},  {10, 21.087350},
                                             {20, 14.997675}, {50, 9.518345}, {100, 6.738272}, {200, 4.767432}};
  for (const auto& [exponent, degrees] : table)
    EXPECT_NEAR(phong_lobe(std::cos(degrees * kDegree), exponent), 0.5, 1e-6) << exponent;
  EXPECT_EQ(phong_lobe(-0.1, 1), 0);
}

TEST(ClassicModel, SnellsLawInVectors) {
  const Vec3 m(0, 0, 1);
  const auto d = [](double degrees) { return Vec3(std::sin(degrees * kDegree), 0, -std::cos(degrees * kDegree)); };
  const Vec3 t = *refracted(d(30), m, 1, 1.5);
  EXPECT_NEAR(t.x, 1.0 / 3, 1e-15);
  EXPECT_NEAR(t.z, -0.942809041582063, 1e-15);
  EXPECT_NEAR(std::asin(t.x) / kDegree, 19.47122063449069, 1e-12);
  EXPECT_NEAR(std::asin(refracted(d(45), m, 1, 1.5)->x) / kDegree, 28.12550570205571, 1e-12);
  EXPECT_TRUE(refracted(d(41.8103), m, 1.5, 1));
  EXPECT_FALSE(refracted(d(41.8104), m, 1.5, 1));  // critical angle 41.81031489577860
}

TEST(ClassicModel, BouguersLaw) {
  EXPECT_FLOAT_EQ(transmittance(Spectrum(0.5f), 2)[0], 0.3678794411714423f);
  const float once = transmittance(Spectrum(0.7f), 1.3)[1];
  EXPECT_FLOAT_EQ(transmittance(Spectrum(0.7f), 2.6)[1], once * once);
  EXPECT_EQ(transmittance(Spectrum(), geometry::kInfinity)[0], 1);
  EXPECT_EQ(transmittance(Spectrum(0.1f), geometry::kInfinity)[0], 0);
}

TEST(ClassicModel, DepthTerm) {
  EXPECT_NEAR(0.2 * depth_factor(0.1, 15, 10), 0.1333333333333333, 1e-16);
  EXPECT_EQ(depth_factor(0.1, 5, 10), 1);
}

TEST(Media, TheHighestPriorityFillsThePlaceAndOfEqualOnesTheLast) {
  const Medium glass{1.5f, {}, 1}, water{1.33f, {}, 0}, other_glass{1.7f, {}, 1};
  Media media;
  EXPECT_EQ(media.filling(), -1);
  EXPECT_EQ(media.current().index, 1);
  media.enter(7, glass);
  media.enter(8, water);
  EXPECT_EQ(media.filling(), 7);
  media.enter(9, other_glass);
  EXPECT_EQ(media.filling(), 9);
  media.leave(7);
  EXPECT_EQ(media.filling(), 9);
  media.leave(9);
  EXPECT_EQ(media.filling(), 8);
  EXPECT_TRUE(media.is_inside(8));
  media.leave(8);
  EXPECT_EQ(media.filling(), -1);
}

}  // namespace
}  // namespace lekalo::render::phong_model_test
