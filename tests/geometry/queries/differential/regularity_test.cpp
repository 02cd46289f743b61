#include "geometry/queries/differential/regularity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/curves/analytic/ellipse.h"
#include "geometry/curves/splines/bezier_curve.h"
#include "geometry/queries/measures/cell_diameters.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"

namespace lekalo::geometry::regularity_test {
namespace {

// Speeds of an ellipse are from 1 to 3, curvatures from 1/9 to 3.
TEST(Regularity, BoundsSpeedAndCurvature) {
  const CurveRegularity found = regularity(Ellipse(Frame(), 3, 1));
  EXPECT_TRUE(found.is_regular());
  EXPECT_LE(found.min_speed, 1);
  EXPECT_GE(found.min_speed, 0.98);
  EXPECT_GE(found.curvature_bound, 3);
  EXPECT_LE(found.curvature_bound, 3.06);
}

// (t^2, t^3) over [-1, 1]: x from 1 over 0 to 1, y from -1 to 1.
TEST(Regularity, FindsACusp) {
  const std::vector<Vec3> points{{1, -1, 0}, {-1.0 / 3, 1, 0}, {-1.0 / 3, -1, 0}, {1, 1, 0}};
  const CurveRegularity found = regularity(bezier_curve(points));
  ASSERT_EQ(found.singular.size(), 1u);
  EXPECT_NEAR(found.singular[0], 0.5, 1e-6);
  EXPECT_EQ(found.min_speed, 0);
}

TEST(Regularity, FindsPoles) {
  const SurfaceRegularity ball = regularity(SphereSurface(Frame(), 2));
  ASSERT_EQ(ball.singular.size(), 2u);
  for (const Rectangle& pole : ball.singular) {
    EXPECT_NEAR(pole.u.width(), kTwoPi, 1e-12);
    EXPECT_LE(pole.v.width(), 0.01);
  }
  const SurfaceRegularity ring = regularity(TorusSurface(Frame(), 3, 1));
  EXPECT_TRUE(ring.is_regular());
  EXPECT_LE(ring.min_area, 2);
  EXPECT_GE(ring.min_area, 1.8);
}

TEST(CellDiameters, BoundTheSurface) {
  const Plane sheet(Frame(), {{-1, 1}, {0, 1}});
  const CellDiameters cells = cell_diameters(sheet, 4, 2);
  EXPECT_NEAR(cells.largest, 1, 1e-13);
  EXPECT_EQ(cells.chain, 5);
  EXPECT_NEAR(cells.bound(), 5, 1e-12);
  // Nodes are from 7 to 7.07 above the line.
  const Line line{{0, 0, 7}, {1, 0, 0}};
  EXPECT_NEAR(farthest_node(sheet, 4, 2, line), std::sqrt(50.0), 1e-14);
  EXPECT_TRUE(surely_misses(cells, farthest_node(sheet, 4, 2, line)));
  EXPECT_FALSE(surely_misses(cells, farthest_node(sheet, 4, 2, {{0, 0, 0.5}, {1, 0, 0}})));
}

}  // namespace
}  // namespace lekalo::geometry::regularity_test
