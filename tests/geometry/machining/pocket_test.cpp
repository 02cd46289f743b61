// Pockets: regions inside of contours, their trapezoids and the way through them (Zavyalov et al. 1985, V.2).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/polyline.h"
#include "geometry/describe.h"
#include "geometry/machining/pocket_plan.h"

namespace lekalo::geometry::pocket_test {
namespace {

CurvePtr rectangle(double x, double y, double width, double height) {
  const std::vector<Vec3> corners = {{x, y, 0}, {x + width, y, 0}, {x + width, y + height, 0}, {x, y + height, 0}};
  return std::make_shared<NurbsCurve>(polyline(corners, true));
}

CurvePtr circle(double x, double y, double radius) {
  return std::make_shared<Circle>(frame_about({x, y, 0}, {0, 0, 1}), radius);
}

double distance_to_rims(const PocketRegion& region, const Vec2& p) {
  double least = kInfinity;
  for (const Polygon2& rim : region.rims)
    for (size_t k = 0; k < rim.size(); ++k) {
      const Vec2 a = rim[k], side = rim[(k + 1) % rim.size()] - a;
      const double t = std::clamp(glm::dot(p - a, side) / glm::dot(side, side), 0.0, 1.0);
      least = std::min(least, glm::length(p - a - t * side));
    }
  return least;
}

TEST(PocketRegions, OfARectangleIsARectangle) {
  const PocketRegion region = inset_region(*rectangle(0, 0, 8, 5), {}, 0.5, 0.7);
  ASSERT_EQ(region.rims.size(), 1u);
  EXPECT_EQ(region.rims[0].size(), 4u);
  EXPECT_NEAR(area(region), (8 - 1.2) * (5 - 1.2), 1e-12);
}

TEST(PocketRegions, RoundsTheCornersOfIslands) {
  // The island's offset: its square, four strips and four quarters of a disc, but for the chords of the arcs.
  const PocketRegion region = inset_region(*rectangle(0, 0, 10, 10), {rectangle(4, 4, 2, 2)}, 0.5, 0.52);
  ASSERT_EQ(region.rims.size(), 2u);
  const double d = 0.51, whole = (10 - 2 * d) * (10 - 2 * d) - (4 + 8 * d + kPi * d * d);
  EXPECT_NEAR(area(region), whole, 2 * kPi * d * 0.005);
}

TEST(PocketRegions, RunsInTheBand) {
  const CurvePtr outer = circle(0, 0, 5), island = circle(1, 0.5, 1.5);
  const PocketRegion region = inset_region(*outer, {island}, 0.3, 0.4);
  ASSERT_EQ(region.rims.size(), 2u);
  for (const Polygon2& rim : region.rims) {
    const bool is_outer = signed_area(rim) > 0;
    for (size_t k = 0; k < rim.size(); ++k)
      for (const double t : {0.0, 0.25, 0.5, 0.75}) {
        const Vec2 p = glm::mix(rim[k], rim[(k + 1) % rim.size()], t);
        const double d = is_outer ? 5 - glm::length(p) : glm::length(p - Vec2(1, 0.5)) - 1.5;
        EXPECT_GE(d, 0.3 - 1e-12);
        EXPECT_LE(d, 0.4 + 1e-12);
      }
  }
}

TEST(PocketRegions, DropsWhatIsTooNarrow) {
  // Two rooms and a corridor of width 1 between them.
  const std::vector<Vec3> corners = {{0, 0, 0},  {4, 0, 0}, {4, 1.5, 0}, {6, 1.5, 0}, {6, 0, 0}, {10, 0, 0},
                                     {10, 4, 0}, {6, 4, 0}, {6, 2.5, 0}, {4, 2.5, 0}, {4, 4, 0}, {0, 4, 0}};
  const NurbsCurve rooms = polyline(corners, true);
  EXPECT_EQ(inset_region(rooms, {}, 0.3, 0.4).rims.size(), 1u);
  const PocketRegion apart = inset_region(rooms, {}, 0.6, 0.7);
  ASSERT_EQ(apart.rims.size(), 2u);
  // Before the corridor both reach between the arcs about its corners, by 2 int_0^0.5 d - sqrt(d^2 - s^2) ds; chords of
  // the arcs leave less than 0.025 of their length more.
  const double d = 0.65, between = 2 * (0.5 * d - 0.25 * std::sqrt(d * d - 0.25) - 0.5 * d * d * std::asin(0.5 / d));
  EXPECT_NEAR(area(apart), 2 * (4 - 2 * d) * (4 - 2 * d) + 2 * between, 4 * 0.025 * d * std::asin(0.5 / d));
  EXPECT_THROW(inset_region(rooms, {}, 2.1, 2.2), FieldError);
}

TEST(PocketRegions, HaveContoursThatDoNotCrossThemselves) {
  const std::vector<Vec3> loops = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {4, 4, 0}};
  const std::vector<Vec3> touching = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 0, 0}, {0, 4, 0}};
  const CurvePtr crossed = std::make_shared<NurbsCurve>(polyline(loops, true));
  EXPECT_THROW(inset_region(*crossed, {}, 0.1, 0.2), FieldError);
  EXPECT_THROW(inset_region(*rectangle(-5, -5, 20, 20), {crossed}, 0.1, 0.2), FieldError);
  EXPECT_EQ(inset_region(polyline(touching, true), {}, 0.1, 0.2).rims.size(), 2u);
}

