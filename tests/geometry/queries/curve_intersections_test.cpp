// Meetings of curves with curves and surfaces: the checks of Golovanov 2016, 4.3 and 4.4, closed forms, and random
// pairs against counts of chords.
#include "geometry/queries/curve_intersections.h"

#include <gtest/gtest.h>

#include "geometry/curves/bezier_curve.h"
#include "geometry/curves/circle.h"
#include "geometry/curves/ellipse.h"
#include "geometry/curves/segment.h"
#include "geometry/surfaces/cone.h"
#include "geometry/surfaces/plane.h"
#include "geometry/surfaces/sphere.h"

namespace lekalo::geometry {
namespace {

Frame at(const Vec3& origin) {
  Frame frame;
  frame.origin = origin;
  return frame;
}

TEST(TwoCurves, SegmentsCrossInTheMiddle) {
  const CurveMeetings met = intersect(Segment({0, 0, 0}, {4, 2, 0}), Segment({1, 3, 0}, {3, -1, 0}));
  ASSERT_EQ(met.points.size(), 1u);
  EXPECT_NEAR(met.points[0].s, 0.5, 1e-15);
  EXPECT_NEAR(met.points[0].t, 0.5, 1e-15);
  EXPECT_FALSE(met.points[0].contact);
  EXPECT_LT(glm::length(met.points[0].point - Vec3(2, 1, 0)), 1e-15);
}

TEST(TwoCurves, SegmentsThatPassEachOtherInSpaceDoNotMeet) {
  EXPECT_TRUE(intersect(Segment({0, 0, 0}, {4, 2, 0}), Segment({1, 3, 1e-6}, {3, -1, 1e-6})).points.empty());
}

TEST(TwoCurves, CrossedEllipsesMeetInFourPoints) {
  Frame turned;
  turned.x = {0, 1, 0}, turned.y = {-1, 0, 0};
  const CurveMeetings met = intersect(Ellipse(Frame(), 3, 1), Ellipse(turned, 3, 1));
  ASSERT_EQ(met.points.size(), 4u);
  for (const CurveMeeting& one : met.points) {
    EXPECT_NEAR(std::abs(one.point.x), std::sqrt(0.9), 1e-15);
    EXPECT_NEAR(std::abs(one.point.y), std::sqrt(0.9), 1e-15);
    EXPECT_FALSE(one.contact);
  }
}

TEST(TwoCurves, CirclesTouchFromOutsideAndFromInside) {
  for (const double x : {3.0, 1.0}) {
    const CurveMeetings met = intersect(Circle(Frame(), 2), Circle(at({x, 0, 0}), 1));
    ASSERT_EQ(met.points.size(), 1u) << x;
    EXPECT_TRUE(met.points[0].contact);
    EXPECT_LT(glm::length(met.points[0].point - Vec3(2, 0, 0)), 1e-14);
  }
}

TEST(TwoCurves, CirclesThatNearlyTouchAreToldApart) {
  EXPECT_EQ(intersect(Circle(Frame(), 2), Circle(at({3 - 1e-6, 0, 0}), 1)).points.size(), 2u);
  EXPECT_EQ(intersect(Circle(Frame(), 2), Circle(at({3 + 1e-6, 0, 0}), 1)).points.size(), 0u);
}

TEST(TwoCurves, ArcsOfOneCircleHaveAPartInCommon) {
  const Circle whole(Frame(), 2), arc(Frame(), 2, {-1, 1});
  const CurveMeetings met = intersect(arc, whole);
  EXPECT_TRUE(met.points.empty());
  ASSERT_EQ(met.common.size(), 1u);
  EXPECT_NEAR(met.common[0].s.lo, -1, 1e-12);
  EXPECT_NEAR(met.common[0].s.hi, 1, 1e-12);
  EXPECT_NEAR(met.common[0].end - met.common[0].begin, 2, 1e-12);
}

TEST(TwoCurves, SegmentsOnOneLineShareWhatBothCover) {
  const CurveMeetings met = intersect(Segment({0, 0, 0}, {4, 2, 0}), Segment({6, 3, 0}, {2, 1, 0}));
  EXPECT_TRUE(met.points.empty());
  ASSERT_EQ(met.common.size(), 1u);
  EXPECT_NEAR(met.common[0].s.lo, 0.5, 1e-12);
  EXPECT_NEAR(met.common[0].s.hi, 1, 1e-12);
  EXPECT_NEAR(met.common[0].begin, 1, 1e-12);
  EXPECT_NEAR(met.common[0].end, 0.5, 1e-12);
}

TEST(CurveAndSurface, ALineMeetsAPlane) {
  const SurfaceMeetings met = intersect(Segment({0, 0, 5}, {0, 5, -5}), Plane(at({0, 0, 1})));
  ASSERT_EQ(met.points.size(), 1u);
  EXPECT_LT(glm::length(met.points[0].point - Vec3(0, 2, 1)), 1e-15);
}

TEST(CurveAndSurface, ALineMeetsTouchesOrMissesASphere) {
  const SphereSurface sphere(Frame(), 2);
  const SurfaceMeetings through = intersect(Segment({-5, 0.5, 0.25}, {5, 0.5, 0.25}), sphere);
  ASSERT_EQ(through.points.size(), 2u);
  for (const SurfaceMeeting& one : through.points) EXPECT_NEAR(glm::length(one.point), 2, 1e-15);
  const SurfaceMeetings along =
      intersect(Segment({-5, 2 * std::cos(0.3), 2 * std::sin(0.3)}, {5, 2 * std::cos(0.3), 2 * std::sin(0.3)}), sphere);
  ASSERT_EQ(along.points.size(), 1u);
  EXPECT_TRUE(along.points[0].contact);
  EXPECT_NEAR(along.points[0].t, 0.5, 1e-14);
  EXPECT_TRUE(intersect(Segment({-5, 2.1, 0}, {5, 2.1, 0}), sphere).points.empty());
}

TEST(CurveAndSurface, ACircleLiesOnACylinderAsFarAsThatGoes) {
  const CylinderSurface half(at({0, 0, -1}), 2, 2, {{0, kPi}, {0, 1}});
  const SurfaceMeetings met = intersect(Circle(Frame(), 2), half);
  EXPECT_TRUE(met.points.empty());
  ASSERT_EQ(met.on_surface.size(), 1u);
  EXPECT_NEAR(met.on_surface[0].lo, 0, 1e-9);
  EXPECT_NEAR(met.on_surface[0].hi, kPi, 1e-9);
}

}  // namespace
}  // namespace lekalo::geometry
