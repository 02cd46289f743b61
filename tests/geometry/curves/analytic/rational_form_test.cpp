// Rational formulas as NURBS curves: the same points as the formulas have.
#include "geometry/curves/analytic/rational_form.h"

#include "geometry/curves/analytic/formula_curve.h"
#include "geometry/curves/curve_checks.h"
#include "geometry/curves/operations/nurbs_of.h"
#include "geometry/curves/splines/nurbs_curve.h"

namespace lekalo::geometry::rational_form_test {
namespace {

PointFormulas formulas(const std::string& x, const std::string& y, const std::string& z = "0") {
  return point_formulas({x, y, z}, {"t"});
}
RationalLaw law(const std::string& weight, int degree, double speed) {
  return {formula_of(weight, {"t"}), degree, speed};
}

// The largest distance of the form's points from those of the formulas at the parameters that the maps tell.
double farthest(const RationalForm& found, const PointFormulas& point) {
  double largest = 0;
  for (const CurvePiece& piece : bezier_pieces(found.form, found.form.domain()))
    for (int k = 0; k <= 20; ++k) {
      std::vector<Vec4> p = piece.points;
      const double x = k / 20.;
      for (size_t n = p.size() - 1; n > 0; --n)
        for (size_t i = 0; i < n; ++i) p[i] = (1 - x) * p[i] + x * p[i + 1];
      const Triple<double> there = point(piece.map.natural_of_bezier(x) / found.speed);
      largest = std::max(largest, glm::length(Vec3(p[0]) / p[0].w - Vec3(there.x, there.y, there.z)));
    }
  return largest;
}

TEST(RationalForm, OfACircleIsTheKnownOne) {
  const PointFormulas circle = formulas("2*cos(t)", "2*sin(t)");
  const auto form = rational_form(circle, law("1", 1, 1), {0, kPi / 2});
  ASSERT_TRUE(form);
  ASSERT_EQ(form->form.points.size(), 3);
  // A quarter with the weights 1, cos 45, 1, up to a common factor.
  const std::vector<Vec4>& p = form->form.points;
  EXPECT_NEAR(p[1].w / p[0].w, std::sqrt(0.5), 1e-15);
  EXPECT_LE(glm::length(Vec3(p[1]) / p[1].w - Vec3(2, 2, 0)), 1e-14);
  EXPECT_LE(farthest(*form, circle), 1e-15 * 4);
}

TEST(RationalForm, OfFormulasOfBothKinds) {
  const PointFormulas space = formulas("cos(t) + cos(2*t)", "sin(t)", "sin(3*t)/(2 + cos(t))");
  const auto angles = rational_form(space, law("2 + cos(t)", 3, 1), {-1, 5});
  ASSERT_TRUE(angles);
  EXPECT_EQ(angles->form.degree, 6);
  EXPECT_LE(farthest(*angles, space), 2e-14);
  const PointFormulas slow = formulas("cos(t/3)", "sin(2*t/3)");
  const auto turns = rational_form(slow, law("1", 2, 1. / 3), {0, 6 * kPi});
  ASSERT_TRUE(turns);
  EXPECT_EQ(turns->form.domain(), Interval(0, 6 * kPi / 3));
  EXPECT_LE(farthest(*turns, slow), 1e-14);
  const PointFormulas rational = formulas("t/(1 + t^2)", "t^3/(1 + t^2)");
  const auto wide = rational_form(rational, law("1 + t^2", 3, 0), {-40, 100});
  ASSERT_TRUE(wide);
  EXPECT_LE(farthest(*wide, rational), 1e-15 * 200);
  const auto cubic = rational_form(formulas("t", "t^3"), law("1", 3, 0), {-40, 100});
  ASSERT_TRUE(cubic);
  EXPECT_EQ(cubic->form.points.size(), 4);
  for (const Vec4& p : cubic->form.points) EXPECT_EQ(p.w, cubic->form.points[0].w);
}

TEST(RationalForm, IsNoneWhereTheWeightVanishesOrTheDegreeIsTooHigh) {
  EXPECT_FALSE(rational_form(formulas("t", "1/t"), law("t", 2, 0), {-1, 2}));
  EXPECT_TRUE(rational_form(formulas("t", "1/t"), law("t", 2, 0), {-2, -1}));
  EXPECT_FALSE(rational_form(formulas("cos(13*t)", "sin(t)"), law("1", 13, 1), {0, 1}));
  EXPECT_FALSE(rational_form(formulas("cos(t)", "sin(t)"), law("1", 1, 1), {0, 1e6}));
}

// A part of a curve whose form has another parameter begins and ends where the curve does.
TEST(RationalForm, OfPartsOfACurve) {
  const FormulaCurve curve(formulas("cos(t/3) + t*0", "sin(2*t/3)"), {0, 6 * kPi}, true, law("1", 2, 1. / 3));
  EXPECT_FALSE(curve.as_nurbs());
  const NurbsOfCurve found = nurbs_of(curve, {1, 7.5}, 0);
  EXPECT_TRUE(found.exact);
  const NurbsCurve part(found.form);
  EXPECT_EQ(part.domain(), Interval(1, 7.5));
  EXPECT_LE(glm::length(part.point(1) - curve.point(1)), 1e-14);
  EXPECT_LE(glm::length(part.point(7.5) - curve.point(7.5)), 1e-14);
  for (double t = 1; t < 7.5; t += 0.1) {
    const Vec3 p = part.point(t);  // y^2 = 4 x^2 (1 - x^2)
    EXPECT_NEAR(p.y * p.y, 4 * p.x * p.x * (1 - p.x * p.x), 1e-13);
  }
}

}  // namespace
}  // namespace lekalo::geometry::rational_form_test
