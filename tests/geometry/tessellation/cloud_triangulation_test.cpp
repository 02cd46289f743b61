#include "geometry/tessellation/cloud_triangulation.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>
#include <stdexcept>

#include "geometry/bodies/triangulations/flattening.h"

namespace lekalo::geometry::cloud_test {
namespace {

// V - E + F, each side run through once in each direction at most, and how many have no opposite.
struct Topology {
  int euler = 0, free_sides = 0;
};
Topology topology_of(size_t points, const std::vector<IndexTriangle>& triangles) {
  std::set<std::pair<int, int>> sides;
  for (const IndexTriangle& t : triangles)
    for (size_t k = 0; k < 3; ++k) {
      EXPECT_TRUE(sides.insert({t[k], t[(k + 1) % 3]}).second);
    }
  int edges = 0, free_sides = 0;
  for (const auto& [a, b] : sides) {
    const bool is_free = !sides.contains({b, a});
    free_sides += is_free;
    edges += is_free || a < b;
  }
  return {static_cast<int>(points) - edges + static_cast<int>(triangles.size()), free_sides};
}

// Evenly spread but for a random part of the distance.
std::vector<Vec3> ball(int count, double noise, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> off(-noise, noise);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, r = std::sqrt(1 - z * z), t = 2.399963229728653 * i;
    points.push_back(Vec3(r * std::cos(t), r * std::sin(t), z) + Vec3(off(random), off(random), off(random)));
  }
  return points;
}

double volume(std::span<const Vec3> points, const std::vector<IndexTriangle>& triangles) {
  double sum = 0;
  for (const IndexTriangle& t : triangles) sum += glm::dot(points[t[0]], glm::cross(points[t[1]], points[t[2]])) / 6;
  return sum;
}

TEST(CloudTriangulation, BallsAreClosedAndLookOutwards) {
  for (const auto& [count, noise] : {std::pair(100, 0.0), std::pair(400, 0.0), std::pair(200, 0.02)})
    for (unsigned seed = 0; seed < 3; ++seed) {
      const std::vector<Vec3> points = ball(count, noise, seed);
      const std::vector<IndexTriangle> found = triangulation_of_cloud(points);
      const Topology topology = topology_of(points.size(), found);
      EXPECT_EQ(topology.euler, 2) << count << ' ' << noise;
      EXPECT_EQ(topology.free_sides, 0);
      EXPECT_NEAR(volume(points, found), 4.18879, 0.05 * 4.18879 + 40.0 / count / 10);
    }
}

TEST(CloudTriangulation, RandomPointsOfATorus) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> off(-0.25, 0.25);
  std::vector<Vec3> points;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 16; ++j) {
      const double u = 2 * kPi * (i + off(random)) / 40, v = 2 * kPi * (j + off(random)) / 16;
      points.emplace_back((3 + std::cos(v)) * std::cos(u), (3 + std::cos(v)) * std::sin(u), std::sin(v));
    }
  const std::vector<IndexTriangle> found = triangulation_of_cloud(points);
  const Topology topology = topology_of(points.size(), found);
  EXPECT_EQ(topology.euler, 0);
  EXPECT_EQ(topology.free_sides, 0);
  EXPECT_NEAR(volume(points, found), 59.2176, 0.05 * 59.2176);
}

// A half cylinder: one border; laid flat no triangle is turned over, and shares of the border are those of its length.
TEST(CloudTriangulation, SheetsAreLaidFlat) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 12; ++i)
    for (int j = 0; j <= 8; ++j)
      points.emplace_back(std::cos(kPi * i / 12 + 0.03 * std::sin(7 * j + i)), 0.25 * j,
                          std::sin(kPi * i / 12 + 0.03 * std::sin(7 * j + i)));
  const std::vector<IndexTriangle> found = triangulation_of_cloud(points);
  const Topology topology = topology_of(points.size(), found);
  EXPECT_EQ(topology.euler, 1);
  EXPECT_EQ(topology.free_sides, 40);
  const std::vector<Vec2> uv = flattened_to_circle(points, found);
  double area = 0;
  for (const IndexTriangle& t : found) {
    const Vec2 a = uv[t[1]] - uv[t[0]], b = uv[t[2]] - uv[t[0]];
    EXPECT_GT(a.x * b.y - a.y * b.x, 0);
    area += 0.5 * (a.x * b.y - a.y * b.x);
  }
  EXPECT_NEAR(area, 20 * std::sin(2 * kPi / 40), 0.02);
}

// Plane triangles whose border is laid down as it is keep all their points (linear precision of mean values).
TEST(CloudTriangulation, PlaneSheetsStayWhatTheyAre) {
  std::vector<Vec3> points;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> off(-0.2, 0.2);
  for (int i = 0; i <= 5; ++i)
    for (int j = 0; j <= 5; ++j) {
      const bool inner = i > 0 && i < 5 && j > 0 && j < 5;
      points.emplace_back(i + (inner ? off(random) : 0), j + (inner ? off(random) : 0), 0);
    }
  const std::vector<IndexTriangle> found = triangulation_of_cloud(points);
  const std::vector<int> border = border_of_sheet(points, found);
  ASSERT_EQ(border.size(), 20u);
  std::vector<Vec2> at;
  for (const int i : border) at.emplace_back(points[i]);
  const std::vector<Vec2> uv = flattened(points, found, border, at);
  for (size_t i = 0; i < points.size(); ++i) EXPECT_LT(glm::length(uv[i] - Vec2(points[i])), 1e-13);
}

TEST(CloudTriangulation, SaysWhatIsNoSurface) {
  const std::vector<Vec3> line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}};
  EXPECT_THROW(triangulation_of_cloud(line), std::invalid_argument);
  EXPECT_THROW(triangulation_of_cloud(std::vector<Vec3>(3)), std::invalid_argument);
  // Moebius' strip.
  std::vector<Vec3> strip;
  for (int i = 0; i < 40; ++i)
    for (int j = -2; j <= 2; ++j) {
      const double t = 2 * kPi * i / 40, r = 2 + 0.3 * j * std::cos(t / 2);
      strip.emplace_back(r * std::cos(t), r * std::sin(t), 0.3 * j * std::sin(t / 2));
    }
  EXPECT_THROW(triangulation_of_cloud(strip), std::invalid_argument);
}

}  // namespace
}  // namespace lekalo::geometry::cloud_test
