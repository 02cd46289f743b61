#include "geometry/curves/analytic/hyperbola.h"
#include "geometry/curves/analytic/parabola.h"
#include "geometry/curves/curve_checks.h"
#include "geometry/queries/measures/mass_properties.h"

namespace lekalo::geometry::conic_arcs_test {
namespace {

const Frame kSkew = frame_from({0.3, -1.2, 2.5}, {1, 2, 2}, {1, 0.2, -0.4});

Triple<Quad> wide(const Vec3& v) { return {v.x, v.y, v.z}; }

// a cosh t x + b sinh t y in the frame, over any number type.
auto hyperbola(const Frame& frame, double a, double b) {
  return [=](auto t) {
    return (Quad(a) * cosh(t)) * wide(frame.x) + (Quad(b) * sinh(t)) * wide(frame.y) + wide(frame.origin);
  };
}
auto parabola(const Frame& frame, double f) {
  return [=](auto t) {
    return (Quad(f) * t * t) * wide(frame.x) + (Quad(2) * Quad(f) * t) * wide(frame.y) + wide(frame.origin);
  };
}

TEST(Hyperbola, DerivativesEqualThoseOfTheFormulaIn113Bits) {
  checks::check_derivatives(Hyperbola(kSkew, 3, 2, {-3, 3}), hyperbola(kSkew, 3, 2), {-4, 4});
}
TEST(Hyperbola, MeetsTheGeneralChecks) {
  for (const Interval range : {Interval(-2, 2), Interval(0.4, 2.1), Interval(-5, 3)}) {
    const Hyperbola curve(kSkew, 3, 2, range);
    checks::check_differences(curve, range);
    checks::check_enclosures(curve, range);
    checks::check_nurbs(curve);
    checks::check_pieces(curve);
  }
}
// (x/a)^2 - (y/b)^2 = 1; k = a b / (a^2 sinh^2 + b^2 cosh^2)^(3/2) (Golovanov 2016, 2.2).
TEST(Hyperbola, HasTheEquationAndCurvatureOfTheTextbook) {
  const double a = 3, b = 2, t = 0.7;
  const Vec3 p = kSkew.to_local_point(Hyperbola(kSkew, a, b, {-1, 1}).point(t));
  EXPECT_NEAR(p.x * p.x / (a * a) - p.y * p.y / (b * b), 1, 1e-14);
  const CurveJet jet = Hyperbola(kSkew, a, b, {-1, 1}).evaluate(t, 2);
  const double curvature = glm::length(glm::cross(jet.d[1], jet.d[2])) / std::pow(glm::length(jet.d[1]), 3);
  EXPECT_NEAR(curvature, a * b / std::pow(a * a * sqr(std::sinh(t)) + b * b * sqr(std::cosh(t)), 1.5), 1e-15);
}
TEST(Hyperbola, RefusesImpossibleValues) {
  EXPECT_THROW(Hyperbola(Frame(), 0, 1, {0, 1}), std::invalid_argument);
  EXPECT_THROW(Hyperbola(Frame(), 1, 1, {1, 1}), std::invalid_argument);
  EXPECT_THROW(Hyperbola(Frame(), 1, 1, {0, 400}), std::invalid_argument);
}

TEST(Parabola, DerivativesEqualThoseOfTheFormulaIn113Bits) {
  checks::check_derivatives(Parabola(kSkew, 0.7, {-3, 3}), parabola(kSkew, 0.7), {-4, 4});
}
TEST(Parabola, MeetsTheGeneralChecks) {
  for (const Interval range : {Interval(-2, 2), Interval(0.4, 2.1), Interval(-50, 3)}) {
    const Parabola curve(kSkew, 0.7, range);
    checks::check_differences(curve, range);
    checks::check_enclosures(curve, range);
    checks::check_nurbs(curve);
    checks::check_pieces(curve);
  }
}
// Every point is as far from the focus as from the directrix; the length is f (t sqrt(1 + t^2) + asinh t).
TEST(Parabola, HasFocusDirectrixAndLengthOfTheTextbook) {
  const double f = 1;
  const Parabola curve(kSkew, f, {0, 1});
  for (const double t : {0.1, 0.6, 1.0}) {
    const Vec3 p = kSkew.to_local_point(curve.point(t));
    EXPECT_NEAR(std::hypot(p.x - f, p.y), p.x + f, 1e-14);
  }
  EXPECT_NEAR(measure(curve).length.value, std::sqrt(2.0) + std::asinh(1.0), 1e-14);
}
TEST(Parabola, RefusesImpossibleValues) {
  EXPECT_THROW(Parabola(Frame(), 0, {0, 1}), std::invalid_argument);
  EXPECT_THROW(Parabola(Frame(), 1, {1, 1}), std::invalid_argument);
  EXPECT_THROW(Parabola(Frame(), 1, {0, kInfinity}), std::invalid_argument);
}

}  // namespace
}  // namespace lekalo::geometry::conic_arcs_test
