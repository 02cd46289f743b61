// Normals at places where r_u x r_v vanishes, against closed forms of the limits (Golovanov 2016, 3.1).
#include "geometry/curves/splines/bezier_curve.h"
#include "geometry/surfaces/splines/bezier_surface.h"
#include "geometry/surfaces/surface_checks.h"
#include "geometry/surfaces/swept/revolution.h"
#include "support/surface_of_formula.h"
#include "support/worst.h"

namespace lekalo::geometry::surface_normal_test {
namespace {

using checks::distance;
using tests::SurfaceOfFormula;

TEST(ParametricNormal, PolesOfASphere) {
  const SurfaceOfFormula sphere(
      [](const auto& u, const auto& v) {
        using std::cos, std::sin;
        return Triple{cos(u) * cos(v) * 3.0, sin(u) * cos(v) * 3.0, sin(v) * 3.0};
      },
      {{0, kTwoPi}, {-kPi / 2, kPi / 2}});
  for (double u = 0; u < 6; u += 0.7) {
    EXPECT_LE(distance(sphere.normal(u, kPi / 2), {0, 0, 1}), 1e-15);
    EXPECT_LE(distance(sphere.normal(u, -kPi / 2), {0, 0, -1}), 1e-15);
    for (double d = 1e-14; d < 0.1; d *= 10) {
      const Vec3 p = sphere.point(u, kPi / 2 - d) / 3.0;
      EXPECT_LE(distance(sphere.normal(u, kPi / 2 - d), p), kPi * 1e-8);
    }
  }
}

// The tip of a cone has one normal for each generatrix, on both nappes.
TEST(ParametricNormal, TipOfAConeKeepsItsGeneratrix) {
  const auto formula = [](const auto& u, const auto& v) {
    using std::cos, std::sin;
    return Triple{cos(u) * v * 0.5, sin(u) * v * 0.5, -1.0 * v};
  };
  const SurfaceOfFormula lower(formula, {{0, kTwoPi}, {0, 2}}), upper(formula, {{0, kTwoPi}, {-2, 0}});
  for (double u = 0; u < 6; u += 0.5) {
    // r_u x r_v = v/2 (-cos u, -sin u, -1/2), by hand.
    const Vec3 n = glm::normalize(Vec3(-std::cos(u), -std::sin(u), -0.5));
    EXPECT_LE(distance(lower.normal(u, 0), n), 1e-15);
    EXPECT_LE(distance(upper.normal(u, 0), -n), 1e-15);
  }
}

// Horn torus: the tip lies inside the domain; each side has its own limit.
TEST(ParametricNormal, SidesOfASingularLineKeepTheirNormals) {
  const SurfaceOfFormula horn(
      [](const auto& u, const auto& v) {
        using std::cos, std::sin;
        return Triple{(1.0 + cos(v)) * cos(u), (1.0 + cos(v)) * sin(u), sin(v)};
      },
      {{0, kTwoPi}, {0, kTwoPi}});
  // N/|N| = (cos u cos v, sin u cos v, sin v) on both sides: rho does not change its sign.
  for (const double d : {0.0, 1e-13, 1e-10, 1e-6, 1e-3})
    for (const double side : {-1.0, 1.0}) {
      const double v = kPi + side * d;
      EXPECT_LE(distance(horn.normal(0.4, v), {std::cos(0.4) * std::cos(v), std::sin(0.4) * std::cos(v), std::sin(v)}),
                1e-7);
    }
}

// r_u parallel to r_v at the corner: z = 0 plane patch whose corner tangents coincide.
TEST(ParametricNormal, CornerWithParallelTangents) {
  const Grid<Vec3> net{3,
                       3,
                       {{0, 0, 0},
                        {1, 0, 0},
                        {2, -1, 0},  //
                        {1, 0, 0},
                        {2, 0, 0},
                        {3, 0, 0},  //
                        {2, 1, 0},
                        {3, 1, 0},
                        {4, 0, 0}}};
  const NurbsSurface s = bezier_surface(net);
  const Vec3 near = s.normal(1e-3, 1e-3);
  EXPECT_NEAR(std::abs(near.z), 1, 1e-15);
  EXPECT_LE(distance(s.normal(0, 0), near), 1e-15);
}

// An edge collapsed to higher order: two rows of control points in one point (r_v = r_vv.. = 0 at the first order).
TEST(ParametricNormal, DoublyCollapsedEdge) {
  Grid<Vec3> net{4, 4, {}};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const double angle = i * 0.4, radius = j < 2 ? 0 : j == 2 ? 1 : 2;
      net.values.push_back({radius * std::cos(angle), radius * std::sin(angle), j == 3 ? -0.5 : 0});
    }
  const NurbsSurface s = bezier_surface(net);
  EXPECT_TRUE(s.degenerate_edges().v_min);
  for (double u = 0; u <= 1; u += 0.125) {
    const Vec3 n = s.normal(u, 0);
    EXPECT_NEAR(std::abs(n.z), 1, 1e-12);
    EXPECT_LE(distance(n, s.normal(u, 1e-3)), 5e-3);
  }
}

// A Bezier triangle as a patch with one edge shrunk to a point: smooth at the point, from every side.
TEST(ParametricNormal, BezierEdgeShrunkToAPoint) {
  Grid<Vec3> net{4, 4, {}};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const double x = i / 3.0 - 0.5, y = j / 3.0;
      net.values.push_back({5 + x * y, -3 + y, 2 + 0.3 * y * y * (1 + x)});
    }
  const NurbsSurface s = bezier_surface(net);
  EXPECT_TRUE(s.degenerate_edges().v_min);
  // At the point all control legs (x y, y, ..) lie in the plane z = 2 up to the term y^2 of the second row.
  double turn = 0;
  for (double u = 0; u <= 1; u += 0.0625) {
    const Vec3 limit = s.normal(u, 0);
    EXPECT_NEAR(glm::length(limit), 1, 1e-15);
    for (double v = 1e-14; v < 1e-2; v *= 10) {
      const double change = distance(s.normal(u, v), limit);
      EXPECT_LE(change, 3 * v + 1e-7);
      turn = tests::worse(turn, change);
    }
  }
  EXPECT_GT(turn, 1e-4);  // the surface is curved there
}

