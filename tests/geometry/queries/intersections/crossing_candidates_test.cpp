// Places where curves may pass through surfaces: none of the certified intersections may be missing among them.
#include "geometry/queries/intersections/crossing_candidates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/operations/parameter_line.h"
#include "geometry/curves/splines/bezier_curve.h"
#include "geometry/queries/intersections/curve_intersections.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/surfaces/splines/bezier_surface.h"
#include "support/tier.h"

namespace lekalo::geometry::crossing_candidates_test {
namespace {

constexpr double kTouch = 1e-9;
constexpr int kMany = 1 << 20;

std::vector<double> crossing_candidates(const Curve& curve, const Surface& surface, double end_share = 1e-6) {
  CurveCells cells(curve, end_share);
  SurfaceCells of_surface(surface);
  std::vector<double> places;
  EXPECT_TRUE(add_crossing_candidates(cells, of_surface, kTouch, kMany, kMany, places));
  std::sort(places.begin(), places.end());
  // A place on a border of cells comes from each of them.
  places.erase(std::unique(places.begin(), places.end(), [](double a, double b) { return b - a < 1e-8; }),
               places.end());
  return places;
}

TEST(Passages, OfASegmentThroughASphere) {
  const SphereSurface sphere(Frame(), 1);
  const std::vector<double> places = crossing_candidates(Segment({-2, 0.6, 0}, {2, 0.6, 0}), sphere);
  ASSERT_EQ(places.size(), 2u);
  EXPECT_NEAR(places[0], 0.3, 1e-14);
  EXPECT_NEAR(places[1], 0.7, 1e-14);
  EXPECT_TRUE(crossing_candidates(Segment({-2, 1.0001, 0}, {2, 1.0001, 0}), sphere).empty());
}

// A line through a cell's corner, an edge of the domain and a pole.
TEST(Passages, AtBordersOfCells) {
  const SphereSurface sphere(Frame(), 1);
  for (const Vec3& way : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 1, 0), Vec3(1, 1, 1)}) {
    const std::vector<double> places =
        crossing_candidates(Segment(-2.0 * glm::normalize(way), 2.0 * glm::normalize(way)), sphere);
    for (const double expected : {0.25, 0.75})
      EXPECT_TRUE(std::any_of(places.begin(), places.end(), [&](double t) { return std::abs(t - expected) < 1e-9; }))
          << way.x << way.y << way.z;
  }
}

TEST(Passages, AreTheCertifiedIntersections) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1), weight(0.3, 3);
  const auto point = [&] { return Vec3(unit(random), unit(random), unit(random)); };
  int intersections = 0, more = 0;
  for (int k = 0; k < tests::tier_count(5000, 100); ++k) {
    Grid<Vec3> net{4, 3, {}};
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 3; ++j) net.values.push_back({0.7 * i - 1 + 0.4 * unit(random), j - 1.0, 0.8 * unit(random)});
    const NurbsSurface patch = bezier_surface(net);
    std::vector<Vec3> points{point(), point(), point(), point()};
    const std::vector<double> weights{1, weight(random), weight(random), 1};
    const NurbsCurve curve = bezier_curve(points, weights);
    const std::vector<double> places = crossing_candidates(curve, patch, 0);
    const SurfaceIntersections met = intersect(curve, patch);
    for (const SurfaceIntersection& one : met.points) {
      ++intersections;
      EXPECT_TRUE(std::any_of(places.begin(), places.end(), [&](double t) { return std::abs(t - one.t) < 1e-7; })) << k;
    }
    more += static_cast<int>(places.size() > met.points.size());
  }
  EXPECT_GT(intersections, 50);
  tests::report_figure("meetings", intersections);
  tests::report_figure("with_more_places", more);
}

// Curves that begin on the border of a patch, many in its tangent plane, away from it or into it, and come back.
TEST(Passages, OfCurvesThatBeginOnABorder) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto point = [&] { return Vec3(unit(random), unit(random), unit(random)); };
  int intersections = 0, more = 0;
  for (int k = 0; k < tests::tier_count(20000, 200); ++k) {
    Grid<Vec3> net{4, 4, {}};
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        net.values.push_back({0.7 * i - 1 + 0.2 * unit(random), 0.7 * j - 1 + 0.2 * unit(random), 0.8 * unit(random)});
    const NurbsSurface patch = bezier_surface(net);
    const double along = k % 8 == 0 ? 0 : 0.5 + 0.5 * unit(random), border = k % 2;
    const double u = k % 4 < 2 ? along : border, v = k % 4 < 2 ? border : along;
    const SurfaceJet at = patch.evaluate(u, v, 1);
    const Vec3 tangent = unit(random) * at.du() + unit(random) * at.dv() + (k % 3 == 0 ? 0.3 * point() : Vec3(0));
    std::vector<Vec3> points{at.point(), at.point() + 0.5 * tangent, 1.5 * point(), 1.5 * point()};
    if (k % 5 == 0) std::reverse(points.begin(), points.end());
    const NurbsCurve curve = bezier_curve(points, {});
    const std::vector<double> places = crossing_candidates(curve, patch);
    size_t expected = 0;
    for (const SurfaceIntersection& one : intersect(curve, patch).points) {
      if (one.t < 2e-6 || one.t > 1 - 2e-6 || one.contact) continue;
      ++intersections, ++expected;
      // Or the ends of a stretch where it is nearer than kTouch.
      EXPECT_TRUE(std::any_of(places.begin(), places.end(), [&](double t) { return std::abs(t - one.t) < 1e-5; })) << k;
    }
    more += static_cast<int>(places.size() > expected);
  }
  EXPECT_GT(intersections, 50);
  tests::report_figure("meetings", intersections);
  tests::report_figure("with_more_places", more);
}

TEST(Passages, KnowWhatRunsAlong) {
  const auto ring = std::make_shared<TorusSurface>(Frame(), 2.0, 0.7);
  const ParameterLine line(ring, IsoDirection::v, 0.4);
  CurveCells cells(line);
  SurfaceCells of_ring(*ring);
  std::vector<double> places{0.5};
  EXPECT_FALSE(add_crossing_candidates(cells, of_ring, kTouch, 6, kMany, places));
  EXPECT_EQ(places, std::vector<double>{0.5});
  for (const double t : {0.1, 2.0, 5.5}) EXPECT_TRUE(of_ring.holds(line.point(t), 1e-12));
  EXPECT_FALSE(of_ring.holds(line.point(1.0) + Vec3(0, 0, 1e-9), 1e-12));
}

// A line that leaves a surface at its border, tangent to it.
TEST(Passages, EndsThatTouchAreNone) {
  const auto ball = std::make_shared<SphereSurface>(Frame(), 1.0);
  const SphereSurface cap(Frame(), 1.0, Rectangle{{0, kTwoPi}, {0.3, kPi / 2}});
  const ParameterLine below(ball, IsoDirection::u, 1.1, Interval(-1.2, 0.3));
  EXPECT_TRUE(crossing_candidates(below, cap).empty());
}

}  // namespace
}  // namespace lekalo::geometry::crossing_candidates_test
