// Curves evaluated from outside: known ones behind the interface.
#include "geometry/external/external_curve.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/curves/analytic/formula_curve.h"
#include "geometry/describe.h"
#include "geometry/external_stub.h"
#include "support/tier.h"
#include "support/worst.h"

namespace lekalo::geometry::external_curve_test {
namespace {

CurvePtr formulas(const std::array<std::string, 3>& point, const Interval& domain) {
  return std::make_shared<FormulaCurve>(point_formulas(point, {"t"}), domain);
}

ExternalCurve external(const CurvePtr& curve, bool closed = false, int order = 2, double tolerance = 1e-9) {
  return ExternalCurve(std::make_shared<CurveStub>(curve), curve->domain(), closed, order, tolerance);
}

std::string refused_field(const CurvePtr& curve, bool closed) {
  try {
    external(curve, closed);
  } catch (const FieldError& error) {
    return error.field;
  }
  return {};
}

TEST(ExternalCurve, SplineIsAsNearAsItSays) {
  std::mt19937_64 random(5);
  double worst = 0;
  for (const CurvePtr& truth :
       {formulas({"cos(t)", "sin(t)", "0.3*t"}, {0, 20}), formulas({"t", "exp(-20*t^2)", "0"}, {-2, 2}),
        formulas({"sin(3*t)", "cos(7*t)", "sin(2*t)"}, {0, kTwoPi})})
    for (const double tolerance : {1e-5, 1e-9, 1e-12}) {
      const ExternalCurve one = external(truth, false, 2, tolerance);
      EXPECT_TRUE(one.report().doubts.empty());
      const NurbsCurve spline(*one.as_nurbs());
      std::uniform_real_distribution<double> t(truth->domain().lo, truth->domain().hi);
      for (int i = 0; i < lekalo::tests::tier_count(100000); ++i) {
        const double x = t(random);
        worst = tests::worse(worst, glm::length(spline.point(x) - truth->point(x)) / (tolerance * one.report().size));
      }
    }
  lekalo::tests::report_figure("largest_distance_over_tolerance", worst);
  EXPECT_LE(worst, 1.2);
}

TEST(ExternalCurve, AsksTheFunctionForWhatItKnows) {
  const CurvePtr truth = formulas({"sin(3*t)", "cos(7*t)", "sin(2*t)"}, {0, kTwoPi});
  for (const int order : {0, 1, 3, 6}) {
    const ExternalCurve one = external(truth, true, order);
    const CurveJet jet = one.evaluate(1.1, 6), expected = truth->evaluate(1.1, 6);
    for (int k = 0; k <= order; ++k) EXPECT_EQ(jet.d[k], expected.d[k]);
    EXPECT_LE(glm::length(jet.d[1] - expected.d[1]), 1e-6);
    EXPECT_LE(glm::length(one.point(1.1 - kTwoPi) - expected.d[0]), 1e-14);
    EXPECT_TRUE(one.is_closed());
    const CurveEnclosure boxes = one.enclose({1, 1.2}, 1);
    for (int k = 0; k <= 1; ++k) EXPECT_TRUE(boxes.d[k].contains(expected.d[k]));
  }
}

TEST(ExternalCurve, RefusesWhatIsNoCurve) {
  EXPECT_EQ(refused_field(formulas({"cos(t)", "sin(t)", "0"}, {0, 6}), true), "closed");
  EXPECT_EQ(refused_field(formulas({"1", "2", "3"}, {0, 6}), false), "domain");
  EXPECT_EQ(refused_field(formulas({"t", "abs(t - 0.3)", "0"}, {0, 1}), false), "tolerance");
}

}  // namespace
}  // namespace lekalo::geometry::external_curve_test
