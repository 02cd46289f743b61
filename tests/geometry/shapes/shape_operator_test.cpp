// How normals of shapes turn, against differences of the normals themselves and closed forms.
#include <gtest/gtest.h>

#include <random>

#include "geometry/curves/analytic/circle.h"
#include "geometry/queries/differential/curvature.h"
#include "geometry/shape.h"
#include "geometry/shapes/implicit/implicit_surface.h"
#include "geometry/shapes/tube/balls.h"
#include "geometry/shapes/tube/tube.h"
#include "geometry/surfaces/analytic/ellipsoid.h"

namespace lekalo::geometry::shape_operator_test {
namespace {

Expression formula_of_place(const std::string& text) {
  Expression formula = std::get<Expression>(Expression::parse(text));
  const std::vector<Expression::Variable> variables{{"x"}, {"y"}, {"z"}};
  EXPECT_FALSE(formula.bind(variables));
  return formula;
}

ImplicitSurface implicit(const std::string& text, double level) {
  ImplicitRegion region;
  region.box = {Vec3(-4), Vec3(4)};
  return ImplicitSurface(formula_of_place(text), level, region, true);
}

// The first hit of lines through the shape from all around.
template <class Visit>
void each_hit(const Shape& shape, const Visit& visit) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  int found = 0;
  for (int k = 0; k < 60; ++k) {
    const Vec3 from = 20.0 * glm::normalize(Vec3(normal(random), normal(random), normal(random)));
    const Vec3 aim = 0.7 * Vec3(normal(random), normal(random), normal(random));
    const Line line{from, glm::normalize(aim - from)};
    SurfaceHit hit;
    if (!shape.first_hit(line, {0, kInfinity}, hit)) continue;
    ++found;
    visit(hit, line.at(hit.t));
  }
  EXPECT_GT(found, 20);
}

TEST(ShapeOperator, ImplicitEllipsoidAsTheParametricOne) {
  const ImplicitSurface shape = implicit("x^2/9 + y^2/4 + z^2", 1);
  const Ellipsoid egg(Frame(), Vec3(3, 2, 1));
  each_hit(shape, [&](const SurfaceHit& hit, const Vec3& near) {
    const Vec3 p = shape.point(hit, near).position;
    const auto S = shape.shape_operator(hit, near);
    ASSERT_TRUE(S);
    const SurfaceCurvature c = curvature(*S, shape.point(hit, near).normal);
    const double v = std::asin(std::clamp(p.z, -1.0, 1.0)), u = std::atan2(p.y / 2, p.x / 3);
    const SurfaceCurvature truth = curvature(egg, u, v);
    EXPECT_NEAR(c.principal[0], truth.principal[0], 1e-6);
    EXPECT_NEAR(c.principal[1], truth.principal[1], 1e-6);
  });
}

TEST(ShapeOperator, AffineImageOfABall) {
  Affine map;
  map.linear = Mat3(3, 0, 0, 0, 2, 0, 0, 0, 1);
  const Vec3 centers[] = {Vec3(0)};
  const double radii[] = {1.0};
  const TransformedShape shape(std::make_shared<Balls>(centers, radii), map);
  const ImplicitSurface egg = implicit("x^2/9 + y^2/4 + z^2", 1);
  each_hit(shape, [&](const SurfaceHit& hit, const Vec3& near) {
    const auto S = shape.shape_operator(hit, near), truth = egg.shape_operator(SurfaceHit(), near);
    ASSERT_TRUE(S && truth);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(glm::length((*S)[k] - (*truth)[k]), 0, 1e-6);
  });
}

// About a circle: a torus, (sqrt(x^2 + y^2) - 3)^2 + z^2 = 1.
TEST(ShapeOperator, TubeAsTorus) {
  const Tube tube(std::make_shared<Circle>(Frame(), 3.0), RadiusLaw(0.7), Caps::round);
  each_hit(tube, [&](const SurfaceHit& hit, const Vec3& near) {
    const ShapePoint at = tube.point(hit, near);
    const auto S = tube.shape_operator(hit, near);
    ASSERT_TRUE(S);
    const SurfaceCurvature c = curvature(*S, at.normal);
    const double rho = std::hypot(at.position.x, at.position.y), cosine = (rho - 3) / 0.7;
    EXPECT_NEAR(c.principal[1], -1 / 0.7, 1e-6);
    EXPECT_NEAR(c.principal[0], -cosine / rho, 1e-6);
  });
}

}  // namespace
}  // namespace lekalo::geometry::shape_operator_test
