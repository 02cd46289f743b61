// Lines of equal value of functions on surfaces, against their formulas.
#include "geometry/queries/contours/level_lines.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/queries/differential/curvature.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/torus.h"

namespace lekalo::geometry::level_lines_test {
namespace {

double length(const std::vector<Vec2>& places, bool closed) {
  double sum = closed ? glm::length(places.front() - places.back()) : 0;
  for (size_t k = 1; k < places.size(); ++k) sum += glm::length(places[k] - places[k - 1]);
  return sum;
}

TEST(LevelLines, CirclesInAPlane) {
  const Plane plane(Frame(), Rectangle{{-2, 2}, {-2, 2}});
  const auto lines = level_lines(
      plane, [](double u, double v) { return u * u + v * v; }, 1.44);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_TRUE(lines[0].closed);
  for (const Vec2& place : lines[0].places) EXPECT_NEAR(glm::length(place), 1.2, 1e-12);
  EXPECT_NEAR(length(lines[0].places, true), kTwoPi * 1.2, 1e-2);
  // Cut by the border: four arcs.
  EXPECT_EQ(level_lines(
                plane, [](double u, double v) { return u * u + v * v; }, 4.41)
                .size(),
            4u);
  EXPECT_TRUE(level_lines(
                  plane, [](double u, double v) { return u * u + v * v; }, 9)
                  .empty());
}

// Where it crosses itself, branches go through, or turn away from each other; none ends inside.
TEST(LevelLines, Cross) {
  const Plane plane(Frame(), Rectangle{{-1, 1.1}, {-1, 1.2}});
  double sum = 0;
  for (const LevelLine& line : level_lines(
           plane, [](double u, double v) { return u * u - v * v; }, 0)) {
    sum += length(line.places, line.closed);
    for (const Vec2& place : line.places) EXPECT_NEAR(std::abs(place.x), std::abs(place.y), 1e-12);
  }
  // Both diagonals, less what is cut off in the cell where they cross.
  EXPECT_NEAR(sum, std::sqrt(2.0) * 4.1, 2.2 / 64);
}

// The parabolic circles of a torus, v = +-pi/2.
TEST(LevelLines, ParabolicLines) {
  const TorusSurface torus(Frame(), 3, 1);
  const auto lines = level_lines(
      torus, [&](double u, double v) { return curvature(torus, u, v).gaussian; }, 0);
  ASSERT_EQ(lines.size(), 2u);
  for (const LevelLine& line : lines)
    for (const Vec2& place : line.places) EXPECT_NEAR(std::cos(place.y), 0, 1e-12);
}

// A jump is no line, and neither is a place without a value.
TEST(LevelLines, JumpsAndHoles) {
  const Plane plane(Frame(), Rectangle{{-1, 1}, {-1, 1}});
  EXPECT_TRUE(level_lines(
                  plane, [](double u, double) { return u < 0.01 ? std::nan("") : u + 0.5; }, 0)
                  .empty());
  EXPECT_TRUE(level_lines(
                  plane, [](double u, double) { return u < 0.11 ? -1.0 : 1.0; }, 0)
                  .empty());
  // tan(3 u) = 5 twice; its two poles are no lines.
  const auto lines = level_lines(
      plane, [](double u, double) { return std::sin(3 * u) / std::cos(3 * u); }, 5);
  ASSERT_EQ(lines.size(), 2u);
  for (const LevelLine& line : lines)
    for (const Vec2& place : line.places) EXPECT_NEAR(std::tan(3 * place.x), 5, 1e-9);
}

}  // namespace
}  // namespace lekalo::geometry::level_lines_test