// Nearer to a pole than the doubles of its coordinates tell, the derivative along the turn is rounding and may point
// anywhere.
TEST(ParametricNormal, BesideAPoleFarOffTheOrigin) {
  const Vec3 pole(2347.3, -2739.1, 1563.7);
  const Vec3 axis = glm::normalize(Vec3(0.3, -0.2, 0.9)), side = glm::normalize(glm::cross(axis, Vec3(1, 2, 0.3)));
  const std::vector<Vec3> points{pole, pole + 0.9 * side, pole + 0.1 * side + 1.1 * axis, pole + 2.0 * axis};
  const RevolutionSurface spindle(std::make_shared<NurbsCurve>(bezier_curve(points)), Axis{pole, axis});
  const Vec3 limit = spindle.normal(0, 0);
  EXPECT_LE(distance(limit, glm::dot(limit, axis) * axis), 1e-12);
  for (double u = 1e-17; u < 1e-5; u *= 3)
    for (double v = 0; v < kTwoPi; v += 0.1)
      EXPECT_LE(distance(spindle.normal(u, v), limit), 3 * u + 1e-7) << u << " " << v;
}

// z = sqrt(1 - x^2) is vertical at its borders, where r_u is infinite.
TEST(ParametricNormal, RootOfZero) {
  const SurfaceOfFormula half(
      [](const auto& u, const auto& v) {
        using std::sqrt;
        return Triple{u, v, sqrt(1.0 - u * u)};
      },
      {{-1, 1}, {-1, 1}});
  for (const double v : {-1.0, 0.0, 0.5}) {
    EXPECT_LE(distance(half.normal(1, v), {1, 0, 0}), 1e-7);
    EXPECT_LE(distance(half.normal(-1, v), {-1, 0, 0}), 1e-7);
  }
}

TEST(ParametricNormal, ReversedSurfacesTurnTheirNormals) {
  NurbsSurface s = bezier_surface(Grid<Vec3>{2, 2, {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}}});
  EXPECT_EQ(s.normal(0.3, 0.6), Vec3(0, 0, 1));
  s.set_reversed(true);
  EXPECT_EQ(s.normal(0.3, 0.6), Vec3(0, 0, -1));
  EXPECT_EQ(s.degenerate_edges().u_min, false);
}

// A surface that is a curve has no normal: a unit vector all the same, never NaN.
TEST(ParametricNormal, NeverFails) {
  const NurbsSurface line = bezier_surface(Grid<Vec3>{2, 2, {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 0, 0}}});
  EXPECT_NEAR(glm::length(line.normal(0.3, 0.6)), 1, 1e-15);
  EXPECT_NEAR(line.normal(0.3, 0.6).x, 0, 1e-15);
  const NurbsSurface point = bezier_surface(Grid<Vec3>{2, 2, std::vector<Vec3>(4, Vec3(1, 2, 3))});
  EXPECT_NEAR(glm::length(point.normal(0, 0)), 1, 1e-15);
}

}  // namespace
}  // namespace lekalo::geometry::surface_normal_test
