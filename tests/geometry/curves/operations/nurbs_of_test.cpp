// Curves as NURBS curves: exact forms are the same points, fits as near as was asked and as smooth as the curve.
#include "geometry/curves/operations/nurbs_of.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/curves/analytic/ellipse.h"
#include "geometry/curves/analytic/formula_curve.h"
#include "geometry/curves/splines/nurbs_curve.h"

namespace lekalo::geometry::nurbs_of_test {
namespace {

CurvePtr formula(const std::array<std::string, 3>& point, const Interval& domain) {
  return std::make_shared<FormulaCurve>(point_formulas(point, {"t"}, Coordinates::cartesian), domain);
}

TEST(NurbsOf, FitsAreNear) {
  const std::vector<CurvePtr> curves = {formula({"2*cos(t)", "2*sin(t)", "t/3"}, {0, 20}),
                                        formula({"t", "abs(t)", "exp(t)"}, {-1, 1}),
                                        formula({"t", "sin(5*t)", "0"}, {0, 3})};
  for (const CurvePtr& curve : curves)
    for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
      const NurbsOfCurve found = nurbs_of(*curve, curve->domain(), tolerance);
      EXPECT_FALSE(found.exact);
      EXPECT_LE(found.deviation, tolerance);
      const NurbsCurve fit(found.form);
      EXPECT_EQ(fit.domain(), curve->domain());
      for (int k = 0; k <= 1000; ++k) {
        const double t = fit.domain().lo + fit.domain().width() * k / 1000;
        EXPECT_LE(glm::length(fit.point(t) - curve->point(t)), 1.1 * tolerance + 1e-13);
      }
    }
}

// Class C2 inside of smooth pieces: derivatives from both sides of the knots.
TEST(NurbsOf, FitsAreSmooth) {
  const CurvePtr curve = formula({"t", "sin(5*t)", "cos(t)"}, {0, 3});
  const NurbsCurve fit(nurbs_of(*curve, curve->domain(), 1e-6).form);
  for (const double knot : fit.axis().knots()) {
    if (!(knot > 0 && knot < 3)) continue;
    const CurveJet before = fit.evaluate(std::nextafter(knot, 0), 2), after = fit.evaluate(knot, 2);
    for (int k = 0; k <= 2; ++k) EXPECT_LT(glm::length(before.d[k] - after.d[k]), 1e-9);
  }
}

TEST(NurbsOf, PartsOfConicsHaveTheirEnds) {
  const Ellipse oval(Frame(), 3, 2, {0, kTwoPi});
  const NurbsOfCurve found = nurbs_of(oval, {0.4, 2.1}, 0);
  EXPECT_TRUE(found.exact);
  const NurbsCurve part(found.form);
  EXPECT_EQ(part.domain(), Interval(0.4, 2.1));
  EXPECT_LT(glm::length(part.point(0.4) - oval.point(0.4)), 1e-14);
  EXPECT_LT(glm::length(part.point(2.1) - oval.point(2.1)), 1e-14);
  for (double t = 0.4; t < 2.1; t += 0.1) {
    const Vec3 p = part.point(t);
    EXPECT_NEAR(p.x * p.x / 9 + p.y * p.y / 4, 1, 1e-14);
  }
}

TEST(NurbsOf, Errors) {
  const CurvePtr root = formula({"t", "sqrt(t)", "0"}, {0, 1});
  EXPECT_THROW(nurbs_of(*root, root->domain(), 1e-6), std::invalid_argument);
  EXPECT_THROW(nurbs_of(*root, {0, kInfinity}, 1e-6), std::invalid_argument);
}

}  // namespace
}  // namespace lekalo::geometry::nurbs_of_test
