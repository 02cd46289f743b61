// Simplex splines against their recursion in 113 bits, with the half-open rule, and what follows from their definition;
// the cells between segments; curved triangles.
#include "geometry/surfaces/triangles/simplex_spline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "geometry/surfaces/triangles/curved_triangles.h"
#include "geometry/surfaces/triangles/planar_cells.h"

namespace lekalo::geometry::simplex_spline_test {

namespace {

using Quad = __float128;

Quad determinant(const Vec2& p, const Vec2& q, const Vec2& r) {
  return (Quad(q.x) - p.x) * (Quad(r.y) - p.y) - (Quad(q.y) - p.y) * (Quad(r.x) - p.x);
}

Quad magnitude(Quad x) { return x < 0 ? -x : x; }

// (3.13.1) on the first three knots that are not collinear.
Quad by_recursion(const std::vector<Vec2>& knots, const Vec2& p) {
  if (knots.size() == 3) {
    const Quad d = determinant(knots[0], knots[1], knots[2]);
    return d != 0 && in_half_open_region(knots, p) ? 1 / magnitude(d) : Quad(0);
  }
  for (size_t a = 0; a < knots.size(); ++a)
    for (size_t b = a + 1; b < knots.size(); ++b)
      for (size_t c = b + 1; c < knots.size(); ++c) {
        const Quad d = determinant(knots[a], knots[b], knots[c]);
        if (d == 0) continue;
        const auto without = [&](size_t k) {
          std::vector<Vec2> others = knots;
          others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
          return by_recursion(others, p);
        };
        return (determinant(p, knots[b], knots[c]) * without(a) + determinant(knots[a], p, knots[c]) * without(b) +
                determinant(knots[a], knots[b], p) * without(c)) /
               d;
      }
  return 0;
}

std::vector<Vec2> random_points(size_t count, std::mt19937_64& random, bool on_a_grid) {
  std::uniform_real_distribution<double> uniform(0, 4);
  std::vector<Vec2> points;
  for (size_t k = 0; k < count; ++k) {
    const Vec2 p(uniform(random), uniform(random));
    points.push_back(on_a_grid ? glm::round(p) : p);
  }
  return points;
}

TEST(SimplexSpline, IsItsRecursion) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  int checked = 0;
  for (const bool on_a_grid : {false, true})  // with multiple and collinear knots
    for (size_t m = 3; m <= 7; ++m)
      for (int set = 0; set < 3; ++set) {
        const std::vector<Vec2> knots = random_points(m, random, on_a_grid);
        const std::vector<Vec2> hull = convex_hull(knots);
        if (hull.size() < 3) continue;
        const SimplexSpline spline(knots);
        const PlanarCells cells = planar_cells(hull, all_segments(knots));
        for (size_t t = 0; t < cells.triangles.size(); t += 1 + cells.triangles.size() / 12) {
          const ParameterTriangle cell{cells.corners(t)};
          if (std::abs(cell.determinant()) < 1e-6) continue;
          const TriangularNetOf<double> net = spline.net(cell.corners);
          const double a = 0.1 + 0.5 * uniform(random), b = 0.1 + 0.2 * uniform(random);
          const Vec2 p = cell.point({a, b, 1 - a - b});
          const auto truth = static_cast<double>(by_recursion(knots, p));
          EXPECT_NEAR(value_at(net, {a, b, 1 - a - b}), truth, 1e-13) << m << " knots";
          ++checked;
        }
      }
  EXPECT_GT(checked, 150);
}

TEST(SimplexSpline, IsTheDividedDifferenceOfTruncatedPowers) {
  std::mt19937_64 random(4);
  for (size_t m = 3; m <= 7; ++m) {
    const std::vector<Vec2> knots = random_points(m, random, false);
    const SimplexSpline spline(knots);
    const PlanarCells cells = planar_cells(convex_hull(knots), all_segments(knots));
    for (const Vec2& x : {Vec2(5.1, 0.7), Vec2(2.03, 1.91)})
      for (size_t t = 0; t < cells.triangles.size(); t += 1 + cells.triangles.size() / 8) {
        const TriangularNetOf<double> a = spline.net(cells.corners(t)),
                                      b = truncated_power_net(knots, x, cells.corners(t));
        for (size_t k = 0; k < a.points.size(); ++k) EXPECT_NEAR(a.points[k], b.points[k], 1e-8);
      }
  }
}

// (3.12.6-3.12.9): symmetric in the points, and (3.12.10): a factor d(r, q, p) takes a point p away.
TEST(HomogeneousDividedDifference, DropsAPointWithItsDeterminant) {
  std::mt19937_64 random(5);
  const std::vector<Vec2> points = random_points(5, random, false), fewer(points.begin(), points.end() - 1);
  const auto g = [](const Vec2& r, const Vec2& q) { return std::cos(r.x + q.x) + r.y * q.y; };
  const auto f = [&](const Vec2& r, const Vec2& q) { return homogeneous_determinant(r, q, points.back()) * g(r, q); };
  const double taken = homogeneous_divided_difference(points, f);
  EXPECT_NEAR(taken, homogeneous_divided_difference(fewer, g), 1e-12 * std::abs(taken));
  std::vector<Vec2> turned(points.rbegin(), points.rend());
  EXPECT_NEAR(taken, homogeneous_divided_difference(turned, f), 1e-12 * std::abs(taken));
  EXPECT_THROW(homogeneous_divided_difference(std::vector<Vec2>{{0, 0}, {1, 1}, {2, 2}}, g), std::invalid_argument);
}

TEST(SimplexSpline, RefusesWhatIsNone) {
  EXPECT_THROW(SimplexSpline({{0, 0}, {1, 1}, {3, 3}, {2, 2}}), std::invalid_argument);
  EXPECT_THROW(SimplexSpline({{0, 0}, {1, 1}}), std::invalid_argument);
  EXPECT_THROW(SimplexSpline(std::vector<Vec2>(13, Vec2(0))), std::invalid_argument);
}

// Cells have the area of the region, no segment goes through one, neighbours share whole sides.
TEST(PlanarCells, TileTheRegion) {
  std::mt19937_64 random(6);
  for (const bool on_a_grid : {false, true})
    for (int set = 0; set < 6; ++set) {
      const std::vector<Vec2> points = random_points(9, random, on_a_grid), hull = convex_hull(points);
      ASSERT_GE(hull.size(), 3u);
      const std::vector<PlanarSegment> segments = all_segments(points);
      const PlanarCells cells = planar_cells(hull, segments);
      double area = 0, whole = 0;
      for (size_t k = 0; k < hull.size(); ++k)
        whole += 0.5 * (hull[k].x * hull[(k + 1) % hull.size()].y - hull[k].y * hull[(k + 1) % hull.size()].x);
      std::map<std::pair<int, int>, int> sides;
      for (size_t t = 0; t < cells.triangles.size(); ++t) {
        const auto c = cells.corners(t);
        const double twice = homogeneous_determinant(c[0], c[1], c[2]);
        EXPECT_GT(twice, 0);
        area += 0.5 * twice;
        for (size_t k = 0; k < 3; ++k) ++sides[{cells.triangles[t][k], cells.triangles[t][(k + 1) % 3]}];
        const Vec2 middle = (c[0] + c[1] + c[2]) / 3.0;
        for (const PlanarSegment& s : segments) {
          // The nearest place of the segment to the middle is not inside.
          const Vec2 along = s.to - s.from;
          const double where = std::clamp(glm::dot(middle - s.from, along) / glm::dot(along, along), 0.0, 1.0);
          const Barycentric at = ParameterTriangle{c}.coordinates(s.from + where * along);
          EXPECT_LE(std::min({at.x, at.y, at.z}), 1e-7);
        }
      }
      EXPECT_NEAR(area, whole, 1e-12);
      double free = 0;
      for (const auto& [side, count] : sides) {
        EXPECT_EQ(count, 1);
        if (!sides.contains({side.second, side.first}))
          free += glm::length(cells.points[static_cast<size_t>(side.first)] -
                              cells.points[static_cast<size_t>(side.second)]);
      }
      double border = 0;
      for (size_t k = 0; k < hull.size(); ++k) border += glm::length(hull[k] - hull[(k + 1) % hull.size()]);
      EXPECT_NEAR(free, border, 1e-11);
    }
}

TriangleCorner random_corner(std::mt19937_64& random, const Vec2& uv) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto vector = [&] { return Vec3(uniform(random), uniform(random), uniform(random)); };
  TriangleCorner corner{vector(), {}, uv, vector(), vector()};
  corner.normal = glm::normalize(glm::cross(corner.du, corner.dv));
  return corner;
}

