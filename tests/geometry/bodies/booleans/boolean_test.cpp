// Booleans of bodies: volumes in closed form (Golovanov 2016, 6.2 and 6.3), identities of volume, random pairs.
#include "geometry/bodies/booleans/boolean.h"

#include <gtest/gtest.h>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/queries/measures/mass_properties.h"

namespace lekalo::geometry {
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
  EXPECT_NEAR(volume(boolean(kIntersect, a, b)), common, near);
  EXPECT_NEAR(volume(boolean(kUnite, a, b)), va + vb - common, near);
  EXPECT_NEAR(volume(boolean(kSubtract, a, b)), va - common, near);
  EXPECT_NEAR(volume(boolean(kSubtract, b, a)), vb - common, near);
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

}  // namespace
}  // namespace lekalo::geometry
