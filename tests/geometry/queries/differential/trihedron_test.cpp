#include "geometry/queries/differential/trihedron.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/curves/analytic/circle.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"

namespace lekalo::geometry::trihedron_test {
namespace {

// The circle of height 1 on a sphere of radius 2: the sphere's normal is 30 degrees above the horizontal.
const Circle kRim(Frame{{0, 0, 1}}, std::sqrt(3.0));
const SurfacePtr kSphere = std::make_shared<SphereSurface>(Frame(), 2);
const SurfacePtr kPlane = std::make_shared<Plane>(Frame{{0, 0, 1}}, Rectangle{{-3, 3}, {-3, 3}});

void expect_at(const SurfaceTrihedron& trihedron, double angle) {
  for (const double t : {0.0, 0.7, 2.0, 4.4}) {
    const CurveJet jet = kRim.evaluate(t, 1);
    const Frame frame = trihedron.at(jet);
    const Vec3 n(std::cos(angle) * std::cos(t), std::cos(angle) * std::sin(t), std::sin(angle));
    EXPECT_LE(glm::length(frame.x - n), 1e-12);
    EXPECT_LE(glm::length(frame.z - glm::normalize(jet.d[1])), 1e-15);
    EXPECT_LE(glm::length(frame.y - glm::cross(frame.z, frame.x)), 1e-15);
    EXPECT_LE(glm::length(frame.origin - jet.point()), 0);
  }
}

TEST(SurfaceTrihedron, HasTheNormalOfASurface) {
  expect_at(SurfaceTrihedron({kSphere}), kPi / 6);
  expect_at(SurfaceTrihedron({kPlane}), kPi / 2);
}

TEST(SurfaceTrihedron, LiesBetweenTheNormalsOfTwo) {
  expect_at(SurfaceTrihedron({kSphere, kPlane}), kPi / 3);
  expect_at(SurfaceTrihedron({kSphere, kPlane}, 1), kPi / 6);
  expect_at(SurfaceTrihedron({kSphere, kPlane}, 0), kPi / 2);
  // w (sqrt(3)/2, 1/2) + (1 - w) (0, 1)
  expect_at(SurfaceTrihedron({kSphere, kPlane}, 0.25), std::atan2(0.875, 0.25 * std::sqrt(0.75)));
}

TEST(SurfaceTrihedron, RefusesOppositeNormals) {
  const SurfacePtr below =
      std::make_shared<Plane>(frame_from({0, 0, 1}, {0, 0, -1}, {1, 0, 0}), Rectangle{{-3, 3}, {-3, 3}});
  EXPECT_THROW(SurfaceTrihedron({kPlane, below}).at(kRim.evaluate(0, 1)), std::invalid_argument);
  EXPECT_NO_THROW(SurfaceTrihedron({kPlane, below}, 0.4).at(kRim.evaluate(0, 1)));
}

}  // namespace
}  // namespace lekalo::geometry::trihedron_test