// Derivatives by u and v at a place of a side, and across the inner sides.
TEST(CloughTocher, NeighboursHaveEqualDerivatives) {
  std::mt19937_64 random(7);
  const TriangleCorner p = random_corner(random, {0, 0}), q = random_corner(random, {2, 0.3}),
                       r = random_corner(random, {0.7, 1.5}), s = random_corner(random, {1.8, 2.2});
  const auto surfaces = [](const std::array<TriangleCorner, 3>& corners) {
    std::vector<BezierTriangle> result;
    const std::array<TriangularNet, 3> nets = clough_tocher(corners);
    const Vec2 middle = (corners[0].uv + corners[1].uv + corners[2].uv) / 3.0;
    for (size_t k = 0; k < 3; ++k)
      result.emplace_back(nets[k], ParameterTriangle{{corners[k].uv, corners[(k + 1) % 3].uv, middle}});
    return result;
  };
  const std::vector<BezierTriangle> a = surfaces({p, q, r}), b = surfaces({q, s, r});
  const auto agree = [](const BezierTriangle& one, const BezierTriangle& other, const Vec2& from, const Vec2& to) {
    for (const double t : {0.1, 0.35, 0.8}) {
      const SurfaceJet x = one.evaluate_over_triangle(from + t * (to - from), 1),
                       y = other.evaluate_over_triangle(from + t * (to - from), 1);
      for (int k = 0; k < 3; ++k)
        EXPECT_LE(glm::length(x.values[static_cast<size_t>(k)] - y.values[static_cast<size_t>(k)]), 1e-13);
    }
  };
  agree(a[1], b[2], q.uv, r.uv);  // the side q r of both
  const Vec2 middle = (p.uv + q.uv + r.uv) / 3.0;
  agree(a[0], a[1], q.uv, middle);
  agree(a[1], a[2], r.uv, middle);
  agree(a[2], a[0], p.uv, middle);
  const SurfaceJet at = a[0].evaluate_over_triangle(p.uv, 1);
  EXPECT_LE(glm::length(at.du() - p.du) + glm::length(at.dv() - p.dv) + glm::length(at.point() - p.point), 1e-14);
}

