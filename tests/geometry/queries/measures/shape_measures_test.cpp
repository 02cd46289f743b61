// Measures by lines against closed forms: what is small beside the shape counts, and the stated error bounds the true
// one.
#include "geometry/queries/measures/shape_measures.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/curves/analytic/circle.h"
#include "geometry/shapes/csg/body_shape.h"
#include "geometry/shapes/csg/csg.h"
#include "geometry/shapes/csg/half_space.h"
#include "geometry/shapes/tube/balls.h"
#include "geometry/shapes/tube/tube.h"
#include "geometry/shapes/tube/tube_cases.h"

namespace lekalo::geometry::shape_measures_test {
namespace {

using Operation = Csg::Operation;

ShapePtr solid(Body body) { return std::make_shared<BodyShape>(std::make_shared<Body>(std::move(body))); }
ShapePtr solid_box(const Vec3& lo, const Vec3& hi) { return solid(box(Frame{lo}, hi - lo)); }
ShapePtr solid_ball(const Vec3& center, double radius) { return solid(ball(Frame{center}, radius)); }
ShapePtr combined(Operation operation, const std::vector<ShapePtr>& operands) {
  return std::make_shared<Csg>(operation, operands);
}
ShapePtr half_space(const Vec3& through, const Vec3& normal) {
  return std::make_shared<HalfSpaceShape>(through, glm::normalize(normal));
}
ShapePtr ring(double radius, const Vec3& center = Vec3(0)) {
  return std::make_shared<Tube>(std::make_shared<Circle>(Frame{center}, 1), RadiusLaw(radius), Caps::round);
}

double ball_area(double radius) { return 4 * kPi * radius * radius; }
double ball_volume(double radius) { return 4 * kPi / 3 * radius * radius * radius; }

// The measures are right within their errors, and these are no more than the parts of the truth.
void expect_measures(const Shape& shape, double area, double volume, double area_part, double volume_part) {
  const ShapeMeasures found = measure(shape);
  EXPECT_NEAR(found.area.value, area, found.area.error);
  EXPECT_NEAR(found.volume.value, volume, found.volume.error);
  EXPECT_GT(found.area.error, 0);
  EXPECT_GT(found.volume.error, 0);
  EXPECT_LT(found.area.error, area_part * area);
  EXPECT_LT(found.volume.error, volume_part * volume);
}

// A ring: 4 pi^2 R, 2 pi^2 R^2.
TEST(ShapeMeasures, ThinTubes) {
  for (const double radius : {1e-2, 1e-4, 1e-6, 1e-9})
    expect_measures(*ring(radius), 4 * kPi * kPi * radius, 2 * kPi * kPi * radius * radius, 0.06, 0.03);
  const CurvePtr axis = segment(Vec3(0), Vec3(1, 2, 2));
  for (const double radius : {1e-3, 1e-7}) {
    const double side = kTwoPi * radius * 3, volume = kPi * radius * radius * 3;
    expect_measures(Tube(axis, RadiusLaw(radius), Caps::round), side + ball_area(radius), volume + ball_volume(radius),
                    0.03, 0.01);
    expect_measures(Tube(axis, RadiusLaw(radius), Caps::flat), side + kTwoPi * radius * radius, volume, 0.03, 0.01);
  }
  // A cone: its rims are at the ends' own planes.
  const double slant = std::sqrt(1 + 1e-6), radii = 1e-3 + 2e-3;
  const Tube cone(segment(Vec3(0), Vec3(0, 0, 1)), RadiusLaw(law("0.001+0.001*s"), *segment(Vec3(0), Vec3(0, 0, 1))),
                  Caps::flat);
  const ShapeMeasures found = measure(cone);
  EXPECT_NEAR(found.volume.value, kPi / 3 * 7e-6, found.volume.error + 1e-5 * found.volume.value);
  EXPECT_NEAR(found.area.value, kPi * radii * slant + kPi * 5e-6, found.area.error + 1e-5 * found.area.value);
}

TEST(ShapeMeasures, SmallPartsFarApart) {
  const double area = ball_area(1) + ball_area(1e-4), volume = ball_volume(1) + ball_volume(1e-4);
  expect_measures(*combined(Operation::unite, {solid_ball(Vec3(0), 1), solid_ball(Vec3(1000), 1e-4)}), area, volume,
                  1e-3, 1e-3);
  const Vec3 centers[] = {Vec3(0), Vec3(1000)};
  const double radii[] = {1, 1e-4};
  expect_measures(Balls(centers, radii), area, volume, 1e-3, 1e-3);
  expect_measures(*combined(Operation::unite, {solid_ball(Vec3(0), 0.01), solid_ball({17, 0, 0}, 0.01)}),
                  2 * ball_area(0.01), 2 * ball_volume(0.01), 1e-2, 1e-3);
}

// Lines along the axes find a cube's volume to rounding; what is added or taken away is not lost beside it.
TEST(ShapeMeasures, SmallPartsOfWhatIsExact) {
  const ShapePtr cube = solid_box(Vec3(0), Vec3(1));
  const double small = ball_volume(1e-4);
  const auto volume = [](Operation operation, const std::vector<ShapePtr>& operands) {
    return measure(*combined(operation, operands)).volume;
  };
  const Measured alone = volume(Operation::unite, {cube});
  EXPECT_NEAR(alone.value, 1, alone.error);
  EXPECT_LT(alone.error, 1e-14);
  const Measured holed = volume(Operation::subtract, {cube, solid_ball(Vec3(0.4), 1e-4)});
  EXPECT_NEAR(holed.value, 1 - small, holed.error);
  EXPECT_LT(holed.error, 0.1 * small);
  const Measured with_far = volume(Operation::unite, {cube, solid_ball({3, 4, 5}, 1e-4)});
  EXPECT_NEAR(with_far.value, 1 + small, with_far.error);
  EXPECT_LT(with_far.error, 0.1 * small);
  const auto drill = std::make_shared<Tube>(segment({0.5, 0.5, -1}, {0.5, 0.5, 2}), RadiusLaw(1e-5), Caps::flat);
  const Measured drilled = volume(Operation::subtract, {cube, drill});
  EXPECT_NEAR(drilled.value, 1 - kPi * 1e-10, drilled.error);
  // A face that belongs to an operand which is no part of the whole there: crossings are counted all the same.
  const ShapePtr part =
      combined(Operation::intersect, {solid_box(Vec3(0), {3, 1, 1}), solid_box({2, 0, 0}, {3, 1, 1})});
  const Measured both = volume(Operation::unite, {part, cube});
  EXPECT_NEAR(both.value, 2, both.error);
}

TEST(ShapeMeasures, WhatNoLineMeets) {
  // A lens so thin that its faces' boxes are a million times its size; and one that a hidden part leaves open.
  const double h = 1e-9;
  const ShapePtr lens = combined(Operation::intersect, {solid_ball(Vec3(0), 1), solid_ball({2 - 2 * h, 0, 0}, 1)});
  try {
    measure(*lens);
    FAIL() << "a lens that was not seen";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "no line meets the shape: nothing is left of it, or it is too thin beside its parts to be measured");
  }
  const ShapeMeasures both = measure(*combined(Operation::unite, {solid_box({5, 0, 0}, {6, 1, 1}), lens}));
  EXPECT_NEAR(both.volume.value, 1 + kTwoPi * h * h, both.volume.error);
  EXPECT_GT(both.volume.error, 1e-14);
}

TEST(ShapeMeasures, FarFromTheOrigin) {
  const Vec3 away(1e6);
  expect_measures(*ring(0.3, away), 4 * kPi * kPi * 0.3, 2 * kPi * kPi * 0.09, 0.02, 1e-3);
  const ShapeMeasures cube = measure(*combined(Operation::unite, {solid_box(away, away + Vec3(1))}));
  EXPECT_NEAR(cube.volume.value, 1, cube.volume.error);
  EXPECT_LT(cube.volume.error, 1e-7);
}

// Three standard deviations, of which the estimate itself is uncertain: nearly all are within.
TEST(ShapeMeasures, StatedErrorsBoundTrueOnes) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  int beyond = 0, far_beyond = 0, compared = 0;
  for (int k = 0; k < 60; ++k) {
    std::vector<ShapePtr> balls;
    double area = 0, volume = 0;
    const int count = 1 + k % 7;
    for (int i = 0; i < count; ++i) {
      const double radius = std::pow(10, -4 * unit(random));
      balls.push_back(solid_ball({2.5 * i, unit(random), unit(random)}, radius));
      area += ball_area(radius);
      volume += ball_volume(radius);
    }
    const ShapeMeasures found = measure(*combined(Operation::unite, balls));
    const double off[] = {std::abs(found.area.value - area) / found.area.error,
                          std::abs(found.volume.value - volume) / found.volume.error};
    for (const double one : off) {
      ++compared;
      beyond += one > 1;
      far_beyond += one > 2;
    }
  }
  EXPECT_LE(beyond, compared / 40);
  EXPECT_EQ(far_beyond, 0);
}

