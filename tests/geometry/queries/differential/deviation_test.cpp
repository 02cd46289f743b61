#include "geometry/queries/differential/deviation.h"

#include <gtest/gtest.h>

#include "geometry/curves/analytic/formula_curve.h"
#include "geometry/surfaces/analytic/formula_surface.h"
#include "geometry/surfaces/analytic/plane.h"

namespace lekalo::geometry::deviation_test {
namespace {

FormulaSurface surface(const std::array<std::string, 3>& point, const Rectangle& domain) {
  return FormulaSurface(point_formulas(point, {"u", "v"}), domain, {});
}

std::vector<std::string> names(const std::vector<Deviation>& all) {
  std::vector<std::string> result;
  for (const Deviation& one : all) result.push_back(one.quantity);
  return result;
}

TEST(Deviation, OfSurfacesIsInTheFirstOnesParameters) {
  const FormulaSurface a = surface({"u", "v", "u*v"}, {{0, 1}, {0, 2}});
  // The same in parameters from 2 to 4 and from -1 to 0, and 0.1 u^2 above it.
  const FormulaSurface b =
      surface({"(u - 2)/2", "2*(v + 1)", "(u - 2)*(v + 1) + 0.1*((u - 2)/2)^2"}, {{2, 4}, {-1, 0}});
  const Vec2 uv[] = {{0, 0}, {0.5, 1}, {1, 2}, {0.25, 1.5}};
  const std::vector<Deviation> found = deviations(a, b, uv, 2);
  EXPECT_EQ(names(found), (std::vector<std::string>{"point", "du", "dv", "duu", "duv", "dvv", "normal"}));
  const double expected[] = {0.1, 0.2, 0, 0.2, 0, 0};
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(found[k].largest, expected[k], 1e-15) << found[k].quantity;
  EXPECT_EQ(found[0].at, (std::array<double, 2>{1, 2}));
  EXPECT_EQ(found[0].first, Vec3(1, 2, 2));
  EXPECT_EQ(found[0].second, Vec3(1, 2, 2.1));
  EXPECT_NEAR(found[0].scale, 3, 1e-15);
  double normals = 0;
  for (const Vec2& p : uv)
    normals = std::max(
        normals, glm::length(glm::normalize(Vec3(-p.y, -p.x, 1)) - glm::normalize(Vec3(-p.y - 0.2 * p.x, -p.x, 1))));
  EXPECT_NEAR(found[6].largest, normals, 1e-12);
  EXPECT_EQ(names(deviations(a, b, uv, 0)), (std::vector<std::string>{"point"}));
}

TEST(Deviation, OfCurves) {
  const FormulaCurve a(point_formulas({"t", "t^2", "0"}, {"t"}), {0, 1});
  const FormulaCurve b(point_formulas({"t/2", "t^2/4", "0.01*t"}, {"t"}), {0, 2});
  const double t[] = {0, 0.3, 1};
  const std::vector<Deviation> found = deviations(a, b, t, 2);
  EXPECT_EQ(names(found), (std::vector<std::string>{"point", "d1", "d2", "tangent"}));
  EXPECT_NEAR(found[0].largest, 0.02, 1e-16);
  EXPECT_EQ(found[0].at[0], 1);
  EXPECT_NEAR(found[1].largest, 0.02, 1e-16);
  EXPECT_NEAR(found[2].largest, 0, 1e-16);
  EXPECT_NEAR(found[3].largest, 0.02, 1e-5);
  EXPECT_EQ(found[3].at[0], 0);
}

TEST(Deviation, NeedsFiniteDomains) {
  const FormulaSurface a = surface({"u", "v", "u*v"}, {{0, 1}, {0, 2}});
  const Plane plane{Frame()};
  const Vec2 uv[] = {{0, 0}};
  EXPECT_THROW(deviations(a, plane, uv, 2), std::invalid_argument);
}

TEST(Deviation, WhatIsNotFiniteIsInfinite) {
  SurfaceJet a(0), b(0);
  b.values[0].y = std::nan("");
  const Vec2 uv[] = {{3, 4}};
  const Deviation found = deviations({&a, 1}, {&b, 1}, uv, 0).front();
  EXPECT_EQ(found.largest, kInfinity);
  EXPECT_EQ(found.at, (std::array<double, 2>{3, 4}));
}

}  // namespace
}  // namespace lekalo::geometry::deviation_test
