// Numbers of Golovanov 2016, 8.6, and random regions against the constrained Delaunay triangulation's area and count.
#include "geometry/tessellation/planar_triangulations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <tuple>

namespace lekalo::geometry::planar_triangulations_test {
namespace {

double area(std::span<const Vec2> p, const std::vector<IndexTriangle>& triangles) {
  double sum = 0;
  for (const IndexTriangle& t : triangles) {
    const Vec2 a = p[t[1]] - p[t[0]], b = p[t[2]] - p[t[0]];
    EXPECT_GT(a.x * b.y - a.y * b.x, 0);
    sum += 0.5 * (a.x * b.y - a.y * b.x);
  }
  return sum;
}

TEST(PlanarTriangulations, CircumcenterParameter) {
  const Vec2 a(0, 0), b(4, 0);
  EXPECT_NEAR(circumcenter_parameter(a, b, {2, 3}), 0.2083333333333333, 1e-15);
  EXPECT_EQ(circumcenter_parameter(a, b, {1, 1}), -0.25);
  EXPECT_NEAR(circumcenter_parameter(a, b, {3, 5}), 0.55, 1e-15);
  EXPECT_EQ(circumcenter_parameter(a, b, {2, 1}), -0.375);
  EXPECT_EQ(circumcenter_parameter(a, b, {2, -1}), 0.375);
  EXPECT_EQ(circumcenter_parameter(a, b, {2, 2}), 0);
  EXPECT_EQ(circumcenter_parameter(a, b, {5, -2}), -0.5625);
  EXPECT_EQ(circumcenter_parameter(a, b, {7, 0}), kInfinity);
}

TEST(PlanarTriangulations, GridWithHole) {
  std::vector<Vec2> points{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 1}, {1, 3}, {3, 3}, {3, 1}};
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j)
      if (const Vec2 p(0.25 + 0.5 * i, 0.25 + 0.5 * j); std::abs(p.x - 2) > 1 || std::abs(p.y - 2) > 1)
        points.push_back(p);
  ASSERT_EQ(points.size(), 56u);
  const std::vector<IndexTriangle> triangles = advancing_front(points, {{0, 1, 2, 3}, {4, 5, 6, 7}});
  EXPECT_EQ(triangles.size(), 104u);
  EXPECT_DOUBLE_EQ(area(points, triangles), 12);
}

TEST(PlanarTriangulations, RandomStarsWithHoles) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int n = 0; n < 40; ++n) {
    std::vector<Vec2> points;
    std::vector<int> outer, hole;
    for (int k = 0; k < 9; ++k) {
      const double angle = kTwoPi * k / 9, radius = 2 + 2 * unit(random);
      outer.push_back(static_cast<int>(points.size()));
      points.push_back(radius * Vec2(std::cos(angle), std::sin(angle)));
    }
    for (int k = 0; k < 5; ++k) {
      const double angle = -kTwoPi * k / 5, radius = 0.3 + 0.5 * unit(random);
      hole.push_back(static_cast<int>(points.size()));
      points.push_back(radius * Vec2(std::cos(angle), std::sin(angle)));
    }
    for (int k = 0; k < 8; ++k) points.push_back({4 * unit(random) - 2, 4 * unit(random) - 2});
    const std::vector<IndexTriangle> expected = triangulate(points, {outer, hole});
    const std::vector<IndexTriangle> found = advancing_front(points, {outer, hole});
    EXPECT_EQ(found.size(), expected.size()) << n;
    EXPECT_NEAR(area(points, found), area(points, expected), 1e-12) << n;
  }
}

TEST(PlanarTriangulations, FlipsAndGreedyCoverTheHull) {
  std::mt19937 random(8);
  std::uniform_int_distribution<int> digit(0, 6);
  for (int n = 0; n < 40; ++n) {
    std::vector<Vec2> points{{0, 0}, {7, 0}, {7, 7}};  // many collinear ones, and some twice
    for (int k = 0; k < 12; ++k) points.push_back({digit(random), digit(random)});
    const double hull = area(points, delaunay(points));
    EXPECT_NEAR(area(points, greedy_triangulation(points)), hull, 1e-12) << n;
    EXPECT_NEAR(area(points, triangulation_by_flips(points)), hull, 1e-12) << n;
    EXPECT_EQ(triangulation_by_flips(points).size(), delaunay(points).size()) << n;
  }
}

// By the rule itself: each pair by increasing length, kept if it crosses none kept before and goes through no point.
std::set<std::pair<int, int>> greedy_edges(const std::vector<Vec2>& p) {
  const auto side = [&](int a, int b, int c) {
    const Vec2 u = p[b] - p[a], v = p[c] - p[a];
    return u.x * v.y - u.y * v.x;
  };
  const auto between = [&](int a, int b, int c) {
    return side(a, b, c) == 0 && glm::dot(p[c] - p[a], p[c] - p[b]) < 0;
  };
  std::vector<std::tuple<double, int, int>> pairs;
  const int n = static_cast<int>(p.size());
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b) pairs.emplace_back(glm::length(p[a] - p[b]), a, b);
  std::sort(pairs.begin(), pairs.end());
  std::set<std::pair<int, int>> kept;
  for (const auto& [length, a, b] : pairs) {
    bool good = true;
    for (int v = 0; v < n; ++v) good = good && !between(a, b, v);
    for (const auto& [c, d] : kept)
      good = good && !(side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0) && !between(c, d, a) &&
             !between(c, d, b);
    if (good) kept.emplace(a, b);
  }
  return kept;
}

TEST(PlanarTriangulations, GreedyByTheRuleItself) {
  std::mt19937 random(11);
  std::uniform_int_distribution<int> coordinate(0, 30);
  for (int n = 0; n < 12; ++n) {
    std::set<std::pair<int, int>> places;
    for (int k = 0; k < 40; ++k)
      places.emplace(coordinate(random), n % 3 == 0 ? coordinate(random) / 8 : coordinate(random));
    std::vector<Vec2> points;
    for (const auto& [x, y] : places) points.emplace_back(x, y);
    std::set<std::pair<int, int>> edges;
    for (const IndexTriangle& t : greedy_triangulation(points))
      for (size_t k = 0; k < 3; ++k) edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
    EXPECT_EQ(edges, greedy_edges(points));
  }
}

}  // namespace
}  // namespace lekalo::geometry::planar_triangulations_test
