#include "geometry/surfaces/splines/bezier_surface.h"

#include "geometry/surfaces/surface_checks.h"

namespace lekalo::geometry::bezier_surface_test {
namespace {

using checks::distance;
using List = std::vector<double>;

void expect_near(const Vec3& a, const Vec3& b, double tolerance) { EXPECT_LE(distance(a, b), tolerance); }

// The books index rows with v; here the first index runs with u.
Grid<Vec3> rows_along_v(const std::vector<std::vector<Vec3>>& rows) {
  Grid<Vec3> net{static_cast<int>(rows[0].size()), static_cast<int>(rows.size()), {}};
  for (size_t j = 0; j < rows[0].size(); ++j)
    for (const auto& row : rows) net.values.push_back(row[j]);
  return net;
}

// Golovanov 2016, 3.7: the meridian conic revolved by alpha about z, weights (1, w_u, 1) x (1, w_v, 1).
NurbsSurface revolved(const std::vector<Vec2>& meridian, double alpha_u, double alpha_v, bool exchanged = false) {
  std::vector<std::vector<Vec3>> rows;
  for (const Vec2& p : meridian)
    rows.push_back({{p.x, 0, p.y},
                    {p.x, p.x * std::tan(alpha_u / 2), p.y},
                    {p.x * std::cos(alpha_u), p.x * std::sin(alpha_u), p.y}});
  double wu = std::cos(alpha_u / 2), wv = std::cos(alpha_v / 2);
  if (exchanged) std::swap(wu, wv);
  const List weights = {1, wv, 1, wu, wu * wv, wu, 1, wv, 1};
  return bezier_surface(rows_along_v(rows), weights);
}

double torus_residual(const Vec3& p) {
  const double rho = std::hypot(p.x, p.y) - 3;
  return rho * rho + p.z * p.z - 1;
}

TEST(BezierSurface, FirstIndexRunsWithU) {
  const NurbsSurface s =
      bezier_surface(rows_along_v({{{0, 0, 0}, {1, 0, 2}, {2, 0, 0}}, {{0, 3, 0}, {1, 3, 0}, {2, 3, 0}}}));
  expect_near(s.point(0.25, 0.5), {0.5, 1.5, 0.375}, 1e-16);
}

TEST(BezierSurface, TorusPartHasTheBooksPoints) {
  const std::vector<Vec2> meridian = {{4, 0}, {4, 1}, {3, 1}};
  const NurbsSurface s = revolved(meridian, 2 * kPi / 3, kPi / 2);
  expect_near(s.point(0.5, 0.5), {1.853553390593274, 3.210448647049110, 0.707106781186548}, 2e-15);
  expect_near(s.point(0.25, 0.5), {3.279363691049638, 1.728703117641829, 0.707106781186548}, 2e-15);
  for (double u = 0; u <= 1; u += 0.125)
    for (double v = 0; v <= 1; v += 0.125) EXPECT_NEAR(torus_residual(s.point(u, v)), 0, 3e-15);
  EXPECT_NEAR(std::abs(torus_residual(revolved(meridian, 2 * kPi / 3, kPi / 2, true).point(0.5, 0.5))), 0.68, 0.005);
  checks::check_surface(s);
}

TEST(BezierSurface, SphereOctantHasTheBooksDerivativesAndItsPole) {
  const NurbsSurface s = revolved({{1, 0}, {1, 1}, {0, 1}}, kPi / 2, kPi / 2);
  const SurfaceJet jet = s.evaluate(0.25, 0.75, 2);
  expect_near(s.point(0.5, 0.5), {0.5, 0.5, std::sqrt(0.5)}, 4e-16);
  expect_near(jet.point(), {0.342250154633602, 0.135493715207440, 0.929788301062430}, 1e-15);
  expect_near(jet.du(), {-0.215260137635541, 0.543736034394084, 0}, 1e-15);
  expect_near(jet.dv(), {-1.373449252360742, -0.543736034394084, 0.584795521488902}, 2e-15);
  expect_near(jet.duv(), {0.863838543521223, -2.182011723908885, 0}, 4e-15);
  EXPECT_TRUE(s.degenerate_edges().v_max);
  for (double u = 0; u <= 1; u += 0.125) expect_near(s.normal(u, 1), {0, 0, 1}, 1e-15);
  checks::check_surface(s);
}

// Golovanov 2016, 3.7, pitfalls: a rational bilinear facet with unequal weights is not the bilinear surface.
TEST(BezierSurface, RationalFacetLeavesTheBilinearSurface) {
  Grid<Vec3> net{2, 2, {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 1}}};
  expect_near(bezier_surface(net, List{1, 1, 1, 3}).point(0.5, 0.5), {2. / 3, 2. / 3, 0.5}, 2e-16);
  expect_near(bezier_surface(net, List{5, 5, 5, 5}).point(0.5, 0.5), {0.5, 0.5, 0.25}, 0);
}

// Coursework 2024, 1.3.2: every point of the quarter cylinder at distance 1 from its axis, area pi/2 h (midpoint rule).
TEST(BezierSurface, QuarterCylinderHasItsArea) {
  Grid<Vec3> net{3, 2, {{1, 0, 0}, {1, 0, 2}, {1, 1, 0}, {1, 1, 2}, {0, 1, 0}, {0, 1, 2}}};
  const NurbsSurface s = bezier_surface(net, List{1, 1, 1, 1, 2, 2});
  double area = 0;
  const int n = 2000;
  for (int i = 0; i < n; ++i) {
    const SurfaceJet jet = s.evaluate((i + 0.5) / n, 0.3, 1);
    EXPECT_NEAR(std::hypot(jet.point().x, jet.point().y), 1, 3e-16);
    area += glm::length(glm::cross(jet.du(), jet.dv())) / n;
  }
  EXPECT_NEAR(area, kPi, 1e-6);
}

TEST(BezierSurface, RandomSurfacesMeetTheGeneralChecks) {
  std::mt19937_64 random(51);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int sample = 0; sample < 6; ++sample) {
    Grid<Vec3> net{2 + sample % 4, 2 + sample % 3, {}};
    List weights;
    for (int i = 0; i < net.rows; ++i)
      for (int j = 0; j < net.columns; ++j) {
        net.values.push_back({i + 0.4 * uniform(random), j + 0.4 * uniform(random), uniform(random)});
        weights.push_back(std::pow(10, 0.15 * uniform(random)));
      }
    checks::check_surface(bezier_surface(net, sample % 2 ? weights : List()));
    const NurbsSurface part = bezier_surface(net, weights, {{0.25, 0.5}, {0.1, 1}});
    checks::check_pieces(part);
    checks::check_nurbs(part);
    expect_near(part.point(-0.5, 1.5), bezier_surface(net, weights).point(-0.5, 1.5), 1e-11);
    if (HasFailure()) return;
  }
}

TEST(BezierSurface, RefusesNetsThatAreNoNets) {
  EXPECT_THROW(bezier_surface(Grid<Vec3>{1, 4, std::vector<Vec3>(4)}), FieldError);
  EXPECT_THROW(bezier_surface(Grid<Vec3>{27, 2, std::vector<Vec3>(54)}), FieldError);
  EXPECT_THROW(bezier_surface(Grid<Vec3>{2, 2, std::vector<Vec3>(4)}, List{1, 1, 1}), FieldError);
  EXPECT_THROW(bezier_surface(Grid<Vec3>{2, 2, std::vector<Vec3>(4)}, List{1, 1, 1, -1}), FieldError);
}

}  // namespace
}  // namespace lekalo::geometry::bezier_surface_test
