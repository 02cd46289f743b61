// Facts of planar triangulation: Golovanov 2016, 8.6 (counts, the two point sets with all triangulations compared);
// exactness of orientation against 113-bit arithmetic.
#include "geometry/tessellation/triangulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "geometry/tessellation/predicates.h"

namespace lekalo::geometry::triangulation_test {
namespace {

double area(std::span<const Vec2> points, const IndexTriangle& t) {
  const Vec2 a = points[t[1]] - points[t[0]], b = points[t[2]] - points[t[0]];
  return 0.5 * (a.x * b.y - a.y * b.x);
}

double total_area(std::span<const Vec2> points, const std::vector<IndexTriangle>& triangles) {
  double sum = 0;
  for (const auto& t : triangles) {
    EXPECT_GT(area(points, t), 0);
    sum += area(points, t);
  }
  return sum;
}

struct Edges {
  std::set<std::pair<int, int>> all;
  double length = 0;
};

Edges edges_of(std::span<const Vec2> points, const std::vector<IndexTriangle>& triangles) {
  Edges edges;
  for (const auto& t : triangles)
    for (int k = 0; k < 3; ++k) {
      const auto side = std::minmax(t[k], t[(k + 1) % 3]);
      if (edges.all.insert(side).second) edges.length += glm::length(points[side.first] - points[side.second]);
    }
  return edges;
}

// Inner points of the half-unit grid offset by 0.25 over [0, 4]^2, outside [1, 3]^2.
std::vector<Vec2> grid_about_hole() {
  std::vector<Vec2> points{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 1}, {1, 3}, {3, 3}, {3, 1}};
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) {
      const Vec2 p(0.25 + 0.5 * i, 0.25 + 0.5 * j);
      if (!(p.x > 1 && p.x < 3 && p.y > 1 && p.y < 3)) points.push_back(p);
    }
  return points;
}

TEST(Orientation, NearlyCollinearPointsHaveTheExactSign) {
  // Points within a few ulps of a line, the classic trap for floating-point orientation; 113-bit products are exact
  // here.
  int undecided = 0;
  for (int i = 0; i < 64; ++i)
    for (int j = 0; j < 64; ++j) {
      const Vec2 a(0.5 + i * 0x1p-53, 0.5 + j * 0x1p-53), b(12, 12), c(24, 24);
      using Quad = __float128;
      const Quad exact = (Quad(a.x) - c.x) * (Quad(b.y) - c.y) - (Quad(a.y) - c.y) * (Quad(b.x) - c.x);
      const double found = orient2d(a, b, c);
      EXPECT_EQ(found > 0, exact > 0);
      EXPECT_EQ(found < 0, exact < 0);
      if (exact == 0) ++undecided;
    }
  EXPECT_EQ(undecided, 64);
}

TEST(Triangulation, HexagonOfTheBook) {
  const std::vector<Vec2> points{{7, 3}, {9, 4}, {6, 9}, {3, 7}, {3, 4}, {5, 3}};
  const auto triangles = delaunay(points);
  const Edges edges = edges_of(points, triangles);
  EXPECT_EQ(triangles.size(), 4u);
  EXPECT_EQ(edges.all.size(), 9u);
  EXPECT_NEAR(edges.length, 35.54630014090489, 1e-12);
}

TEST(Triangulation, EightPointsOfTheBook) {
  const std::vector<Vec2> points{{0, 0}, {10, 0}, {11, 6}, {5, 9}, {-1, 5}, {4, 4}, {6, 3}, {3, 7}};
  const auto triangles = delaunay(points);
  const Edges edges = edges_of(points, triangles);
  EXPECT_EQ(triangles.size(), 9u);
  EXPECT_EQ(edges.all.size(), 16u);
  EXPECT_NEAR(edges.length, 87.27680887905314, 1e-12);
}

TEST(Triangulation, CountsOfBoundedDomains) {
  // B + 2 K + 2 H - 2.
  const std::vector<Vec2> all = grid_about_hole();
  const std::vector<std::vector<int>> loops{{0, 1, 2, 3}, {4, 5, 6, 7}};
  const std::span<const Vec2> points(all);
  EXPECT_EQ(triangulate(points.first(8), loops).size(), 8u);
  EXPECT_EQ(triangulate(points.first(9), loops).size(), 10u);
  ASSERT_EQ(points.size(), 8u + 48u);
  const auto triangles = triangulate(points, loops);
  EXPECT_EQ(triangles.size(), 104u);
  EXPECT_NEAR(total_area(points, triangles), 12, 1e-12);
  // V - E + F = 1 - H
  EXPECT_EQ(56 - static_cast<int>(edges_of(points, triangles).all.size()) + 104, 0);
}

TEST(Triangulation, DelaunayCirclesAreEmpty) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Vec2> points(300);
  for (Vec2& p : points) p = {uniform(random), uniform(random)};
  const auto triangles = delaunay(points);
  for (const auto& t : triangles)
    for (size_t i = 0; i < points.size(); ++i)
      EXPECT_FALSE(surely_in_circle(points[t[0]], points[t[1]], points[t[2]], points[i]));
  // 2n - 2 - h triangles with h points on the hull: sides used once are the hull.
  const auto edges = edges_of(points, triangles).all.size();
  EXPECT_EQ(edges, points.size() + triangles.size() - 1);
}

