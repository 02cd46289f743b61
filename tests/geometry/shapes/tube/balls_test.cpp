// Balls about points against one sphere's formula at a time.
#include "geometry/shapes/tube/balls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "geometry/describe.h"
#include "geometry/surfaces/surface_checks.h"
#include "support/tier.h"

namespace lekalo::geometry::balls_test {
namespace {

TEST(Balls, LinesMeetTheUnionWhereItsSpheresSay) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (int i = 0; i < 200; ++i) {
    centers.emplace_back(unit(random), unit(random), unit(random));
    radii.push_back(0.02 + 0.1 * unit(random));
  }
  const Balls balls(centers, radii);
  EXPECT_TRUE(balls.is_closed());
  int hits = 0;
  for (int i = 0; i < tests::tier_count(300000); ++i) {
    const Vec3 d = checks::random_direction(random);
    // Of any length: t is in its units.
    const Line line{Vec3(unit(random), unit(random), unit(random)) - (i % 2) * 5.0 * d, (0.5 + unit(random)) * d};
    const Interval range = i % 3 == 0 ? Interval::entire() : Interval(0, kInfinity);
    std::vector<Interval> parts;
    for (size_t k = 0; k < centers.size(); ++k) {
      const auto dot = [](const Vec3& p, const Vec3& q) {
        return static_cast<long double>(p.x) * q.x + static_cast<long double>(p.y) * q.y +
               static_cast<long double>(p.z) * q.z;
      };
      const Vec3 e = line.origin - centers[k];
      const long double a = dot(line.direction, line.direction), b = dot(e, line.direction);
      const long double c = dot(e, e) - static_cast<long double>(radii[k]) * radii[k], root = b * b - a * c;
      if (root > 0)
        parts.push_back(
            {static_cast<double>((-b - std::sqrt(root)) / a), static_cast<double>((-b + std::sqrt(root)) / a)});
    }
    std::sort(parts.begin(), parts.end(), [](const Interval& a, const Interval& b) { return a.lo < b.lo; });
    std::vector<double> expected;
    double reached = -kInfinity;
    for (const Interval& part : parts) {
      if (part.lo > reached) {
        if (reached > -kInfinity) expected.push_back(reached);
        expected.push_back(part.lo);
      }
      reached = std::max(reached, part.hi);
    }
    if (reached > -kInfinity) expected.push_back(reached);
    expected.erase(std::remove_if(expected.begin(), expected.end(), [&](double t) { return !range.contains(t); }),
                   expected.end());
    std::vector<SurfaceHit> found;
    balls.all_hits(line, range, found);
    ASSERT_EQ(found.size(), expected.size()) << "line " << i;
    hits += static_cast<int>(found.size());
    for (size_t k = 0; k < found.size(); ++k) {
      const ShapePoint at = balls.point(found[k], line.at(found[k].t));
      const double slope = std::abs(glm::dot(at.normal, d));
      ASSERT_LE(std::abs(found[k].t - expected[k]) * std::max(slope, 1e-4), 2e-14) << "line " << i;
      EXPECT_LE(std::abs(glm::length(at.position - centers[found[k].piece]) - radii[found[k].piece]), 1e-15);
    }
  }
  EXPECT_GT(hits, 1000);
}

TEST(Balls, ParametersAreLongitudeAndLatitude) {
  const Balls ball(std::vector<Vec3>{{1, 2, 3}}, std::vector<double>{0.5});
  const double u = 1.1, v = -0.4, h = 1e-6;
  const auto at = [&](double a, double b) {
    return Vec3(1, 2, 3) + 0.5 * Vec3(std::cos(b) * std::cos(a), std::cos(b) * std::sin(a), std::sin(b));
  };
  const ShapePoint point = ball.point({}, at(u, v));
  EXPECT_NEAR(point.u, u, 1e-14);
  EXPECT_NEAR(point.v, v, 1e-14);
  EXPECT_LE(glm::length(point.du - (at(u + h, v) - at(u - h, v)) / (2 * h)), 1e-9);
  EXPECT_LE(glm::length(point.dv - (at(u, v + h) - at(u, v - h)) / (2 * h)), 1e-9);
}

TEST(Balls, RefusesWhatIsNone) {
  const std::vector<Vec3> two{{0, 0, 0}, {1, 0, 0}};
  EXPECT_THROW(Balls({}, std::vector<double>{1}), FieldError);
  EXPECT_THROW(Balls(two, std::vector<double>{0}), FieldError);
  EXPECT_THROW(Balls(two, std::vector<double>{1, -1}), FieldError);
  EXPECT_THROW(Balls(two, std::vector<double>{1, 1, 1}), FieldError);
}

}  // namespace
}  // namespace lekalo::geometry::balls_test
