// Segments, circles and ellipses with planes, against values known from elementary geometry.
#include "geometry/queries/intersections/conic_intersections.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/operations/curve_part.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/transformed.h"

namespace lekalo::geometry::conic_intersections_test {
namespace {

const Plane kSquare(Frame(), {{-1, 1}, {-1, 1}});

Frame at(const Vec3& origin, const Vec3& x, const Vec3& y) {
  Frame frame;
  frame.origin = origin, frame.x = x, frame.y = y, frame.z = glm::cross(x, y);
  return frame;
}

TEST(SegmentAndPlane, CrossesInsideAndMissesOutside) {
  const SurfaceIntersections met = intersect(Segment({0.5, 0.25, -1}, {0.5, 0.25, 3}), kSquare);
  ASSERT_EQ(met.points.size(), 1u);
  EXPECT_NEAR(met.points[0].t, 0.25, 1e-15);
  EXPECT_NEAR(met.points[0].u, 0.5, 1e-15);
  EXPECT_NEAR(met.points[0].v, 0.25, 1e-15);
  EXPECT_FALSE(met.points[0].contact);
  EXPECT_TRUE(intersect(Segment({1.001, 0, -1}, {1.001, 0, 3}), kSquare).points.empty());
  EXPECT_TRUE(intersect(Segment({0, 0, 1e-3}, {0, 0, 3}), kSquare).points.empty());
  // An end on the plane, also one that rounding has moved off it.
  for (const double z : {0.0, 1e-15, -1e-15})
    EXPECT_EQ(intersect(Segment({0, 0, z}, {0, 0, 3}), kSquare).points.size(), 1u);
  // At a small angle it still crosses.
  const SurfaceIntersections shallow = intersect(Segment({-0.5, 0, -1e-6}, {0.5, 0, 1e-6}), kSquare);
  ASSERT_EQ(shallow.points.size(), 1u);
  EXPECT_NEAR(shallow.points[0].t, 0.5, 1e-9);
  EXPECT_FALSE(shallow.points[0].contact);
}

TEST(SegmentAndPlane, LiesInItAsFarAsItGoes) {
  const SurfaceIntersections met = intersect(Segment({-2, 0.5, 0}, {2, 0.5, 0}), kSquare);
  EXPECT_TRUE(met.points.empty());
  ASSERT_EQ(met.on_surface.size(), 1u);
  EXPECT_NEAR(met.on_surface[0].lo, 0.25, 1e-15);
  EXPECT_NEAR(met.on_surface[0].hi, 0.75, 1e-15);
  // Along a side; past a corner, which it touches.
  const SurfaceIntersections side = intersect(Segment({-0.5, 1, 0}, {3.5, 1, 0}), kSquare);
  ASSERT_EQ(side.on_surface.size(), 1u);
  EXPECT_NEAR(side.on_surface[0].hi, 0.375, 1e-15);
  const SurfaceIntersections corner = intersect(Segment({0, 2, 0}, {2, 0, 0}), kSquare);
  EXPECT_TRUE(corner.on_surface.empty());
  ASSERT_EQ(corner.points.size(), 1u);
  EXPECT_NEAR(corner.points[0].t, 0.5, 1e-15);
}

TEST(CircleAndPlane, CrossesTwiceTouchesOrMisses) {
  // Upright circles of radius 1 whose middles are so high.
  const auto upright = [](double height) { return Circle(at({0, 0, height}, {0.6, 0.8, 0}, {0, 0, 1}), 1); };
  const SurfaceIntersections met = intersect(upright(0.5), Plane(Frame()));
  ASSERT_EQ(met.points.size(), 2u);
  EXPECT_NEAR(met.points[0].t, kPi + std::asin(0.5), 1e-14);
  EXPECT_NEAR(met.points[1].t, kTwoPi - std::asin(0.5), 1e-14);
  const SurfaceIntersections touch = intersect(upright(1), Plane(Frame()));
  ASSERT_EQ(touch.points.size(), 1u);
  EXPECT_TRUE(touch.points[0].contact);
  EXPECT_NEAR(touch.points[0].t, 1.5 * kPi, 1e-7);
  EXPECT_TRUE(intersect(upright(1.00001), Plane(Frame())).points.empty());
  // The seam of a circle counts once; an arc that ends before does not meet.
  EXPECT_EQ(intersect(Circle(at({0, 0, 0}, {1, 0, 0}, {0, 0, 1}), 1), Plane(Frame())).points.size(), 2u);
  const auto circle = std::make_shared<Circle>(at({0, 0, 0.5}, {1, 0, 0}, {0, 0, 1}), 1);
  EXPECT_EQ(intersect(CurvePart(circle, {3, 4}), Plane(Frame())).points.size(), 1u);
  EXPECT_TRUE(intersect(CurvePart(circle, {0, 3}), Plane(Frame())).points.empty());
}

TEST(CircleAndPlane, LiesInItAsFarAsItGoes) {
  const double radius = 1.25, corner = std::acos(0.8), side = std::asin(0.8);
  const SurfaceIntersections met = intersect(Circle(Frame(), radius), kSquare);
  ASSERT_EQ(met.on_surface.size(), 4u);
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR(met.on_surface[k].lo, k * kPi / 2 + corner, 1e-14);
    EXPECT_NEAR(met.on_surface[k].hi, k * kPi / 2 + side, 1e-14);
  }
  const SurfaceIntersections all = intersect(Circle(Frame(), 0.9), kSquare);
  ASSERT_EQ(all.on_surface.size(), 1u);
  EXPECT_EQ(all.on_surface[0].lo, 0);
  EXPECT_EQ(all.on_surface[0].hi, kTwoPi);
}

// The heights above the plane have the same zeros whatever affine map is put on both.
TEST(ConicsAndPlanes, UnderAffineMaps) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> within(-1, 1);
  const auto vector = [&] { return Vec3(within(random), within(random), within(random)); };
  for (int k = 0; k < 2000; ++k) {
    const Affine map{Mat3(1.0) + 0.5 * Mat3(vector(), vector(), vector()), vector()};
    const double height = 1.2 * within(random);
    const SurfacePtr plane =
        std::make_shared<Plane>(at({0, 0, height}, {1, 0, 0}, {0, 1, 0}), Rectangle{{-2, 2}, {-2, 2}});
    const CurvePtr circle = std::make_shared<Circle>(at({0, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1);
    const SurfaceIntersections met = intersect(*transformed(circle, map), *transformed(plane, map));
    ASSERT_EQ(met.points.size(), std::abs(height) < 1 ? 2u : 0u) << k;
    for (const SurfaceIntersection& one : met.points) EXPECT_NEAR(std::sin(one.t), height, 1e-12) << k;
  }
}

TEST(ConicsAndPlanes, OthersAreNotKnown) {
  EXPECT_FALSE(conic_intersections(Segment({0, 0, 0}, {1, 0, 0}), SphereSurface(Frame(), 1), 1e-9));
}

}  // namespace
}  // namespace lekalo::geometry::conic_intersections_test