TEST(Triangulation, RandomStarsAndCombsKeepTheirArea) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int round = 0; round < 150; ++round) {
    // A star-shaped polygon with a star-shaped hole and inner points.
    const int n = 5 + static_cast<int>(random() % 60), m = 3 + static_cast<int>(random() % 20);
    std::vector<Vec2> points;
    std::vector<std::vector<int>> loops(2);
    for (int i = 0; i < n; ++i) {
      const double angle = kTwoPi * i / n, radius = 1 + uniform(random);
      loops[0].push_back(static_cast<int>(points.size()));
      points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    // Radius below the distance of any side of the outer polygon from the center.
    const double inner = 0.9 * std::cos(kPi / n);
    for (int i = m - 1; i >= 0; --i) {
      const double angle = kTwoPi * i / m, radius = inner * (0.2 + 0.8 * uniform(random));
      loops[1].push_back(static_cast<int>(points.size()));
      points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    double expected = 0;
    for (const auto& loop : loops)
      for (size_t i = 0; i < loop.size(); ++i) {
        const Vec2 a = points[loop[i]], b = points[loop[(i + 1) % loop.size()]];
        expected += 0.5 * (a.x * b.y - a.y * b.x);
      }
    const auto triangles = triangulate(points, loops);
    EXPECT_EQ(triangles.size(), static_cast<size_t>(n + m));
    EXPECT_NEAR(total_area(points, triangles), expected, 1e-12);
  }
}

TEST(Triangulation, PolygonsOnAGridWithCollinearPointsAndATouchingHole) {
  // Corners in the middle of sides, and a hole that touches the outer polygon in a point.
  const std::vector<Vec2> points{{0, 0}, {1, 0}, {2, 0}, {2, 1},   {2, 2},   {1, 2},
                                 {0, 2}, {0, 1}, {1, 0}, {0.5, 1}, {1, 1.5}, {1.5, 1}};
  const auto triangles = triangulate(points, {{0, 1, 2, 3, 4, 5, 6, 7}, {8, 9, 10, 11}});
  // The hole is the kite with the diagonals 1 and 1.5.
  EXPECT_NEAR(total_area(points, triangles), 4 - 0.75, 1e-12);
}

TEST(Triangulation, CrossingPolygonsAreRefused) {
  const std::vector<Vec2> points{{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 1}, {1, 3}, {3, 3}, {3, 1}};
  EXPECT_THROW(triangulate(points, {{0, 1, 2, 3}, {4, 5, 6, 7}}), std::invalid_argument);
}

TEST(Triangulation, RefinementStaysInsideAndKeepsConstraints) {
  // The square [0, 4]^2 with the hole [1, 3]^2, border sides of length 1/2, refined to sides of at most 0.7.
  PlanarTriangulation triangulation({0, 0}, {4, 4});
  const auto add_square = [&](double lo, double hi, bool counterclockwise) {
    std::vector<int> loop;
    const int n = static_cast<int>(2 * (hi - lo));
    const std::array<Vec2, 4> corners{{{lo, lo}, {hi, lo}, {hi, hi}, {lo, hi}}};
    for (int side = 0; side < 4; ++side)
      for (int k = 0; k < n; ++k)
        loop.push_back(
            triangulation.insert(corners[side] + (double(k) / n) * (corners[(side + 1) % 4] - corners[side])));
    for (size_t i = 0; i < loop.size(); ++i) {
      const int a = loop[i], b = loop[(i + 1) % loop.size()];
      counterclockwise ? triangulation.constrain(a, b) : triangulation.constrain(b, a);
    }
    return static_cast<int>(loop.size());
  };
  const int border = add_square(0, 4, true) + add_square(1, 3, false);
  triangulation.keep_left();
  int inserted = 0;
  triangulation.refine(
      [&](const IndexTriangle& t, const std::array<bool, 3>& fixed, Vec2& place) {
        for (int k = 0; k < 3; ++k) {
          const Vec2 a = triangulation.point(t[(k + 1) % 3]), b = triangulation.point(t[(k + 2) % 3]);
          place = 0.5 * (a + b);
          if (!fixed[k] && glm::length(a - b) > 0.7) return true;
        }
        return false;
      },
      [&](int) { ++inserted; }, 10000);
  EXPECT_GT(inserted, 5);
  EXPECT_LT(inserted, 200);
  std::vector<Vec2> points;
  for (int i = 0; i < triangulation.size(); ++i) points.push_back(triangulation.point(i));
  const auto triangles = triangulation.triangles();
  EXPECT_NEAR(total_area(points, triangles), 12, 1e-12);
  EXPECT_EQ(triangles.size(), static_cast<size_t>(border + 2 * inserted));
}

}  // namespace
}  // namespace lekalo::geometry::triangulation_test
