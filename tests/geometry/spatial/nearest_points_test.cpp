// The nearest of points, against all of them.
#include "geometry/spatial/nearest_points.h"

#include <gtest/gtest.h>

#include <random>

namespace lekalo::geometry::nearest_points_test {
namespace {

TEST(NearestPoints, AsByTryingAll) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto point = [&] { return Vec3(unit(random), unit(random), unit(random)); };
  for (const int count : {1, 2, 3, 17, 400}) {
    std::vector<Vec3> points;
    for (int k = 0; k < count; ++k) points.push_back(k % 5 == 4 ? points[0] : point());
    const NearestPoints tree(points);
    for (int k = 0; k < 100; ++k) {
      const Vec3 to = 1.5 * point();
      double least = kInfinity;
      for (const Vec3& p : points) least = std::min(least, glm::length(p - to));
      EXPECT_EQ(glm::length(tree.nearest(to) - to), least);
    }
  }
}

}  // namespace
}  // namespace lekalo::geometry::nearest_points_test
