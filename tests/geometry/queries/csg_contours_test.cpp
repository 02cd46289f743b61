// Sections of solids that are put together of others: their lengths against closed forms.
#include "geometry/queries/csg_contours.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/bodies/primitives.h"
#include "geometry/queries/mass_properties.h"
#include "geometry/shapes/body_shape.h"
#include "geometry/shapes/half_space.h"

namespace lekalo::geometry {
namespace {

using Operation = Csg::Operation;

ShapePtr shape_of(Body body) { return std::make_shared<BodyShape>(std::make_shared<Body>(std::move(body))); }
ShapePtr cube() { return shape_of(box(frame_from({-1, -1, -1}, {0, 0, 1}, {1, 0, 0}), {2, 2, 2})); }
ShapePtr ball_at(const Vec3& center, double radius) {
  return shape_of(ball(frame_from(center, {0, 0, 1}, {1, 0, 0}), radius));
}

// Of all lines of the section, which lie in the plane.
double length_of_section(const Csg& solid, const Vec3& origin, const Vec3& normal) {
  const CsgLines section = csg_section(solid, origin, normal);
  EXPECT_TRUE(section.complete);
  double length = 0;
  for (const CsgLine& line : section.lines) {
    const Interval t = line.curve->domain();
    length += arc_length(*line.curve, t.lo, t.hi).value;
    for (const double x : {0.1, 0.4, 0.9})
      EXPECT_NEAR(glm::dot(line.curve->point(t.lo + x * t.width()) - origin, normal), 0, 1e-10);
  }
  return length;
}

TEST(CsgSection, OfADifference) {
  const Csg cup(Operation::subtract, {cube(), ball_at({0, 0, 1}, 0.5)});
  // A square with half a circle out of its upper side.
  EXPECT_NEAR(length_of_section(cup, {0, 0, 0}, {2, 0, 0}), 8 - 1 + 0.5 * kPi, 1e-9);
  // Below the ball a square, above it cut by a circle's chord: none of the ball is left out at z = 0.8 but the circle.
  EXPECT_NEAR(length_of_section(cup, {0, 0, 0.2}, {0, 0, 1}), 8, 1e-9);
  EXPECT_NEAR(length_of_section(cup, {0, 0, 0.8}, {0, 0, 1}), 8 + kTwoPi * std::sqrt(0.25 - 0.04), 1e-9);
  EXPECT_EQ(length_of_section(cup, {0, 0, 1.5}, {0, 0, 1}), 0);
}

TEST(CsgSection, OfAUnionAndAnIntersection) {
  // Two unit circles whose centres are 1 apart, 2 pi / 3 of each inside of the other.
  const std::vector<ShapePtr> balls = {ball_at({0, 0, 0}, 1), ball_at({1, 0, 0}, 1)};
  EXPECT_NEAR(length_of_section(Csg(Operation::unite, balls), {0, 0, 0}, {0, 0, 1}), 2 * (kTwoPi - kTwoPi / 3), 1e-9);
  EXPECT_NEAR(length_of_section(Csg(Operation::intersect, balls), {0, 0, 0}, {0, 0, 1}), 2 * kTwoPi / 3, 1e-9);
}

TEST(CsgSection, OfAHalfSpace) {
  const Csg part(Operation::intersect,
                 {ball_at({0, 0, 0}, 1), std::make_shared<HalfSpaceShape>(Vec3(0, 0, 0.3), Vec3(0, 0, 1))});
  const double chord = 2 * std::sqrt(1 - 0.09), arc = 2 * (kPi - std::acos(0.3));
  EXPECT_NEAR(length_of_section(part, {0, 0, 0}, {1, 0, 0}), chord + arc, 1e-9);
}

}  // namespace
}  // namespace lekalo::geometry
