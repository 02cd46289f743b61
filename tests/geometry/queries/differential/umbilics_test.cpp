// Umbilics of an ellipsoid with semi-axes a > b > c: x^2 = a^2 (a^2 - b^2)/(a^2 - c^2), z^2 = c^2 (b^2 - c^2)/(a^2 -
// c^2), y = 0 (do Carmo 1976, 3.5).
#include "geometry/queries/differential/umbilics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/surfaces/analytic/ellipsoid.h"
#include "geometry/surfaces/analytic/sphere.h"

namespace lekalo::geometry::umbilics_test {
namespace {

TEST(Umbilics, Ellipsoid) {
  const double a = 3, b = 2, c = 1.2;
  const Ellipsoid egg(Frame(), Vec3(a, b, c));
  const std::vector<Vec2> found = umbilics(egg);
  ASSERT_EQ(found.size(), 4u);
  const double x = a * std::sqrt((a * a - b * b) / (a * a - c * c)),
               z = c * std::sqrt((b * b - c * c) / (a * a - c * c));
  for (const Vec2& place : found) {
    const Vec3 p = egg.point(place.x, place.y);
    EXPECT_NEAR(std::abs(p.x), x, 1e-6);
    EXPECT_NEAR(p.y, 0, 1e-6);
    EXPECT_NEAR(std::abs(p.z), z, 1e-6);
  }
}

TEST(Umbilics, NoneOnSpheres) { EXPECT_TRUE(umbilics(SphereSurface(Frame(), 2)).empty()); }

}  // namespace
}  // namespace lekalo::geometry::umbilics_test
