// Daylight against numbers of the paper's model worked by hand, and what measurements say of the sun.
#include "render/lights/daylight.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lekalo::render::daylight_test {
namespace {

using geometry::kPi;

Vec3 at_zenith_angle(double degrees) {
  const double a = degrees * kPi / 180;
  return {std::sin(a), 0, std::cos(a)};
}

double luminance(const Vec3& color) { return glm::dot(color, Vec3(0.2126729, 0.7151522, 0.0721750)); }

// Y_z = (4.0453 T - 4.9710) tan((4/9 - T/120)(pi - 2 s)) - 0.2155 T + 2.4192, and the cubics for x_z and y_z, at T = 2
// and the sun 60 degrees from the zenith (s = pi/3).
TEST(Daylight, AtTheZenithIsTheFormula) {
  const Daylight day(at_zenith_angle(60), 2);
  const auto [luminance, x, y] = day.look({0, 0, 1});
  const double s = kPi / 3, chi = (4.0 / 9 - 2.0 / 120) * (kPi - 2 * s);
  EXPECT_NEAR(luminance, 3.1196 * std::tan(chi) + 1.9882, 1e-12);
  EXPECT_NEAR(x,
              4 * (0.00166 * s * s * s - 0.00375 * s * s + 0.00209 * s) +
                  2 * (-0.02903 * s * s * s + 0.06377 * s * s - 0.03202 * s + 0.00394) +
                  (0.11693 * s * s * s - 0.21196 * s * s + 0.06052 * s + 0.25886),
              1e-12);
  EXPECT_NEAR(y, 0.25, 0.02);  // blue
}

TEST(Daylight, IsBrightestAboutTheSunAndBlueAwayFromIt) {
  const Vec3 sun = at_zenith_angle(40);
  const Daylight day(sun, 3);
  EXPECT_GT(day.look(sun).luminance, 2 * day.look(at_zenith_angle(-50)).luminance);
  const Vec3 away = day.radiance(at_zenith_angle(-50));
  EXPECT_GT(away.z, 1.5 * away.x);
  for (const double z : {0.5, 0.0, -0.3, -1.0}) {
    const Vec3 color = day.radiance(glm::normalize(Vec3(0.1, 0.2, z)));
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(std::isfinite(color[i]) && color[i] >= 0) << z;
  }
}

// About 100 klx of a high sun through clear air, 128 outside of it; reddish and weak at the horizon.
TEST(Daylight, OfTheSunIsWeakenedByTheAir) {
  const Vec3 noon = Daylight(at_zenith_angle(20), 2.5).sun(), evening = Daylight(at_zenith_angle(87), 2.5).sun();
  EXPECT_GT(luminance(noon), 90);
  EXPECT_LT(luminance(noon), 115);
  EXPECT_LT(luminance(evening), 20);
  EXPECT_GT(evening.x, 3 * evening.z);
  EXPECT_GT(luminance(Daylight(at_zenith_angle(20), 2).sun()), luminance(Daylight(at_zenith_angle(20), 8).sun()));
}

}  // namespace
}  // namespace lekalo::render::daylight_test