TEST(ShapeMeasures, HalfSpacesThatBoundASolid) {
  const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const ShapePtr cube = combined(Operation::intersect, {half_space(x, x), half_space(-x, -x), half_space(y, y),
                                                        half_space(-y, -y), half_space(z, z), half_space(-z, -z)});
  EXPECT_EQ(cube->bounds().lo, Vec3(-1));
  EXPECT_EQ(cube->bounds().hi, Vec3(1));
  expect_measures(*cube, 24, 8, 0.01, 1e-13);
  // The corner of a cube cut off by a plane, all of it turned.
  const Frame turned = frame_from({3, 1, -2}, {1, 2, 3}, {1, 0, 0});
  const std::vector<ShapePtr> sides{half_space(turned.origin, -turned.x), half_space(turned.origin, -turned.y),
                                    half_space(turned.origin, -turned.z),
                                    half_space(turned.point(x), turned.direction({1, 1, 1}))};
  const ShapePtr corner = combined(Operation::intersect, sides);
  Box3 box;
  for (const Vec3& p : {Vec3(0), x, y, z}) box.include(turned.point(p));
  EXPECT_LT(glm::length(corner->bounds().lo - box.lo), 1e-7);
  EXPECT_LT(glm::length(corner->bounds().hi - box.hi), 1e-7);
  expect_measures(*corner, 1.5 + std::sqrt(3.0) / 2, 1.0 / 6, 0.02, 0.01);
  // Open: without the plane; a wedge; a slab under a map.
  EXPECT_FALSE(combined(Operation::intersect, {sides[0], sides[1], sides[2]})->bounds().bounded());
  EXPECT_FALSE(combined(Operation::intersect,
                        {half_space(x, x), half_space(-x, -x), half_space(z, {0, 1, 1}), half_space(-z, {0, 1, -1})})
                   ->bounds()
                   .bounded());
  EXPECT_FALSE(combined(Operation::intersect, {sides[0], sides[1], sides[2], half_space(turned.point(x), turned.x)})
                   ->bounds()
                   .bounded());
  Affine map;
  map.linear = Mat3(turned.x, turned.y, turned.z);
  const Box3 slab = transformed(half_space(z, z), map)->bounds();
  EXPECT_EQ(slab.lo, Vec3(-kInfinity));
  EXPECT_EQ(slab.hi, Vec3(kInfinity));
}

}  // namespace
}  // namespace lekalo::geometry::shape_measures_test
