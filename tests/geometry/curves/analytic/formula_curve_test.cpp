#include "geometry/curves/analytic/formula_curve.h"

#include "geometry/curves/curve_checks.h"

namespace lekalo::geometry::formula_curve_test {
namespace {

using checks::distance;

FormulaCurve curve(const std::array<std::string, 3>& point, const Interval& domain, bool closed = false,
                   Coordinates coordinates = Coordinates::cartesian) {
  return FormulaCurve(point_formulas(point, {"t"}, coordinates), domain, closed);
}

TEST(FormulaCurve, DerivativesEqualThoseOfTheFormulaIn113Bits) {
  const auto star = [](auto t) {
    const auto radius = Quad(0.55) * (Quad(1) + Quad(0.25) * cos(Quad(5) * t));
    return Triple<decltype(radius)>{radius * cos(t), radius * sin(t), t * t * t};
  };
  checks::check_derivatives(
      curve({"0.55*(1 + 0.25*cos(5*t))*cos(t)", "0.55*(1 + 0.25*cos(5*t))*sin(t)", "t^3"}, {-3, 3}), star, {-3, 3});
}

TEST(FormulaCurve, MeetsTheGeneralChecks) {
  const FormulaCurve knot =
      curve({"(2 + cos(3*t))*cos(2*t)", "(2 + cos(3*t))*sin(2*t)", "sin(3*t)"}, {0, kTwoPi}, true);
  const FormulaCurve bell = curve({"t", "exp(-t^2)*sqrt(2 + t)", "log(3 + t)/(1 + t^2)"}, {-1.5, 2});
  for (const FormulaCurve* one : {&knot, &bell}) {
    checks::check_differences(*one, one->domain());
    checks::check_enclosures(*one, one->domain());
    checks::check_pieces(*one);
    checks::check_period(*one);
  }
  EXPECT_TRUE(knot.is_closed());
  EXPECT_FALSE(bell.is_closed());
}

TEST(FormulaCurve, CoordinatesOfOtherKindsAreTheirCartesianOnes) {
  const FormulaCurve spiral = curve({"exp(0.1*t)", "t", "0.2*t"}, {0, 20}, false, Coordinates::cylindrical);
  const FormulaCurve loxodrome = curve({"2", "3*t", "atan(t)"}, {-4, 4}, false, Coordinates::spherical);
  for (double t = 0; t < 4; t += 0.3) {
    EXPECT_LE(distance(spiral.point(t), {std::exp(0.1 * t) * std::cos(t), std::exp(0.1 * t) * std::sin(t), 0.2 * t}),
              1e-14);
    const double latitude = std::atan(t);
    EXPECT_LE(distance(loxodrome.point(t), 2.0 * Vec3(std::cos(latitude) * std::cos(3 * t),
                                                      std::cos(latitude) * std::sin(3 * t), std::sin(latitude))),
              1e-14);
  }
}

TEST(FormulaCurve, RefusesWhatIsNoCurve) {
  EXPECT_THROW(curve({"t", "1/t", "0"}, {0, 1}), std::invalid_argument);
  EXPECT_THROW(curve({"t", "0", "0"}, {1, 1}), std::invalid_argument);
  EXPECT_THROW(curve({"t", "0", "0"}, {0, kInfinity}), std::invalid_argument);
  EXPECT_THROW(curve({"cos(t)", "sin(t)", "0"}, {0, 6}, true), std::invalid_argument);
}

// Bounds of the quotient over the whole domain are infinite, as 0.8 cos^2 + sin^2 >= 0 is all that they see.
TEST(FormulaCurve, QuotientsWhoseBoundsOverAllAreInfinite) {
  const FormulaCurve curve(point_formulas({"cos(t)/sqrt(0.8*cos(t)^2 + sin(t)^2)", "sin(t)", "0"}, {"t"}), {0, kTwoPi},
                           true);
  const Box3 box = bounds(curve);
  EXPECT_TRUE(box.bounded());
  EXPECT_GE(box.hi.x, 1 / std::sqrt(0.8));
  EXPECT_LT(box.hi.x, 2);
  const CurveEnclosure whole = curve.enclose({0, kTwoPi}, 2);
  for (int k = 0; k <= 100; ++k) {
    const CurveJet at = curve.evaluate(kTwoPi * k / 100, 2);
    for (int order = 0; order <= 2; ++order) EXPECT_TRUE(whole.d[order].contains(at.d[order])) << k << " " << order;
  }
}

}  // namespace
}  // namespace lekalo::geometry::formula_curve_test
