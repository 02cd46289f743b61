#include "geometry/queries/differential/plane_lines.h"

#include <gtest/gtest.h>

#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/splines/bezier_surface.h"

namespace lekalo::geometry::plane_lines_test {
namespace {

// Rows of control points in planes z = 0, 1, 3: lines u = const.
Grid<Vec3> layers() {
  return {3, 3, {{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {0, 1, 1}, {1, 2, 1}, {3, 1, 1}, {1, 0, 3}, {2, 1, 3}, {2, 2, 3}}};
}

TEST(PlaneLines, OfControlPointsInLayers) {
  const PlaneLines found = plane_lines(bezier_surface(layers()));
  EXPECT_FALSE(found.surface);
  EXPECT_FALSE(found.along_u);
  ASSERT_TRUE(found.along_v);
  EXPECT_LE(glm::length(*found.along_v - Vec3(0, 0, 1)), 1e-15);
  // The least move out of a layer is seen.
  Grid<Vec3> moved = layers();
  moved.at(1, 1).z += 1e-9;
  EXPECT_FALSE(plane_lines(bezier_surface(moved)).along_v);
}

TEST(PlaneLines, OfASphereAndAPlane) {
  const PlaneLines sphere = plane_lines(SphereSurface(Frame(), 2));
  EXPECT_FALSE(sphere.surface);
  ASSERT_TRUE(sphere.along_u);
  EXPECT_LE(glm::length(*sphere.along_u - Vec3(0, 0, 1)), 1e-14);
  EXPECT_FALSE(sphere.along_v);
  Grid<Vec3> flat = layers();
  for (Vec3& p : flat.values) p.z = p.x + 2 * p.y;
  const PlaneLines plane = plane_lines(bezier_surface(flat));
  ASSERT_TRUE(plane.surface);
  EXPECT_LE(glm::length(*plane.surface - Vec3(-1, -2, 1) / -std::sqrt(6.0)), 1e-14);
}

}  // namespace
}  // namespace lekalo::geometry::plane_lines_test
