#include "geometry/curves/analytic/ellipse.h"

#include "geometry/curves/curve_checks.h"

namespace lekalo::geometry::ellipse_test {
namespace {

using checks::distance;

const Frame kSkew = frame_from({0.3, -1.2, 2.5}, {1, 2, 2}, {1, 0.2, -0.4});

// a cos t x + b sin t y in the frame, over any number type.
auto formula(const Frame& frame, double a, double b) {
  return [=](auto t) {
    const auto triple = [](const Vec3& v) { return Triple<Quad>{v.x, v.y, v.z}; };
    return (Quad(a) * cos(t)) * triple(frame.x) + (Quad(b) * sin(t)) * triple(frame.y) + triple(frame.origin);
  };
}

TEST(Ellipse, DerivativesEqualThoseOfTheFormulaIn113Bits) {
  checks::check_derivatives(Ellipse(kSkew, 3, 2), formula(kSkew, 3, 2), {-7, 7});
  checks::check_derivatives(Ellipse(kSkew, 0.01, 5, {1, 2}), formula(kSkew, 0.01, 5), {1, 2});
}

TEST(Ellipse, MeetsTheGeneralChecks) {
  for (const Interval arc : {Interval(0, kTwoPi), Interval(0.4, 2.1), Interval(-3, 3), Interval(5, 5.01)}) {
    const Ellipse ellipse(kSkew, 3, 2, arc);
    checks::check_differences(ellipse, arc);
    checks::check_enclosures(ellipse, arc);
    checks::check_nurbs(ellipse);
    checks::check_pieces(ellipse);
    checks::check_period(ellipse);
  }
}

// Golovanov 2016, 2.14f: quarter spans, weights cos 45 degrees, points of the circumscribed rectangle.
TEST(Ellipse, FullTurnHasTheEightPointsOfTheRectangle) {
  const auto form = Ellipse(Frame(), 3, 2).as_nurbs();
  ASSERT_EQ(form->points.size(), 9u);
  EXPECT_EQ(form->points.front(), form->points.back());
  EXPECT_LE(distance(Vec3(form->points[1]) / form->points[1].w, {3, 2, 0}), 1e-15 * 4);
  EXPECT_DOUBLE_EQ(form->points[1].w, std::sqrt(0.5));
  EXPECT_EQ(Vec3(form->points[2]), Vec3(0, 2, 0));
}

// Curvature a b / (a^2 sin^2 + b^2 cos^2)^(3/2); the number is Golovanov 2016, 2.1 (a = 3, b = 2, t = pi/3).
TEST(Ellipse, HasTheCurvatureOfTheTextbook) {
  const CurveJet jet = Ellipse(kSkew, 3, 2).evaluate(kPi / 3, 2);
  const double curvature = glm::length(glm::cross(jet.d[1], jet.d[2])) / std::pow(glm::length(jet.d[1]), 3);
  EXPECT_NEAR(curvature, 0.278098532170490, 1e-14);
}

TEST(Ellipse, ContinuesBeyondItsArc) {
  const Ellipse whole(kSkew, 3, 2), arc(kSkew, 3, 2, {0.5, 1});
  EXPECT_EQ(arc.point(3), whole.point(3));
  EXPECT_FALSE(arc.is_closed());
  EXPECT_TRUE(whole.is_closed());
}

TEST(Ellipse, RefusesImpossibleValues) {
  EXPECT_THROW(Ellipse(Frame(), 0, 1), std::invalid_argument);
  EXPECT_THROW(Ellipse(Frame(), 1, 1, {0, 6.3}), std::invalid_argument);
  EXPECT_THROW(Ellipse(Frame(), 1, 1, {1, 1}), std::invalid_argument);
}

}  // namespace
}  // namespace lekalo::geometry::ellipse_test