// The table of 3.17 for a torus R = 3, r = 1 with exact normals, each cell cut by the same diagonal: the largest
// distance from the torus, and the largest error of normals.
TEST(CurvedTriangles, ErrorsOnATorus) {
  const auto corner = [](double u, double v) {
    const Vec3 out(std::cos(u), std::sin(u), 0), n = std::cos(v) * out + Vec3(0, 0, std::sin(v));
    return TriangleCorner{3.0 * out + n, n, {}, {}, {}};
  };
  const auto errors = [&](int count_u, int count_v, CurvedTriangle kind,
                          EdgeTangents tangents = EdgeTangents::projected) {
    Vec2 worst(0);
    for (int j = 0; j < count_v; ++j) {
      const double u = 2 * kPi / count_u, v0 = 2 * kPi * j / count_v, v1 = 2 * kPi * (j + 1) / count_v;
      for (const auto& corners : {std::array{corner(0, v0), corner(u, v0), corner(u, v1)},
                                  std::array{corner(0, v0), corner(u, v1), corner(0, v1)}}) {
        const BezierTriangle surface(curved_triangle(corners, kind, tangents));
        each_index(12, [&](int a, int b, int) {
          const SurfaceJet jet = surface.evaluate_over_triangle({a / 12.0, b / 12.0}, 1);
          const Vec3 p = jet.point(), out = glm::normalize(Vec3(p.x, p.y, 0)), off = p - 3.0 * out;
          worst.x = std::max(worst.x, std::abs(glm::length(off) - 1));
          const double cosine = glm::dot(glm::normalize(glm::cross(jet.du(), jet.dv())), glm::normalize(off));
          worst.y = std::max(worst.y, std::acos(std::min(1.0, cosine)) * 180 / kPi);
        });
      }
    }
    return worst;
  };
  struct Row {
    int u, v;
    CurvedTriangle kind;
    double distance, angle;
  };
  for (const Row& row : {Row{12, 8, CurvedTriangle::hermite, 3.22e-2, 23.5},
                         {12, 8, CurvedTriangle::balanced, 3.22e-2, 7.0},
                         {12, 8, CurvedTriangle::pn, 3.22e-2, 7.0},
                         {24, 16, CurvedTriangle::hermite, 1.33e-2, 14.9},
                         {24, 16, CurvedTriangle::balanced, 2.36e-3, 1.54},
                         {24, 16, CurvedTriangle::pn, 2.36e-3, 1.13},
                         {48, 32, CurvedTriangle::hermite, 3.80e-3, 8.1},
                         {48, 32, CurvedTriangle::balanced, 1.58e-4, 0.39},
                         {48, 32, CurvedTriangle::pn, 1.57e-4, 0.23}}) {
    const Vec2 found = errors(row.u, row.v, row.kind);
    // To the digits that the table has.
    EXPECT_NEAR(found.x, row.distance, 0.006 * row.distance) << row.u << " cells, kind " << static_cast<int>(row.kind);
    EXPECT_NEAR(found.y, row.angle, row.angle < 1 ? 0.006 : 0.06)
        << row.u << " cells, kind " << static_cast<int>(row.kind);
  }
  // Tangents as long as those of arcs.
  EXPECT_NEAR(errors(24, 16, CurvedTriangle::balanced, EdgeTangents::arc).x, 1.14e-3, 0.006e-3);
}

}  // namespace

}  // namespace lekalo::geometry::simplex_spline_test
