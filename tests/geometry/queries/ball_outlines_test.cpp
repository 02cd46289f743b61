// Sections of balls against closed forms.
#include "geometry/queries/ball_outlines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace lekalo::geometry {
namespace {

double length_of(const ShapeOutlines& found, const Vec3& origin, const Vec3& normal) {
  double length = 0;
  for (const ShapeOutline& line : found.lines) {
    EXPECT_TRUE(line.edge);
    const Interval t = line.curve->domain();
    const CurveJet middle = line.curve->evaluate(t.middle(), 1);
    EXPECT_NEAR(glm::dot(middle.d[0] - origin, glm::normalize(normal)), 0, 1e-15);
    length += t.width() * glm::length(middle.d[1]);  // circles
  }
  return length;
}

TEST(BallOutlines, SectionsByPlanes) {
  const ViewOf view{false, {0, 0, -1}};
  const Balls balls(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {9, 0, 0}}, std::vector<double>{1, 1, 0.5});
  // Through both middles of two balls that meet: each loses a third of its circle.
  const Vec3 normal(0, 0.6, 0.8);
  EXPECT_NEAR(length_of(plane_section(balls, {0, 0, 0}, 2.0 * normal, view), {0, 0, 0}, normal),
              2 * kTwoPi * 2 / 3 + kTwoPi * 0.5, 1e-13);
  // Beyond the first ball's part that is inside of the other.
  EXPECT_NEAR(length_of(plane_section(balls, {-0.6, 0, 0}, {1, 0, 0}, view), {-0.6, 0, 0}, {1, 0, 0}), kTwoPi * 0.8,
              1e-13);
  EXPECT_TRUE(plane_section(balls, {4, 0, 0}, {1, 0, 0}, view).lines.empty());
  // Seen from above a circle in a plane that holds the way of sight turns away at its top and bottom.
  const auto upright =
      plane_section(Balls(std::vector<Vec3>{{0, 0, 0}}, std::vector<double>{2}), {0, 0, 0}, {0, 1, 0}, view);
  ASSERT_EQ(upright.lines.size(), 1u);
  for (const double turn : upright.lines[0].turns) EXPECT_NEAR(upright.lines[0].curve->point(turn).z, 0, 1e-12);
  EXPECT_GE(upright.lines[0].turns.size(), 2u);
}

}  // namespace
}  // namespace lekalo::geometry
