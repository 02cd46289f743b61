// Common points of three surfaces: the checks of Golovanov 2016, 4.5, closed forms, and random spheres.
#include "geometry/queries/contours/common_points.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "support/tier.h"

namespace lekalo::geometry::common_points_test {
namespace {

SurfacePtr sphere(const Vec3& center, double radius) {
  Frame frame;
  frame.origin = center;
  return std::make_shared<SphereSurface>(frame, radius);
}
SurfacePtr plane(const Vec3& through, const Vec3& normal) {
  return std::make_shared<Plane>(frame_about(through, glm::normalize(normal)));
}

// In every order.
void check_points(std::array<SurfaceOrBody, 3> of, const std::vector<Vec3>& truth, bool contact = false) {
  for (const std::array<int, 3>& order :
       {std::array{0, 1, 2}, std::array{1, 2, 0}, std::array{2, 0, 1}, std::array{1, 0, 2}}) {
    const std::array<SurfaceOrBody, 3> turned{of[order[0]], of[order[1]], of[order[2]]};
    const CommonPoints found = common_points(turned);
    EXPECT_TRUE(found.complete);
    EXPECT_TRUE(found.curves.empty());
    ASSERT_EQ(found.points.size(), truth.size());
    for (const CommonPoint& one : found.points) {
      double nearest = kInfinity;
      for (const Vec3& p : truth) nearest = std::min(nearest, glm::length(p - one.point));
      EXPECT_LT(nearest, contact ? 1e-8 : 1e-13);
      EXPECT_EQ(one.contact, contact);
      for (int i = 0; i < 3; ++i) {
        const Vec3 p = std::get<SurfacePtr>(turned[i])->point(one.places[i].x, one.places[i].y);
        EXPECT_LT(glm::length(p - one.point), contact ? 1e-8 : 1e-13);
      }
    }
  }
}

TEST(CommonPoints, ThreePlanes) {
  check_points({plane({1, 0, 0}, {1, 0, 0}), plane({0, 2, 0}, {0, 1, 0}), plane({6, 0, 0}, {1, 1, 1})}, {{1, 2, 3}});
  EXPECT_FALSE(
      common_points({plane({1, 0, 0}, {1, 0, 0}), plane({2, 0, 0}, {1, 0, 0}), plane({6, 0, 0}, {1, 1, 1})}).complete);
}

TEST(CommonPoints, SpheresAndPlanes) {
  const double root = std::sqrt(2.0);
  check_points({sphere({1, 0, 0}, 2), sphere({-1, 0, 0}, 2), plane({0, 0, 1}, {0, 0, 1})},
               {{0, root, 1}, {0, -root, 1}});
  check_points({sphere({0, 0, 0}, 2), plane({0, 0, 1}, {0, 0, 1}), plane({0.5, 0, 0}, {1, 0, 0})},
               {{0.5, std::sqrt(2.75), 1}, {0.5, -std::sqrt(2.75), 1}});
  check_points({sphere({1, 0, 0}, 2), sphere({-1, 0, 0}, 2), plane({0, 0, 1.8}, {0, 0, 1})}, {});
}

TEST(CommonPoints, Contacts) {
  check_points({sphere({1, 0, 0}, 2), sphere({-1, 0, 0}, 2), plane({0, 0, std::sqrt(3.0)}, {0, 0, 1})},
               {{0, 0, std::sqrt(3.0)}}, true);
  check_points({sphere({1, 0, 0}, 1), sphere({-1, 0, 0}, 1), sphere({0, 1, 0}, 1)}, {{0, 0, 0}}, true);
}

TEST(CommonPoints, CommonCurves) {
  const CommonPoints pencil =
      common_points({sphere({1, 0, 0}, 2), sphere({-1, 0, 0}, 2), sphere({0, 0, 0}, std::sqrt(3.0))});
  EXPECT_TRUE(pencil.complete && pencil.points.empty());
  EXPECT_EQ(pencil.curves.size(), 1u);
  const auto square = [] { return std::make_shared<Plane>(Frame(), Rectangle{{-1, 1}, {-1, 1}}); };
  const CommonPoints same = common_points({square(), square(), square()});
  EXPECT_FALSE(same.complete);
}

// The centres and radii give the points in closed form.
TEST(CommonPoints, RandomSpheres) {
  std::mt19937 random(81);
  std::uniform_real_distribution<double> d(-1, 1);
  const int cases = tests::tier_count(50, 10);
  int points = 0;
  for (int k = 0; k < cases; ++k) {
    std::array<Vec3, 3> c;
    std::array<double, 3> r;
    for (int i = 0; i < 3; ++i) c[i] = {d(random), d(random), d(random)}, r[i] = 0.9 + 0.5 * d(random);
    const Vec3 x = glm::normalize(c[1] - c[0]);
    const double a = glm::length(c[1] - c[0]), i = glm::dot(x, c[2] - c[0]);
    const Vec3 y = glm::normalize(c[2] - c[0] - i * x), z = glm::cross(x, y);
    const double j = glm::dot(y, c[2] - c[0]);
    const double px = (r[0] * r[0] - r[1] * r[1] + a * a) / (2 * a);
    const double py = (r[0] * r[0] - r[2] * r[2] + i * i + j * j) / (2 * j) - i / j * px;
    const double square = r[0] * r[0] - px * px - py * py;
    if (std::abs(square) < 1e-3) continue;
    const CommonPoints found = common_points({sphere(c[0], r[0]), sphere(c[1], r[1]), sphere(c[2], r[2])});
    ASSERT_EQ(found.points.size(), square > 0 ? 2u : 0u) << k;
    for (const CommonPoint& one : found.points) {
      const double side = glm::dot(one.point - c[0], z) > 0 ? 1 : -1;
      EXPECT_LT(glm::length(one.point - c[0] - px * x - py * y - side * std::sqrt(square) * z), 1e-11);
      EXPECT_FALSE(one.contact);
    }
    points += static_cast<int>(found.points.size());
  }
  EXPECT_GT(points, cases / 2);
  tests::report_figure("points_of_spheres", points);
}

}  // namespace
}  // namespace lekalo::geometry::common_points_test
