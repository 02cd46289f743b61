// Intersections of curves with curves and surfaces: the checks of Golovanov 2016, 4.3 and 4.4, closed forms, and random
// pairs against counts of chords.
#include "geometry/queries/intersections/curve_intersections.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/ellipse.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/splines/bezier_curve.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/splines/bezier_surface.h"
#include "support/root_oracle.h"
#include "support/tier.h"

namespace lekalo::geometry::curve_intersections_test {
namespace {

Frame at(const Vec3& origin) {
  Frame frame;
  frame.origin = origin;
  return frame;
}

TEST(TwoCurves, SegmentsCrossInTheMiddle) {
  const CurveIntersections met = intersect(Segment({0, 0, 0}, {4, 2, 0}), Segment({1, 3, 0}, {3, -1, 0}));
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
  const CurveIntersections met = intersect(Ellipse(Frame(), 3, 1), Ellipse(turned, 3, 1));
  ASSERT_EQ(met.points.size(), 4u);
  for (const CurveIntersection& one : met.points) {
    EXPECT_NEAR(std::abs(one.point.x), std::sqrt(0.9), 1e-15);
    EXPECT_NEAR(std::abs(one.point.y), std::sqrt(0.9), 1e-15);
    EXPECT_FALSE(one.contact);
  }
}

TEST(TwoCurves, CirclesTouchFromOutsideAndFromInside) {
  for (const double x : {3.0, 1.0}) {
    const CurveIntersections met = intersect(Circle(Frame(), 2), Circle(at({x, 0, 0}), 1));
    ASSERT_EQ(met.points.size(), 1u) << x;
    EXPECT_TRUE(met.points[0].contact);
    EXPECT_LT(glm::length(met.points[0].point - Vec3(2, 0, 0)), 1e-14);
  }
}

TEST(TwoCurves, CirclesThatNearlyTouchAreToldApart) {
  EXPECT_EQ(intersect(Circle(Frame(), 2), Circle(at({3 - 1e-6, 0, 0}), 1)).points.size(), 2u);
  EXPECT_EQ(intersect(Circle(Frame(), 2), Circle(at({3 + 1e-6, 0, 0}), 1)).points.size(), 0u);
}

// Of radius 1 about the origin: four quarters.
NurbsCurve circle_as_nurbs() {
  const double w = std::sqrt(0.5);
  return NurbsCurve(
      SplineAxis(2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}, Extension::tangent),
      std::vector<Vec3>{
          {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}, {0, -1, 0}, {1, -1, 0}, {1, 0, 0}},
      std::vector<double>{1, w, 1, w, 1, w, 1, w, 1});
}

// y = x^2, its speed that of x.
NurbsCurve parabola(double rise = 1, double by = 0) {
  return bezier_curve(std::vector<Vec3>{{-1, rise + by, 0}, {0, -rise + by, 0}, {1, rise + by, 0}});
}

// A crossing at each of the places, of points of z = 0 along x, and no contact. y is known to `rounding`, x by the
// slope worse.
void expect_crossings(const CurveIntersections& met, const std::vector<double>& x, double slope, const char* what) {
  ASSERT_EQ(met.points.size(), x.size()) << what << " x " << x[0];
  std::vector<double> found;
  for (const CurveIntersection& one : met.points) {
    EXPECT_FALSE(one.contact) << what << " x " << one.point.x;
    found.push_back(one.point.x);
  }
  std::sort(found.begin(), found.end());
  for (size_t k = 0; k < x.size(); ++k) EXPECT_NEAR(found[k], x[k], 4e-16 / slope) << what;
}

// The operands are within the tolerance of each other all the way between two crossings: these are none the less two,
// whatever the form of the curves, and where the sagitta is rounding they are a contact.
TEST(TwoCurves, CrossingsBesideATangentAreTwo) {
  const Circle circle(Frame(), 1);
  const NurbsCurve rational = circle_as_nurbs();
  for (const double d : {1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12}) {
    const Segment chord({-2, 1 - d, 0}, {2, 1 - d, 0}), upright({1 - d, -2, 0}, {1 - d, 2, 0});
    const double depth = 1 - (1 - d), x = std::sqrt(depth * (2 - depth));
    expect_crossings(intersect(circle, chord), {-x, x}, x, "circle");
    expect_crossings(intersect(rational, chord), {-x, x}, x, "circle as NURBS");
    EXPECT_EQ(intersect(circle, upright).points.size(), 2u) << "at the seam " << d;
    expect_crossings(intersect(parabola(), Segment({-2, d, 0}, {2, d, 0})), {-std::sqrt(d), std::sqrt(d)},
                     2 * std::sqrt(d), "parabola");
    expect_crossings(intersect(parabola(), parabola(-1, d)), {-std::sqrt(d / 2), std::sqrt(d / 2)},
                     2 * std::sqrt(d / 2), "parabolas");
  }
  for (const double d : {1e-15, 0.0, -1e-15, -1e-10}) {
    for (const Curve* curve : {static_cast<const Curve*>(&circle), static_cast<const Curve*>(&rational)}) {
      const CurveIntersections met = intersect(*curve, Segment({-2, 1 - d, 0}, {2, 1 - d, 0}));
      ASSERT_EQ(met.points.size(), 1u) << d;
      EXPECT_TRUE(met.points[0].contact) << d;
    }
  }
}

// Cubics through the origin, flat there to the second order: a crossing with parallel tangents.
TEST(TwoCurves, AnInflectionCrossesItsTangent) {
  const NurbsCurve cubic = bezier_curve(std::vector<Vec3>{{-1, -1, 0}, {-1.0 / 3, 1, 0}, {1.0 / 3, -1, 0}, {1, 1, 0}});
  const CurveIntersections met = intersect(cubic, Segment({-1, 0, 0}, {1, 0, 0}));
  ASSERT_EQ(met.points.size(), 1u);
  EXPECT_TRUE(met.points[0].contact);
  EXPECT_NEAR(met.points[0].s, 0.5, 1e-3);  // y stays below the tolerance as far as its cube root
}

TEST(TwoCurves, AlmostParallelSegmentsCross) {
  for (const double slope : {1e-3, 1e-5, 1e-7}) {
    const CurveIntersections met = intersect(Segment({-1, 0, 0}, {1, 0, 0}), Segment({-1, -slope, 0}, {1, slope, 0}));
    ASSERT_EQ(met.points.size(), 1u) << slope;
    EXPECT_NEAR(met.points[0].s, 0.5, 1e-15 / slope) << slope;
  }
}

TEST(TwoCurves, ArcsOfOneCircleHaveAPartInCommon) {
  const Circle whole(Frame(), 2), arc(Frame(), 2, {-1, 1});
  const CurveIntersections met = intersect(arc, whole);
  EXPECT_TRUE(met.points.empty());
  ASSERT_EQ(met.common.size(), 1u);
  EXPECT_NEAR(met.common[0].s.lo, -1, 1e-12);
  EXPECT_NEAR(met.common[0].s.hi, 1, 1e-12);
  EXPECT_NEAR(met.common[0].end - met.common[0].begin, 2, 1e-12);
}

TEST(TwoCurves, SegmentsOnOneLineShareWhatBothCover) {
  const CurveIntersections met = intersect(Segment({0, 0, 0}, {4, 2, 0}), Segment({6, 3, 0}, {2, 1, 0}));
  EXPECT_TRUE(met.points.empty());
  ASSERT_EQ(met.common.size(), 1u);
  EXPECT_NEAR(met.common[0].s.lo, 0.5, 1e-12);
  EXPECT_NEAR(met.common[0].s.hi, 1, 1e-12);
  EXPECT_NEAR(met.common[0].begin, 1, 1e-12);
  EXPECT_NEAR(met.common[0].end, 0.5, 1e-12);
}

TEST(CurveAndSurface, ALineMeetsAPlane) {
  const SurfaceIntersections met = intersect(Segment({0, 0, 5}, {0, 5, -5}), Plane(at({0, 0, 1})));
  ASSERT_EQ(met.points.size(), 1u);
  EXPECT_LT(glm::length(met.points[0].point - Vec3(0, 2, 1)), 1e-15);
}

TEST(CurveAndSurface, ALineMeetsTouchesOrMissesASphere) {
  const SphereSurface sphere(Frame(), 2);
  const SurfaceIntersections through = intersect(Segment({-5, 0.5, 0.25}, {5, 0.5, 0.25}), sphere);
  ASSERT_EQ(through.points.size(), 2u);
  for (const SurfaceIntersection& one : through.points) EXPECT_NEAR(glm::length(one.point), 2, 1e-15);
  const SurfaceIntersections along =
      intersect(Segment({-5, 2 * std::cos(0.3), 2 * std::sin(0.3)}, {5, 2 * std::cos(0.3), 2 * std::sin(0.3)}), sphere);
  ASSERT_EQ(along.points.size(), 1u);
  EXPECT_TRUE(along.points[0].contact);
  EXPECT_NEAR(along.points[0].t, 0.5, 1e-14);
  EXPECT_TRUE(intersect(Segment({-5, 2.1, 0}, {5, 2.1, 0}), sphere).points.empty());
}

TEST(CurveAndSurface, CrossingsBesideATangentPlaneAreTwo) {
  for (const double d : {1e-7, 1e-9, 1e-10, 1e-11, 1e-12}) {
    const SurfaceIntersections met = intersect(Segment({-2, 1 - d, 0}, {2, 1 - d, 0}), SphereSurface(Frame(), 1));
    const double depth = 1 - (1 - d), x = std::sqrt(depth * (2 - depth));
    ASSERT_EQ(met.points.size(), 2u) << d;
    EXPECT_NEAR(met.points[0].point.x, -x, 4e-16 / x) << d;
    EXPECT_NEAR(met.points[1].point.x, x, 4e-16 / x) << d;
    EXPECT_FALSE(met.points[0].contact || met.points[1].contact) << d;
  }
}

TEST(CurveAndSurface, ASmallCurveMeetsALargeSurface) {
  const SphereSurface sphere(Frame(), 1000);
  const SurfaceIntersections met = intersect(Segment({999.999, 0.5, 0.25}, {1000.001, 0.5, 0.25}), sphere);
  ASSERT_EQ(met.points.size(), 1u);
  EXPECT_NEAR(glm::length(met.points[0].point), 1000, 1e-12);
  EXPECT_TRUE(met.on_surface.empty());
}

TEST(CurveAndSurface, ACircleLiesOnACylinderAsFarAsThatGoes) {
  const CylinderSurface half(at({0, 0, -1}), 2, 2, {{0, kPi}, {0, 1}});
  const SurfaceIntersections met = intersect(Circle(Frame(), 2), half);
  EXPECT_TRUE(met.points.empty());
  ASSERT_EQ(met.on_surface.size(), 1u);
  EXPECT_NEAR(met.on_surface[0].lo, 0, 1e-9);
  EXPECT_NEAR(met.on_surface[0].hi, kPi, 1e-9);
}

// Random pairs against halving.

using tests::Bernstein;

double unit(std::mt19937_64& random) { return std::uniform_real_distribution<double>(0, 1)(random); }

struct RandomPoints {
  std::vector<Vec3> points;
  std::vector<double> weights;
};
RandomPoints random_points(std::mt19937_64& random, int count, bool flat) {
  RandomPoints result;
  for (int k = 0; k < count; ++k) {
    result.points.emplace_back(unit(random), unit(random), flat ? 0 : unit(random));
    result.weights.push_back(std::pow(10.0, unit(random) - 0.5));
  }
  return result;
}
Bernstein<4> homogeneous(const RandomPoints& from, const std::array<int, 3>& degree) {
  Bernstein<4> form;
  form.degree = degree;
  for (size_t k = 0; k < from.points.size(); ++k) {
    const double w = from.weights[k];
    form.c.push_back({w * from.points[k].x, w * from.points[k].y, w * from.points[k].z, w});
  }
  return form;
}

// Two forms of disjoint parameters; boxes of their points.
using Pair = std::array<Bernstein<4>, 2>;
bool boxes_meet(const Pair& pair) {
  Vec3 lo[2], hi[2];
  for (int side = 0; side < 2; ++side) {
    lo[side] = Vec3(kInfinity), hi[side] = Vec3(-kInfinity);
    for (const auto& c : pair[side].c) {
      const Vec3 p = Vec3(c[0], c[1], c[2]) / c[3];
      lo[side] = glm::min(lo[side], p), hi[side] = glm::max(hi[side], p);
    }
  }
  for (int k = 0; k < 3; ++k)
    if (lo[0][k] > hi[1][k] + 1e-13 || lo[1][k] > hi[0][k] + 1e-13) return false;
  return true;
}

TEST(RandomCurves, NoIntersectionInThePlaneIsLost) {
  std::mt19937_64 random(1);
  int compared = 0, met = 0, unclear_pairs = 0;
  for (int trial = tests::tier_count(10000); trial > 0; --trial) {
    const int n = 2 + trial % 5, m = 2 + trial / 5 % 5;
    const RandomPoints pa = random_points(random, n + 1, true), pb = random_points(random, m + 1, true);
    const Pair pair{homogeneous(pa, {n, 0, 0}), homogeneous(pb, {m, 0, 0})};
    bool unclear = false;
    const auto truth = tests::roots_by_halving<2, Pair>(
        pair, 1e-9, boxes_meet,
        [](const Pair& both, int axis, bool upper) {
          Pair part = both;
          part[axis] = both[axis].half(0, upper);
          return part;
        },
        unclear);
    if (unclear) {
      ++unclear_pairs;
      continue;
    }
    const CurveIntersections found =
        intersect(bezier_curve(pa.points, pa.weights), bezier_curve(pb.points, pb.weights));
    ++compared;
    met += static_cast<int>(truth.size());
    EXPECT_EQ(found.points.size(), truth.size()) << "pair " << trial;
    EXPECT_TRUE(found.common.empty());
    for (const auto& root : truth)
      EXPECT_TRUE(std::any_of(found.points.begin(), found.points.end(),
                              [&](const CurveIntersection& one) {
                                return std::abs(one.s - root[0]) < 1e-6 && std::abs(one.t - root[1]) < 1e-6;
                              }))
          << "pair " << trial << " at " << root[0] << ", " << root[1];
    for (const CurveIntersection& one : found.points) EXPECT_LT(one.distance, 1e-13);
  }
  EXPECT_GT(met, compared / 2);
  EXPECT_LT(unclear_pairs, compared / 50 + 2);
  tests::report_figure("pairs", compared);
  tests::report_figure("meetings", met);
}

TEST(RandomCurves, NoIntersectionWithASurfaceIsLost) {
  std::mt19937_64 random(2);
  int compared = 0, met = 0, unclear_pairs = 0;
  for (int trial = tests::tier_count(1000); trial > 0; --trial) {
    const int n = 2 + trial % 3;
    const RandomPoints curve = random_points(random, n + 1, false);
    RandomPoints net = random_points(random, 16, false);
    const Pair pair{homogeneous(curve, {n, 0, 0}), homogeneous(net, {0, 3, 3})};
    bool unclear = false;
    const auto truth = tests::roots_by_halving<3, Pair>(
        pair, 1e-7, boxes_meet,
        [](const Pair& both, int axis, bool upper) {
          Pair part = both;
          part[axis > 0] = both[axis > 0].half(axis, upper);
          return part;
        },
        unclear);
    if (unclear) {
      ++unclear_pairs;
      continue;
    }
    const SurfaceIntersections found =
        intersect(bezier_curve(curve.points, curve.weights), bezier_surface(Grid<Vec3>{4, 4, net.points}, net.weights));
    ++compared;
    met += static_cast<int>(truth.size());
    EXPECT_EQ(found.points.size(), truth.size()) << "pair " << trial;
    for (const auto& root : truth)
      EXPECT_TRUE(std::any_of(found.points.begin(), found.points.end(),
                              [&](const SurfaceIntersection& one) {
                                return std::abs(one.t - root[0]) < 1e-4 && std::abs(one.u - root[1]) < 1e-4 &&
                                       std::abs(one.v - root[2]) < 1e-4;
                              }))
          << "pair " << trial << " at " << root[0];
    for (const SurfaceIntersection& one : found.points) EXPECT_LT(one.distance, 1e-13);
  }
  EXPECT_GT(met, compared / 4);
  tests::report_figure("pairs", compared);
  tests::report_figure("unclear", unclear_pairs);
  tests::report_figure("meetings", met);
}

}  // namespace
}  // namespace lekalo::geometry::curve_intersections_test
