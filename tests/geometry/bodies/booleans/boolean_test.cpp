// Booleans of bodies: volumes in closed form (Golovanov 2016, 6.2 and 6.3), identities of volume.
#include "geometry/bodies/booleans/boolean.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/bodies/booleans/body_pairs.h"
#include "geometry/bodies/primitives/construct.h"
#include "geometry/bodies/primitives/primitives.h"
#include "geometry/queries/measures/mass_properties.h"

namespace lekalo::geometry::boolean_test {
namespace {

constexpr BooleanOperation kUnite = BooleanOperation::unite, kIntersect = BooleanOperation::intersect,
                           kSubtract = BooleanOperation::subtract;

Frame at(double x, double y, double z) {
  Frame frame;
  frame.origin = {x, y, z};
  return frame;
}

double volume(const Body& body) { return measure(body).volume.value; }

void expect_volumes(const Body& a, const Body& b, double common) {
  const double va = volume(a), vb = volume(b), near = 1e-9 * (va + vb);
  const auto check = [&](BooleanOperation operation, const Body& first, const Body& second, double expected) {
    try {
      EXPECT_NEAR(volume(boolean(operation, first, second)), expected, near);
    } catch (const BooleanError& error) {
      EXPECT_TRUE(error.empty && expected < near) << error.what();
    }
  };
  check(kIntersect, a, b, common);
  check(kUnite, a, b, va + vb - common);
  check(kSubtract, a, b, va - common);
  check(kSubtract, b, a, vb - common);
}

TEST(Boolean, BoxesInGeneralPosition) {
  expect_volumes(box(at(0, 0, 0), {2, 3, 4}), box(at(1, 1, 1), {5, 5, 5}), 1 * 2 * 3);
}

TEST(Boolean, BoxAndCylinder) {
  expect_volumes(box(at(0, 0, 0), {6, 4, 3}), cylinder_body(at(6, 2, 1), 1.5, 2), 2.25 * kPi);
}

TEST(Boolean, CubeAndSphere) {
  expect_volumes(box(at(-1, -1, -1), {2, 2, 2}), ball(at(0, 0, 0), 1.3), 7.16702004038951);
}

TEST(Boolean, EqualCylinders) {
  const Body a = cylinder_body(frame_from({-2, 0, 0}, {1, 0, 0}, {0, 1, 0}), 1, 4),
             b = cylinder_body(frame_from({0, -2, 0}, {0, 1, 0}, {1, 0, 0}), 1, 4);
  expect_volumes(a, b, 16.0 / 3);
}

TEST(Boolean, UnequalCylinders) {
  const Body a = cylinder_body(frame_from({-2, 0, 0}, {1, 0, 0}, {0, 1, 0}), 0.5, 4),
             b = cylinder_body(frame_from({0, -2, 0}, {0, 1, 0}, {1, 0, 0}), 1, 4);
  expect_volumes(a, b, 1.52003998817290);
}

TEST(Boolean, DrilledSphere) {
  const Body sphere = ball(at(0, 0, 0), 1), drill = cylinder_body(at(0, 0, -2), 0.5, 4);
  EXPECT_NEAR(volume(boolean(kSubtract, sphere, drill)), 2.72069904635133, 1e-9);
  const Body across = cylinder_body(frame_from({-2, 0, 0}, {1, 0, 0}, {0, 0, 1}), 0.5, 4);
  EXPECT_NEAR(volume(boolean(kSubtract, sphere, across)), 2.72069904635133, 1e-9);
}

// A body that is turned and moved, so that nothing is parallel to an axis.
Body turned(const Body& body) {
  return transformed(body, Affine::translation({0.3, -1.2, 0.7}) * Affine::rotation(0.7, {1, 2, 3}));
}

void expect_volumes_turned_too(const Body& a, const Body& b, double common) {
  expect_volumes(a, b, common);
  expect_volumes(turned(a), turned(b), common);
}

TEST(Boolean, CommonPlanes) {
  // A face on a face, overlapping tops, a step of equal width.
  expect_volumes_turned_too(box(at(0, 0, 0), {2, 3, 4}), box(at(1, 1, 2), {3, 1, 2}), 1 * 1 * 2);
  expect_volumes_turned_too(box(at(0, 0, 0), {2, 2, 2}), box(at(1, 0, 0), {2, 2, 2}), 4);
  expect_volumes_turned_too(box(at(0, 0, 0), {2, 2, 2}), box(at(1, 1, 0), {2, 2, 2}), 2);
}

TEST(Boolean, OneOnTheOther) {
  const Body low = box(at(0, 0, 0), {2, 3, 1});
  for (const Body& high : {box(at(0.5, 0.5, 1), {1, 1, 1}), box(at(0, 0, 1), {2, 3, 1}), box(at(-1, 1, 1), {2, 3, 1}),
                           cylinder_body(at(1, 1, 1), 0.5, 1)}) {
    const double sum = volume(low) + volume(high);
    EXPECT_NEAR(volume(boolean(kUnite, low, high)), sum, 1e-9);
    EXPECT_NEAR(volume(boolean(kSubtract, low, high)), volume(low), 1e-9);
    EXPECT_NEAR(volume(boolean(kUnite, turned(low), turned(high))), sum, 1e-9);
    EXPECT_NEAR(volume(boolean(kSubtract, turned(high), turned(low))), volume(high), 1e-9);
    try {
      boolean(kIntersect, low, high);
      ADD_FAILURE() << "nothing is left";
    } catch (const BooleanError& error) {
      EXPECT_TRUE(error.empty) << error.what();
    }
  }
}

TEST(Boolean, EqualOperands) {
  for (const Body& body : {box(at(0, 0, 0), {2, 3, 4}), ball(at(0, 0, 0), 1), cylinder_body(at(0, 0, 0), 1, 2),
                           torus_body(at(0, 0, 0), 2, 0.5), frustum(at(0, 0, 0), 1, 0, 2)}) {
    const double v = volume(body);
    EXPECT_NEAR(volume(boolean(kUnite, body, body)), v, 1e-9);
    EXPECT_NEAR(volume(boolean(kIntersect, body, body)), v, 1e-9);
    try {
      boolean(kSubtract, body, body);
      ADD_FAILURE() << "nothing is left";
    } catch (const BooleanError& error) {
      EXPECT_TRUE(error.empty) << error.what();
    }
  }
}

TEST(Boolean, CommonCylindersAndCones) {
  const double r = 1;
  const Body a = cylinder_body(at(0, 0, 0), r, 2);
  expect_volumes_turned_too(a, cylinder_body(at(0, 0, 1), r, 2), kPi);
  // Seams apart.
  expect_volumes_turned_too(a, cylinder_body(frame_from({0, 0, 1}, {0, 0, 1}, {1, 1, 0}), r, 2), kPi);
  expect_volumes_turned_too(frustum(at(0, 0, 0), 2, 1, 2), frustum(at(0, 0, 1), 1.5, 0.5, 2),
                            kPi * (1.5 * 1.5 + 1.5 + 1) / 3);
}

TEST(Boolean, TouchingAlongALine) {
  const Body a = cylinder_body(at(0, 0, 0), 1, 2), b = cylinder_body(at(2, 0, 0), 1, 2),
             c = box(at(1, -1, 0), {1, 2, 2});
  for (const Body* other : {&b, &c}) {
    EXPECT_NEAR(volume(boolean(kUnite, a, *other)), volume(a) + volume(*other), 1e-9);
    EXPECT_NEAR(volume(boolean(kSubtract, a, *other)), volume(a), 1e-9);
    EXPECT_THROW(boolean(kIntersect, a, *other), BooleanError);
  }
  // From inside.
  const Body inner = cylinder_body(at(0.5, 0, 0), 0.5, 2);
  EXPECT_NEAR(volume(boolean(kUnite, a, inner)), volume(a), 1e-9);
  EXPECT_NEAR(volume(boolean(kIntersect, a, inner)), volume(inner), 1e-9);
  expect_volumes(box(at(-1, -1, 0), {2, 2, 2}), a, 2 * kPi);
}

// The section crosses itself where they touch; the volume beyond the plane by Simpson's rule.
TEST(Boolean, TouchingInAPoint) {
  const Body a = ball(at(0, 0, 0), 1), b = ball(at(2, 0, 0), 1);
  EXPECT_NEAR(volume(boolean(kUnite, a, b)), 2 * volume(a), 1e-9);
  EXPECT_NEAR(volume(boolean(kSubtract, a, b)), volume(a), 1e-9);
  // Ball and box of equal reach.
  const Body cube = box(at(-1, -1, -1), {2, 2, 2});
  expect_volumes(cube, a, volume(a));
}

TEST(Boolean, TouchingAlongAnEdge) {
  const Body a = box(at(0, 0, 0), {1, 1, 1}), b = box(at(1, 0, 1), {1, 1, 1});
  const Body both = boolean(kUnite, a, b);
  EXPECT_NEAR(volume(both), 2, 1e-12);
  EXPECT_EQ(both.shells.size(), 2u);
}

TEST(Boolean, Octahedron) {
  std::vector<Vec3> points{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<PolygonFace> faces;
  for (int k = 0; k < 4; ++k) {
    faces.push_back({{k, (k + 1) % 4, 4}, {"", "upper", k}});
    faces.push_back({{(k + 1) % 4, k, 5}, {"", "lower", k}});
  }
  expect_volumes_turned_too(box(at(-2, -2, -3), {4, 4, 3}), polyhedron(points, faces), 2.0 / 3);
}

TEST(Boolean, PocketWithATShapedBlock) {
  const Body tool = boolean(kUnite, box(at(2, 1, 1), {2, 2, 2}), box(at(1, 0.5, 3), {4, 3, 1}));
  expect_volumes_turned_too(box(at(0, 0, 0), {6, 4, 3}), tool, 8);
}

TEST(Boolean, VoidsAndLumps) {
  const Body cube = box(at(0, 0, 0), {3, 3, 3}), inner = box(at(1, 1, 1), {1, 1, 1});
  const Body hollow = boolean(kSubtract, cube, inner);
  EXPECT_EQ(hollow.shells.size(), 2u);
  EXPECT_NEAR(volume(hollow), 26, 1e-12);
  EXPECT_NEAR(volume(boolean(kUnite, hollow, inner)), 27, 1e-12);
  EXPECT_NEAR(volume(boolean(kUnite, hollow, ball(at(1.5, 1.5, 1.5), 0.2))), 26 + 4.0 / 3 * kPi * 0.008, 1e-9);
  const Body cut = boolean(kSubtract, cube, box(at(-1, 1, -1), {5, 1, 5}));
  EXPECT_EQ(cut.shells.size(), 2u);
  EXPECT_NEAR(volume(cut), 18, 1e-12);
}

TEST(Boolean, HalvesOfATorus) {
  const Body ring = torus_body(at(0, 0, 0), 2, 0.5);
  // Through the axis and across it.
  expect_volumes(ring, box(at(0, -5, -5), {10, 10, 10}), 0.5 * volume(ring));
  expect_volumes(ring, box(at(-5, -5, 0), {10, 10, 10}), 0.5 * volume(ring));
}

// The meridian of one runs through the poles of the other.
TEST(Boolean, BallsWithSeamsApart) {
  const Body a = ball(at(0, 0, 0), 1), b = ball(frame_from({0, 0, 0}, {0, 0, 1}, {1, 2, 0}), 1);
  expect_volumes_turned_too(a, b, volume(a));
}

// Two lines through the apex, on which the angle jumps.
TEST(Boolean, HalvesOfACone) {
  const Body cone = frustum(at(0, 0, 0), 1, 0, 2);
  expect_volumes_turned_too(cone, box(at(0, -3, -1), {3, 6, 4}), 0.5 * volume(cone));
}

// What lies below a tilted plane through a point of the axis.
Body half_space(double height, double tilt) {
  return transformed(box(at(-4, -4, -4), {8, 8, 4}),
                     Affine::translation({0, 0, height}) * Affine::rotation(tilt, {1, 0, 0}));
}

// Across a pole, where the angle goes on to the other side.
TEST(Boolean, TiltedPlanesThroughAPole) {
  const Body a = ball(at(0, 0, 0), 1);
  for (const double tilt : {0.3, 0.7, 1.1, 1.5}) {
    const double cap = 1 - std::cos(tilt);
    expect_volumes_turned_too(a, half_space(1, tilt), 4 * kPi / 3 - kPi * cap * cap * (3 - cap) / 3);
  }
}

TEST(Boolean, TiltedPlanesThroughAnApex) {
  const Body cone = frustum(at(0, 0, 0), 1, 0, 2);
  for (const double tilt : {1.15, 1.3, 1.5}) {
    const double chord = 2 / std::tan(tilt), segment = std::acos(chord) - chord * std::sqrt(1 - chord * chord);
    expect_volumes_turned_too(cone, half_space(2, tilt), 2.0 / 3 * (kPi - segment));
  }
}

// The hole that the pin leaves in the end touches its border.
TEST(Boolean, PinThatTouchesFromInside) {
  const Body rod = cylinder_body(at(0, 0, 0), 1, 2);
  for (const double angle : {0.0, 1.0, 2.5}) {
    const Body pin = cylinder_body(frame_from({0.6, 0, 1}, {0, 0, 1}, {std::cos(angle), std::sin(angle), 0}), 0.4, 2);
    expect_volumes_turned_too(rod, pin, 0.16 * kPi);
  }
}

// A cylinder that touches the ball from within: of its side 16 r sqrt(r d) lies in the ball; of Viviani's body
// (2 pi / 3 - 8 / 9) R^3 in both.
TEST(Boolean, CylinderThatTouchesABallFromWithin) {
  for (const double r : {0.2, 0.5, 0.8})
    for (const double turn : {0.0, 1.0, 2.5}) {
      const double d = 1 - r;
      const Frame frame = frame_from({d * std::cos(turn), d * std::sin(turn), -2}, {0, 0, 1}, {1, 0, 0});
      const Affine placed = Affine::translation({1, 2, 3}) * Affine::rotation(turn, glm::normalize(Vec3(1, 2, -1)));
      const Body globe = transformed(ball(at(0, 0, 0), 1), placed),
                 rod = transformed(cylinder_body(frame, r, 4), placed);
      if (r == 0.5) expect_volumes(globe, rod, 2 * kPi / 3 - 8.0 / 9);
      const double both = measure(boolean(kIntersect, globe, rod)).area.value,
                   rest = measure(boolean(kSubtract, globe, rod)).area.value;
      EXPECT_NEAR(both + rest, 4 * kPi + 2 * 16 * r * std::sqrt(r * d), 1e-9);
    }
}

// A box that ends on the torus's inner equator: beyond the plane lies, of each cylinder of radius rho about the axis,
// the angle 2 acos((R - r) / rho); rho = R - r cos t, by Simpson's rule.
TEST(Boolean, BoxAtTheInnerEquatorOfATorus) {
  for (const double r : {0.3, 0.7})
    for (const double turn : {0.0, 1.0, 2.5}) {
      constexpr int kSteps = 4096;
      double beyond = 0;
      for (int k = 0; k <= kSteps; ++k) {
        const double t = kPi * k / kSteps, rho = 1 - r * std::cos(t), weight = k % kSteps == 0 ? 1 : k % 2 == 1 ? 4 : 2;
        const double angle = 2 * std::acos(std::min(1.0, (1 - r) / rho));
        beyond += weight * kPi / kSteps / 3 * angle * rho * 2 * r * r * std::sin(t) * std::sin(t);
      }
      const Affine placed = Affine::translation({1, 2, 3}) * Affine::rotation(turn, glm::normalize(Vec3(1, 2, -1)));
      expect_volumes(transformed(torus_body(at(0, 0, 0), 1, r), placed),
                     transformed(box(at(1 - r, -3, -2), {5, 6, 4}), placed), beyond);
    }
}

// Faces of one sweep lie on each other though their surfaces have no equation.
TEST(Boolean, OneProfileTwice) {
  for (const unsigned seed : {1, 2, 3, 4})
    for (const int kind : {BodyPairs::kExtrudedTwice, BodyPairs::kRevolvedTwice}) {
      const BodyPair pair = BodyPairs(seed).degenerate(kind);
      EXPECT_NEAR(volume(boolean(kUnite, pair.a, pair.b)) + volume(boolean(kIntersect, pair.a, pair.b)),
                  volume(pair.a) + volume(pair.b), 1e-9);
    }
}

}  // namespace
}  // namespace lekalo::geometry::boolean_test