TEST(PocketRegions, JoinsIslandsThatAreNear) {
  const PocketRegion region =
      inset_region(*rectangle(-5, -5, 10, 10), {circle(-1.2, 0, 1), circle(1.2, 0, 1)}, 0.4, 0.42);
  EXPECT_EQ(region.rims.size(), 2u);
  EXPECT_GT(distance_to_rims(region, {0, 0}), 0.4);
}

TEST(Trapezoids, CoverTheRegion) {
  const PocketRegion region =
      inset_region(*circle(0, 0, 5), {circle(1, 0.5, 1.2), rectangle(-3, -2, 1.5, 1)}, 0.2, 0.3);
  ASSERT_EQ(region.rims.size(), 3u);
  const TrapezoidSplit split = trapezoid_split(region);
  double sum = 0;
  for (const Trapezoid& one : split.trapezoids) {
    EXPECT_GT(one.x.width(), 0);
    EXPECT_GE(one.upper[0], one.lower[0]);
    EXPECT_GE(one.upper[1], one.lower[1]);
    sum += one.area();
  }
  EXPECT_NEAR(sum, area(region), 1e-9);
  // Cycles of the graph of contacts are one for each hole.
  EXPECT_EQ(split.contacts.size() + 1, split.trapezoids.size() + 2);
}

TEST(Trapezoids, OfARectangleAreOne) {
  const TrapezoidSplit split = trapezoid_split({{{{0, 0}, {4, 0}, {4, 2}, {0, 2}}}});
  ASSERT_EQ(split.trapezoids.size(), 1u);
  EXPECT_EQ(split.trapezoids[0].center(), Vec2(2, 1));
  EXPECT_TRUE(split.contacts.empty());
}

TEST(Trapezoids, ApexOfATriangleCountsTwice) {
  const TrapezoidSplit split = trapezoid_split({{{{0, 0}, {4, -1}, {4, 3}}}});
  ASSERT_EQ(split.trapezoids.size(), 1u);
  EXPECT_EQ(split.trapezoids[0].center(), Vec2(2, 0.5));
}

TEST(PocketPlan, PathStaysInTheRegion) {
  const PocketContours contours{circle(0, 0, 5), {circle(1, 0.5, 1.2), rectangle(-3, -2, 1.5, 1)}};
  for (const Vec3& upright : {Vec3(0, 1, 0), Vec3(1, 1, 0), Vec3(1, 0, 0)}) {
    std::vector<Vec3> path;
    const PocketPlan plan = pocket_plan(contours, {0.2, {0.05, 0.15}, 0.3, 0.2}, upright, path);
    for (size_t k = 1; k < path.size(); ++k)
      for (const double t : {0.0, 0.3, 0.7, 1.0}) {
        const Vec2 p(glm::mix(path[k - 1], path[k], t));
        EXPECT_GE(5 - glm::length(p), 0.25 - 1e-9);
        EXPECT_GE(glm::length(p - Vec2(1, 0.5)) - 1.2, 0.25 - 1e-9);
      }
    EXPECT_EQ(plan.finishing.rims.size(), 3u);
    const std::vector<int> walk = vertices_of(plan.route.walk, plan.route.start);
    EXPECT_EQ(std::set<int>(walk.begin(), walk.end()).size(), plan.split.trapezoids.size());
  }
}

}  // namespace
}  // namespace lekalo::geometry::pocket_test
