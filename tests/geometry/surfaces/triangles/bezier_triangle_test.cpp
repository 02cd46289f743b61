// Bezier triangles and surfaces on three curves: over their square, over their triangle, their parts and nets.
#include "geometry/surfaces/triangles/bezier_triangle.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/describe.h"
#include "geometry/mesh.h"
#include "geometry/surfaces/triangles/three_curves.h"
#include "tests/geometry/surfaces/surface_checks.h"

namespace lekalo::geometry {

TypeDeclaration control_triangles_type();

}  // namespace lekalo::geometry

namespace lekalo::geometry::bezier_triangle_test {

namespace {

TriangularNet random_net(int degree, bool rational, uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  TriangularNet net{degree, {}};
  each_index(degree, [&](int i, int j, int) {
    const double w = rational ? 1.5 + uniform(random) : 1;
    net.points.push_back(w * Vec4(i + 0.3 * uniform(random), j + 0.3 * uniform(random), uniform(random), 1));
  });
  return net;
}

const ParameterTriangle kTriangle{{Vec2(0.5, 0.2), Vec2(3, 1), Vec2(1, 4)}};

// The definition (3.11.2) in long double.
Vec3 by_definition(const TriangularNet& net, const Barycentric& t) {
  long double sum[4] = {0, 0, 0, 0};
  each_index(net.degree, [&](int i, int j, int k) {
    const long double factor = std::tgamma(net.degree + 1.0L) /
                               (std::tgamma(i + 1.0L) * std::tgamma(j + 1.0L) * std::tgamma(k + 1.0L)) *
                               std::pow(static_cast<long double>(t.x), i) * std::pow(static_cast<long double>(t.y), j) *
                               std::pow(static_cast<long double>(t.z), k);
    for (int c = 0; c < 4; ++c) sum[c] += factor * net.at(i, j)[c];
  });
  return {static_cast<double>(sum[0] / sum[3]), static_cast<double>(sum[1] / sum[3]),
          static_cast<double>(sum[2] / sum[3])};
}

Barycentric random_place(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  double a = uniform(random), b = uniform(random);
  if (a + b > 1) a = 1 - a, b = 1 - b;
  return {a, b, 1 - a - b};
}

TEST(BezierTriangle, IsItsDefinitionOverSquareAndTriangle) {
  std::mt19937_64 random(1);
  for (const bool rational : {false, true})
    for (const TrianglePole pole : {TrianglePole::first, TrianglePole::second})
      for (int degree = 1; degree <= 6; ++degree) {
        const TriangularNet net = random_net(degree, rational, 7 + static_cast<uint64_t>(degree));
        const BezierTriangle surface(net, kTriangle, pole);
        for (int k = 0; k < 10; ++k) {
          const Barycentric t = random_place(random);
          const Vec3 truth = by_definition(net, t);
          EXPECT_LE(glm::length(surface.evaluate_over_triangle(kTriangle.point(t), 0).point() - truth), 2e-14 * degree);
          const Vec2 uv = pole == TrianglePole::first ? Vec2(t.x, t.y / (t.y + t.z)) : Vec2(t.x / (t.x + t.z), t.y);
          EXPECT_LE(glm::length(surface.point(uv.x, uv.y) - truth), 2e-14 * degree);
        }
      }
}

TEST(BezierTriangle, DerivativesOverTheTriangle) {
  const TriangularNet net = random_net(4, true, 3);
  const BezierTriangle surface(net, kTriangle);
  std::mt19937_64 random(2);
  for (int k = 0; k < 10; ++k) {
    const Vec2 at = kTriangle.point(random_place(random));
    const SurfaceJet jet = surface.evaluate_over_triangle(at, 3);
    for (int n = 0; n < 3; ++n)
      for (int j = 0; j <= n; ++j)
        for (const bool by_u : {true, false}) {
          const double h = 1e-4;
          const Vec2 step = by_u ? Vec2(h, 0) : Vec2(0, h);
          const auto value = [&](const Vec2& uv) { return surface.evaluate_over_triangle(uv, n).d(n - j, j); };
          const Vec3 difference =
              (8.0 * (value(at + step) - value(at - step)) - (value(at + 2.0 * step) - value(at - 2.0 * step))) /
              (12 * h);
          EXPECT_LE(glm::length(difference - (by_u ? jet.d(n - j + 1, j) : jet.d(n - j, j + 1))), 1e-9);
        }
    // The chain of the square's parameters has the same normal.
    const Barycentric t = kTriangle.coordinates(at);
    EXPECT_LE(glm::length(glm::normalize(glm::cross(jet.du(), jet.dv())) - surface.normal(t.x, t.y / (t.y + t.z))),
              1e-12);
  }
}

TEST(BezierTriangle, IsASurface) {
  for (const TrianglePole pole : {TrianglePole::first, TrianglePole::second}) {
    const BezierTriangle surface(random_net(3, true, 5), {}, pole);
    checks::check_differences(surface, surface.domain());
    checks::check_enclosures(surface, surface.domain());
    checks::check_pieces(surface);
    EXPECT_EQ(surface.degenerate_edges().u_max, pole == TrianglePole::first);
    EXPECT_EQ(surface.degenerate_edges().v_max, pole == TrianglePole::second);
  }
}

TEST(TriangularNet, PartsRaisedAndPermutedNetsAreTheSameSurface) {
  std::mt19937_64 random(4);
  for (int degree = 1; degree <= 5; ++degree) {
    const TriangularNet net = random_net(degree, true, 11);
    const std::array<Barycentric, 3> corners{random_place(random), random_place(random), random_place(random)};
    const TriangularNet part = part_of(net, corners);
    for (int k = 0; k < 5; ++k) {
      const Barycentric t = random_place(random);
      EXPECT_LE(glm::length(by_definition(part, t) -
                            by_definition(net, t.x * corners[0] + t.y * corners[1] + t.z * corners[2])),
                1e-13);
      EXPECT_LE(glm::length(by_definition(elevated(net), t) - by_definition(net, t)), 1e-14 * degree);
      EXPECT_LE(glm::length(by_definition(permuted(net, {2, 0, 1}), {t.z, t.x, t.y}) - by_definition(net, t)),
                1e-14 * degree);
    }
  }
}

// (3.10.11) against its Bezier net, and the derivatives that the net makes of it.
TEST(ThreeCurves, NetIsTheFormula) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Vec3 p[] = {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  const auto curve = [&](const Vec3& from, const Vec3& to, int degree) {
    std::vector<Vec3> points{from};
    for (int i = 1; i < degree; ++i) points.emplace_back(uniform(random), uniform(random), uniform(random));
    points.push_back(to);
    return points;
  };
  const std::array<std::vector<Vec3>, 3> c{curve(p[2], p[1], 3), curve(p[0], p[2], 2), curve(p[1], p[0], 4)};
  const auto at = [&](int q, double t) {
    std::vector<Vec3> points = c[static_cast<size_t>(q - 1)];
    for (size_t n = points.size() - 1; n > 0; --n)
      for (size_t i = 0; i < n; ++i) points[i] += t * (points[i + 1] - points[i]);
    return points[0];
  };
  const Vec3 correction = at(1, 0.5) + at(2, 0.5) + at(3, 0.5) - p[0] - p[1] - p[2];
  const TriangularNet plain = net_on_three_curves(c), balanced = balanced_net_on_three_curves(c);
  for (int k = 0; k < 20; ++k) {
    const Barycentric t = random_place(random);
    const Vec3 formula = t.x * (at(3, 1 - t.y) + at(2, t.z) - p[0]) + t.y * (at(1, 1 - t.z) + at(3, t.x) - p[1]) +
                         t.z * (at(2, 1 - t.x) + at(1, t.y) - p[2]);
    EXPECT_LE(glm::length(Vec3(value_at(plain, t)) - formula), 1e-14);
    EXPECT_LE(glm::length(Vec3(value_at(balanced, t)) - (formula - 4 * t.x * t.y * t.z * correction)), 1e-14);
  }
}

TEST(ControlPolyhedron, HasAllFacetsAndEdges) {
  for (int n = 1; n <= 5; ++n) {
    const SurfacePtr surface = std::make_shared<BezierTriangle>(random_net(n, false, 9));
    Fields fields;
    fields.set("of", surface);
    fields.set("facets", std::string("all"));
    const auto all = std::any_cast<MeshPtr>(control_triangles_type().build(fields));
    EXPECT_EQ(all->triangles.size(), static_cast<size_t>(n * n));
    const MeshSides edges = sides(*all);
    EXPECT_EQ(edges.count, static_cast<size_t>(3 * n * (n + 1) / 2));
    EXPECT_EQ(edges.free, static_cast<size_t>(3 * n));
    EXPECT_EQ(edges.turned + edges.crowded, 0u);
    fields.set("facets", std::string("upright"));
    const auto upright = std::any_cast<MeshPtr>(control_triangles_type().build(fields));
    EXPECT_EQ(upright->triangles.size(), static_cast<size_t>(n * (n + 1) / 2));
  }
}

TEST(HalfOpenRegion, EachPlaceOfATilingIsInOne) {
  const Vec2 middle(2, 2), corners[] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  const auto count = [&](const Vec2& p) {
    int found = 0;
    for (int k = 0; k < 4; ++k) {
      const Vec2 triangle[] = {middle, corners[k], corners[(k + 1) % 4]};
      const Vec2 turned[] = {corners[(k + 1) % 4], corners[k], middle};
      EXPECT_EQ(in_half_open_region(triangle, p), in_half_open_region(turned, p));
      found += in_half_open_region(triangle, p);
    }
    return found;
  };
  for (const Vec2& p : {Vec2(0, 0), Vec2(1, 1), Vec2(3, 3), Vec2(1, 3), Vec2(3, 1), Vec2(2, 0), Vec2(0, 2), Vec2(2, 2)})
    EXPECT_EQ(count(p), 1) << p.x << ", " << p.y;
  for (const Vec2& p : {Vec2(4, 0), Vec2(4, 4), Vec2(0, 4), Vec2(4, 2), Vec2(2, 4)})
    EXPECT_EQ(count(p), 0) << p.x << ", " << p.y;
}

}  // namespace

}  // namespace lekalo::geometry::bezier_triangle_test
