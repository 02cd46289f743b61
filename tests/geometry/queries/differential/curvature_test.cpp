// Curvatures of surfaces at and beside singular places, against closed forms.
#include "geometry/queries/differential/curvature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "geometry/curves/analytic/polyline.h"
#include "geometry/curves/splines/bezier_curve.h"
#include "geometry/surfaces/splines/bezier_surface.h"
#include "geometry/surfaces/swept/revolution.h"
#include "support/surface_of_formula.h"

namespace lekalo::geometry::curvature_test {
namespace {

using tests::SurfaceOfFormula;

void expect_curvatures(const Surface& surface, double u, double v, double gaussian, double mean,
                       double tolerance = 1e-7) {
  const SurfaceCurvature c = curvature(surface, u, v);
  ASSERT_TRUE(c.regular) << u << " " << v;
  const double unit = std::max({std::abs(mean), std::sqrt(std::abs(gaussian))});
  EXPECT_NEAR(c.gaussian, gaussian, 2 * tolerance * unit * unit) << u << " " << v;
  EXPECT_NEAR(c.mean, mean, tolerance * unit) << u << " " << v;
  EXPECT_NEAR(c.principal[0] + c.principal[1], 2 * mean, 2 * tolerance * unit) << u << " " << v;
}

// Ways to a singular place, from 1 / 32 of the way and beyond to the place itself.
const double kDistances[] = {0,    1e-300, 1e-16, 1e-13, 1e-10, 3e-9, 1e-8, 3e-8, 1e-7,
                             1e-6, 1e-5,   3e-5,  1e-4,  3e-4,  1e-3, 0.01, 0.1,  0.5};

TEST(SurfaceCurvature, SphereUpToItsPoles) {
  const SurfaceOfFormula sphere(
      [](const auto& u, const auto& v) {
        using std::cos, std::sin;
        return Triple{cos(u) * cos(v) * 2.0, sin(u) * cos(v) * 2.0, sin(v) * 2.0};
      },
      {{0, kTwoPi}, {-kPi / 2, kPi / 2}});
  for (const double u : {0.0, 0.3, 4.0})
    for (const double d : kDistances)
      for (const double side : {-1.0, 1.0}) expect_curvatures(sphere, u, side * (kPi / 2 - d), 0.25, -0.5);
}

// h = x^2/a^4 + y^2/b^4 + z^2/c^4: K = 1 / (a b c h)^2, H = (r^2 - a^2 - b^2 - c^2) / (2 (a b c)^2 h^(3/2)).
TEST(SurfaceCurvature, EllipsoidUpToItsPoles) {
  const SurfaceOfFormula ellipsoid(
      [](const auto& u, const auto& v) {
        using std::cos, std::sin;
        return Triple{cos(u) * cos(v) * 3.0, sin(u) * cos(v) * 2.0, sin(v) * 1.0};
      },
      {{0, kTwoPi}, {-kPi / 2, kPi / 2}});
  for (const double u : {0.0, 0.3, 4.0})
    for (const double d : kDistances) {
      const Vec3 p = ellipsoid.point(u, kPi / 2 - d);
      const double h = p.x * p.x / 81 + p.y * p.y / 16 + p.z * p.z;
      expect_curvatures(ellipsoid, u, kPi / 2 - d, 1 / (36 * h * h), (glm::dot(p, p) - 14) / (72 * h * std::sqrt(h)));
    }
  const SurfaceCurvature pole = curvature(ellipsoid, 0.3, kPi / 2);
  EXPECT_NEAR(pole.principal[0], -1.0 / 9, 1e-8);
  EXPECT_NEAR(pole.principal[1], -1.0 / 4, 1e-8);
  EXPECT_NEAR(std::abs(pole.directions[0].x), 1, 1e-8);
  EXPECT_NEAR(std::abs(pole.directions[1].y), 1, 1e-8);
}

// z = rho^2, in polar coordinates: the pole is an exact zero. K = 4 / (1 + 4 rho^2)^2, the meridian's curvature is
// 2 / (1 + 4 rho^2)^(3/2), the other 2 / (1 + 4 rho^2)^(1/2); r_u x r_v looks up.
TEST(SurfaceCurvature, ParaboloidInPolarCoordinates) {
  const auto formula = [](const auto& u, const auto& v) {
    using std::cos, std::sin;
    return Triple{u * cos(v), u * sin(v), u * u};
  };
  const SurfaceOfFormula whole(formula, {{0, 1}, {0, kTwoPi}}), sector(formula, {{0, 1}, {0.2, 1.7}});
  for (const Surface* surface : {static_cast<const Surface*>(&whole), static_cast<const Surface*>(&sector)})
    for (const double d : kDistances) {
      const double w = 1 + 4 * d * d;
      expect_curvatures(*surface, d, 0.4, 4 / (w * w), (1 + 1 / w) / std::sqrt(w));
    }
}

// A plane has curvature zero at the origin of polar coordinates, not only about it.
TEST(SurfaceCurvature, PlaneInPolarCoordinates) {
  const SurfaceOfFormula plane(
      [](const auto& u, const auto& v) {
        using std::cos, std::sin;
        return Triple{u * cos(v), u * sin(v), 0.5 * u * cos(v)};
      },
      {{0, 1}, {0, kTwoPi}});
  for (const double d : kDistances) {
    const SurfaceCurvature c = curvature(plane, d, 0.4);
    ASSERT_TRUE(c.regular);
    EXPECT_NEAR(c.principal[0], 0, 1e-7);
    EXPECT_NEAR(c.principal[1], 0, 1e-7);
  }
}

// A NURBS curve that meets its axis at a right angle: a quarter of a circle, far from the origin too.
TEST(SurfaceCurvature, RevolvedSplineOnItsAxis) {
  const double w = std::sqrt(0.5);
  for (const Vec3& center : {Vec3(0), Vec3(30, -20, 10)}) {
    const std::vector<Vec3> points{center + Vec3(2, 0, 0), center + Vec3(2, 0, 2), center + Vec3(0, 0, 2)};
    const std::vector<double> weights{1, w, 1};
    const auto arc = std::make_shared<NurbsCurve>(bezier_curve(points, weights));
    const RevolutionSurface dome(arc, Axis{center, {0, 0, 1}});
    const double sign = glm::dot(dome.normal(0.5, 1), Vec3(0, 0, 1)) +
                                    glm::dot(dome.normal(0.5, 1), glm::normalize(dome.point(0.5, 1) - center)) >
                                0
                            ? -1
                            : 1;
    for (const double d : kDistances) expect_curvatures(dome, 1 - d, 1, 0.25, 0.5 * sign);
  }
}

// A Bezier triangle as a patch with one edge shrunk to a point: x = s + 0.5 t, y = t, z = t^2 + s t over the plane
// (s, t) = (u v, v): z = y^2 / 2 + x y, whose Hessian at the point is (0 1; 1 1).
TEST(SurfaceCurvature, BezierEdgeShrunkToAPoint) {
  Grid<Vec3> net{3, 3, {}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      // Blossoms of u v, v, v^2 and u v^2 at control point (i, j), i with u.
      const double u = i / 2.0, v = j / 2.0, vv = j == 2 ? 1 : 0;
      net.values.push_back({5 + u * v + 0.5 * v, -3 + v, vv + u * vv});
    }
  const NurbsSurface s = bezier_surface(net);
  const double sign = s.normal(0.5, 0.5).z > 0 ? 1 : -1;
  for (const double u : {0.0, 0.3, 1.0})
    for (const double d : kDistances) {
      // z = f(x, y): K = (f_xx f_yy - f_xy^2) / w^2, H = ((1 + f_y^2) f_xx - 2 f_x f_y f_xy + (1 + f_x^2) f_yy) / (2
      // w^1.5)
      const Vec3 p = s.point(u, d) - Vec3(5, -3, 0);
      const double fx = p.y, fy = p.y + p.x, w = 1 + fx * fx + fy * fy;
      expect_curvatures(s, u, d, -1 / (w * w), sign * (-2 * fx * fy + 1 + fx * fx) / (2 * w * std::sqrt(w)));
    }
}

// Where there is no limit nothing is told: at the tip of a cone, and on a pole from which the surface bends in each
// direction as it likes, z = v^2 (2 + cos 3u).
TEST(SurfaceCurvature, IsNotKnownWithoutALimit) {
  const SurfaceOfFormula cone(
      [](const auto& u, const auto& v) {
        using std::cos, std::sin;
        return Triple{cos(u) * v * 0.5, sin(u) * v * 0.5, -1.0 * v};
      },
      {{0, kTwoPi}, {0, 2}});
  EXPECT_FALSE(curvature(cone, 0.3, 0).regular);
  for (const double d : {1e-5, 1e-3, 0.1}) {
    const SurfaceCurvature c = curvature(cone, 0.3, d);
    ASSERT_TRUE(c.regular) << d;
    EXPECT_NEAR(c.gaussian, 0, 1e-6 * c.mean * c.mean) << d;
    // 1 / (rho / cos of the half angle), rho = v / 2.
    EXPECT_NEAR(std::abs(c.mean), 1 / (std::sqrt(1.25) * d), 1e-6 / d) << d;
  }
  const SurfaceOfFormula bent(
      [](const auto& u, const auto& v) {
        using std::cos, std::sin;
        return Triple{cos(u) * v, sin(u) * v, v * v * (cos(3.0 * u) + 2.0)};
      },
      {{0, kTwoPi}, {0, 1}});
  EXPECT_FALSE(curvature(bent, 0.3, 0).regular);
  EXPECT_TRUE(curvature(bent, 0.3, 0.01).regular);
}

// Collinear points at equal distances: second and third derivatives are rounding, also far from the origin.
TEST(CurveCurvature, StraightLinesHaveNoNoise) {
  for (const double far : {0.0, 1e6}) {
    std::vector<Vec3> points;
    for (int i = 0; i < 5; ++i)
      points.push_back(Vec3(0.1 + far, 0.7, 0.3) + Vec3(0.3, 0.1, 0.2) * static_cast<double>(i));
    const auto line = bezier_curve(points);
    for (const double t : {0.0, 0.1, 0.37, 1.0}) {
      const CurveCurvature c = curvature(line, t);
      EXPECT_TRUE(c.has_tangent && c.has_curvature && c.is_straight && !c.has_normal) << far << " " << t;
      EXPECT_EQ(c.curvature, 0);
      EXPECT_EQ(c.torsion, 0);
      EXPECT_LT(glm::length(c.tangent - Vec3(3, 1, 2) / std::sqrt(14.0)), 1e-9);
    }
  }
  // Sides of a polyline, up to the corners.
  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  for (const double t : {0.0, 0.4, 1.0, 1.7, 2.0}) {
    const CurveCurvature c = curvature(polyline(corners), t);
    EXPECT_TRUE(c.is_straight && c.torsion == 0 && !c.has_normal) << t;
    EXPECT_EQ(c.tangent, t < 1 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)) << t;
  }
  // A flat point of a bent curve is no straight line, whatever the order.
  std::vector<Vec3> flat;
  for (int i = 0; i < 6; ++i) flat.push_back({i / 5.0, i == 5 ? 1.0 : 0.0, 0});  // (t, t^5)
  const CurveCurvature point = curvature(bezier_curve(flat), 0.0);
  EXPECT_TRUE(point.has_curvature && !point.has_normal && !point.is_straight);
  EXPECT_EQ(point.curvature, 0);
  // Bent by little, but bent: y = 1e-6 x^2 has the curvature 2e-6.
  const std::vector<Vec3> bent{{0, 0, 0}, {0.5, 0, 0}, {1, 1e-6, 0}};
  const CurveCurvature c = curvature(bezier_curve(bent), 0.0);
  EXPECT_TRUE(c.has_normal && !c.is_straight);
  EXPECT_NEAR(c.curvature, 2e-6, 1e-18);
}

// Cubic with control points of a cusp at 1/2: r'' there is along -y, and the arriving tangent along +y.
TEST(CurveCurvature, TangentOfACuspIsTheLimit) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 0}};
  const auto cusp = bezier_curve(points);
  const CurveCurvature c = curvature(cusp, 0.5);
  EXPECT_TRUE(c.has_tangent && !c.has_curvature && !c.has_normal);
  EXPECT_LT(glm::length(c.tangent - Vec3(0, -1, 0)), 1e-12);
  const Vec3 beside = glm::normalize(cusp.evaluate(0.5 + 1e-7, 1).d[1]);
  EXPECT_LT(glm::length(c.tangent - beside), 1e-6);
  // Points that coincide at both ends: the limits lie inside, in the direction of the parameter.
  const std::vector<Vec3> resting{{0, 0, 0}, {0, 0, 0}, {1, 2, 0}, {1, 2, 0}};
  for (const double t : {0.0, 1.0})
    EXPECT_LT(glm::length(curvature(bezier_curve(resting), t).tangent - Vec3(1, 2, 0) / std::sqrt(5.0)), 1e-12) << t;
}

}  // namespace
}  // namespace lekalo::geometry::curvature_test
