#include "geometry/curves/splines/nurbs_curve.h"

#include "geometry/curves/curve_checks.h"
#include "geometry/curves/spline_oracle.h"
#include "support/worst.h"

namespace lekalo::geometry::nurbs_curve_test {
namespace {

using checks::distance;
using Points = std::vector<Vec3>;
using List = std::vector<double>;

NurbsCurve open_curve(int degree, const List& knots, const Points& points, const List& weights = {}) {
  return NurbsCurve(SplineAxis(degree, knots, Extension::tangent), points, weights);
}

NurbsCurve closed_curve(int degree, const Points& points, const List& weights = {}) {
  const int n = static_cast<int>(points.size());
  return NurbsCurve(SplineAxis(degree, knots_by_rule("uniform", degree, n, true, {}), Extension::periodic), points,
                    weights);
}

void expect_near(const Vec3& a, const Vec3& b, double tolerance) { EXPECT_LE(distance(a, b), tolerance); }

const Points kNine = {{0, 0, 0}, {1, 2, 0},  {2, -1, 0}, {3, 3, 0}, {4, 0, 0},
                      {5, 2, 0}, {6, -2, 0}, {7, 1, 0},  {8, 0, 0}};
const Points kSeven = {{0, 0, 0}, {1, 2, 0}, {3, 2, 0}, {4, 0, 0}, {6, 0, 0}, {7, 2, 0}, {9, 1, 0}};

// Golovanov 2016, 2.10.
TEST(NurbsCurve, ClampedCubicHasTheBooksDerivatives) {
  const NurbsCurve curve = open_curve(3, {0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 6, 6, 6}, kNine);
  const CurveJet jet = curve.evaluate(2.5, 4);
  expect_near(jet.d[0], {3.5, 35. / 24, 0}, 1e-15);
  expect_near(jet.d[1], {1, -1.5, 0}, 3e-15);
  expect_near(jet.d[2], {0, -1, 0}, 5e-15);
  expect_near(jet.d[3], {0, 12, 0}, 2e-14);
  expect_near(jet.d[4], {0, 0, 0}, 0);
  expect_near(curve.evaluate(0, 1).d[1], {3, 6, 0}, 0);
  EXPECT_EQ(curve.point(0), kNine.front());
  EXPECT_EQ(curve.point(6), kNine.back());
}

// Golovanov 2016, 2.9: solid and dashed curve of figure 2.9.1.
TEST(NurbsCurve, UnclampedCubicsHaveTheBooksPoints) {
  List integers;
  for (int i = 0; i <= 10; ++i) integers.push_back(i);
  const NurbsCurve solid = open_curve(3, integers, kSeven);
  EXPECT_EQ(solid.domain(), Interval(3, 7));
  expect_near(solid.point(3), {7. / 6, 5. / 3, 0}, 1e-15);
  expect_near(solid.point(5), {25. / 6, 1. / 3, 0}, 2e-15);
  const NurbsCurve dashed = open_curve(3, {0, 1, 11, 12, 22, 23, 33, 34, 44, 45, 55}, kSeven);
  expect_near(dashed.point(12), {0.582251082251082, 1.13419913419913, 0}, 1e-14);
  expect_near(dashed.point(23), {3.58225108225108, 0.865800865800866, 0}, 2e-14);
  checks::check_nurbs(solid);
  checks::check_pieces(dashed);
  checks::check_enclosures(dashed, dashed.domain());
}

// Golovanov 2016, 2.9: closed cubic on the regular octagon.
TEST(NurbsCurve, ClosedCubicOnTheOctagonHasTheBooksRadii) {
  Points octagon;
  for (int i = 0; i < 8; ++i) octagon.push_back({std::cos(i * kPi / 4), std::sin(i * kPi / 4), 0});
  const NurbsCurve curve = closed_curve(3, octagon);
  EXPECT_EQ(curve.domain(), Interval(0, 8));
  EXPECT_EQ(curve.period(), 8);
  EXPECT_NEAR(glm::length(curve.point(0)), 0.902368927062183, 1e-15);
  EXPECT_NEAR(glm::length(curve.point(0.5)), 0.901329695005195, 1e-15);
  for (int k = 0; k <= 2; ++k) expect_near(curve.evaluate(0, 2).d[k], curve.evaluate(8, 2).d[k], 2e-15);
  checks::check_period(curve);
  checks::check_pieces(curve);
  checks::check_nurbs(curve);
  checks::check_enclosures(curve, curve.domain());
}

// Coursework 2024, 1.4.1, figure 1.6.
TEST(NurbsCurve, QuadraticHasThePublishedDerivativesOnBothSidesOfItsKnot) {
  const NurbsCurve curve = open_curve(2, {0, 0, 0, 0.25, 1, 1, 1}, {{0, 0, 0}, {0, 1, 0}, {1, 2, 0}, {3, 0, 0}});
  const auto check = [&](double t, const Vec2& point, const Vec2& derivative) {
    const CurveJet jet = curve.evaluate(t, 1);
    expect_near(jet.d[0], Vec3(point, 0), 1e-9);
    expect_near(jet.d[1], Vec3(derivative, 0), 1e-9);
  };
  check(0, {0, 0}, {0, 8});
  check(0.1, {0.04, 0.68}, {0.8, 5.6});
  check(0.25, {0.25, 1.25}, {2, 2});
  check(0.5, {0.8888888889, 1.444444444}, {3.111111111, -0.4444444444});
  check(0.75, {1.805555556, 1.027777778}, {4.222222222, -2.888888889});
  check(1, {3, 0}, {5.333333333, -5.333333333});
  expect_near(curve.evaluate(0, 2).d[2], {8, -24, 0}, 1e-13);
  expect_near(curve.evaluate(0.25, 2).d[2], {40. / 9, -88. / 9, 0}, 1e-13);
  expect_near(curve.evaluate(std::nextafter(0.25, 0.0), 2).d[2], {8, -24, 0}, 1e-13);
}

NurbsCurve nine_point_circle() {
  const double h = std::sqrt(0.5);
  return open_curve(
      2, {0, 0, 0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1, 1},
      {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}, {0, -1, 0}, {1, -1, 0}, {1, 0, 0}},
      {1, h, 1, h, 1, h, 1, h, 1});
}

// Coursework 2024, 1.5.1 and 1.5.2.
TEST(NurbsCurve, CircleOfNinePointsIsACircle) {
  const NurbsCurve curve = nine_point_circle();
  EXPECT_TRUE(curve.is_closed());
  EXPECT_EQ(curve.period(), 0);
  for (int i = 0; i <= 1000; ++i) {
    const CurveJet jet = curve.evaluate(i / 1000.0, 2);
    EXPECT_NEAR(glm::length(jet.d[0]), 1, 4e-16 * 2);
    EXPECT_NEAR(glm::dot(jet.d[0], jet.d[1]), 0, 1e-14);
    EXPECT_NEAR(glm::dot(jet.d[0], jet.d[2]) + glm::dot(jet.d[1], jet.d[1]), 0, 2e-13);
    const double speed = glm::length(jet.d[1]);
    EXPECT_NEAR(glm::length(glm::cross(jet.d[1], jet.d[2])) / (speed * speed * speed), 1, 1e-14);
  }
  expect_near(curve.evaluate(0, 1).d[1], {0, 5.656854249, 0}, 1e-9);
  expect_near(curve.evaluate(0, 2).d[2], {-32, 13.254834, 0}, 1e-6);
  expect_near(curve.point(1. / 16), {0.9297883011, 0.3680947096, 0}, 1e-10);
  expect_near(curve.evaluate(1. / 16, 1).d[1], {-2.339182086, 5.908653618, 0}, 2e-9);
  expect_near(curve.evaluate(0.125, 1).d[1], {-4.686291501, 4.686291501, 0}, 2e-9);
  expect_near(curve.point(0.3), {-0.2938119377, 0.9558632461, 0}, 1e-10);
  // Once differentiable at the double knots although their multiplicity promises nothing.
  expect_near(curve.evaluate(0.25, 1).d[1], curve.evaluate(std::nextafter(0.25, 0.0), 1).d[1], 1e-14);
}

// Golovanov 2016, 2.14 (f): closed quadratic ellipse with eight points, half axes 3 and 2.
TEST(NurbsCurve, ClosedEllipseOfEightPointsHasTheBooksPoints) {
  const double h = std::cos(kPi / 4);
  const NurbsCurve curve(
      SplineAxis(2, {-1, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5}, Extension::periodic),
      Points{{3, 0, 0}, {3, 2, 0}, {0, 2, 0}, {-3, 2, 0}, {-3, 0, 0}, {-3, -2, 0}, {0, -2, 0}, {3, -2, 0}},
      List{1, h, 1, h, 1, h, 1, h});
  EXPECT_EQ(curve.domain(), Interval(0, 4));
  expect_near(curve.point(0.25), {2.78936490318729, 0.736189419123746, 0}, 1e-14);
  expect_near(curve.point(0.5), {3 / std::sqrt(2), std::sqrt(2), 0}, 1e-15);
  expect_near(curve.point(3.25), {1.10428412868562, -1.85957660212486, 0}, 1e-14);
  expect_near(curve.evaluate(1, 1).d[1], {-3 * std::sqrt(2), 0, 0}, 2e-15);
  for (const double t : {0., 0.7, 1.9, 2.5, 3.99}) {
    const Vec3 p = curve.point(t);
    EXPECT_NEAR(p.x * p.x / 9 + p.y * p.y / 4, 1, 1e-15);
  }
  checks::check_period(curve);
  checks::check_pieces(curve);
  checks::check_enclosures(curve, curve.domain());
}

struct RandomCurves {
  std::mt19937_64 random{17};
  double uniform(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); }

  Points points(int count) {
    Points result;
    for (int i = 0; i < count; ++i) result.push_back({uniform(-5, 5), uniform(-5, 5), uniform(-5, 5)});
    return result;
  }
  // Weights between 1e-3 and 1e3.
  List weights(int count) {
    List result;
    for (int i = 0; i < count; ++i) result.push_back(std::pow(10, uniform(-3, 3)));
    return result;
  }
  // Clamped or not, with repeated knots (at most `degree` equal ones inside), spans that differ by a factor of 100.
  List knots(int degree, int count) {
    const bool clamped = uniform(0, 1) < 0.5;
    List result(clamped ? degree + 1 : 1, uniform(-3, 3));
    const int inner = clamped ? count - degree - 1 : count + degree;
    for (int i = 0, run = degree; i < inner; ++i) {
      run = run < degree && uniform(0, 1) < 0.3 ? run + 1 : 1;
      result.push_back(result.back() + (run > 1 ? 0 : std::pow(10, uniform(-1, 1))));
    }
    if (clamped) result.insert(result.end(), degree + 1, result.back() + 1);
    return result[degree] < result[count] ? result : knots(degree, count);
  }
};

// Points and derivatives to order 6 against 113 bits: within 64 eps of the formula's absolute terms.
TEST(NurbsCurve, DerivativesAgreeWithHigherPrecision) {
  RandomCurves some;
  double worst = 0;
  for (int sample = 0; sample < 60; ++sample) {
    const int degree = 1 + sample % 7, count = degree + 1 + sample % 5;
    const Points points = some.points(count);
    const NurbsCurve curve =
        open_curve(degree, some.knots(degree, count), points, sample % 3 ? some.weights(count) : List());
    const NurbsCurveForm form = *curve.as_nurbs();
    for (int i = 0; i < 6; ++i) {
      const Interval domain = curve.domain();
      const double t = i == 0 ? domain.lo : i == 1 ? domain.hi : some.uniform(domain.lo, domain.hi);
      const auto exact = oracle::curve_derivatives(form, t, kMaxCurveOrder);
      const CurveJet jet = curve.evaluate(t, kMaxCurveOrder);
      for (int k = 0; k <= kMaxCurveOrder; ++k) worst = tests::worse(worst, oracle::error_in_eps(jet.d[k], exact[k]));
    }
  }
  EXPECT_LE(worst, 64);
  RecordProperty("worst_error_in_eps", std::to_string(worst));
}

// The highest degree allowed: still right, and one more is refused.
TEST(NurbsCurve, HighestDegreeWorks) {
  RandomCurves some;
  List knots(26, 0);
  knots.push_back(0.5);
  knots.insert(knots.end(), 26, 1);
  const NurbsCurve curve = open_curve(25, knots, some.points(27));
  checks::check_nurbs(curve);
  checks::check_differences(curve, {0.1, 0.4});
  checks::check_enclosures(curve, {0.5, 1});
  EXPECT_THROW(open_curve(26, List(54), some.points(27)), FieldError);
}

TEST(NurbsCurve, RandomCurvesMeetTheGeneralChecks) {
  RandomCurves some;
  for (int sample = 0; sample < 24; ++sample) {
    const int degree = 1 + sample % 7, count = degree + 1 + sample % 4;
    const NurbsCurve curve =
        open_curve(degree, some.knots(degree, count), some.points(count), sample % 2 ? some.weights(count) : List());
    checks::check_nurbs(curve, 1e-12);
    checks::check_pieces(curve, 1e-12);
    for (const CurvePiece& piece : curve.pieces()) checks::check_enclosures(curve, piece.domain);
    if (HasFailure()) return;
  }
}

// r, r', .., r^(m-1) agree at both ends of the period, and a seam moved by a partial domain changes nothing.
TEST(NurbsCurve, ClosedCurvesJoinSmoothly) {
  RandomCurves some;
  for (int degree = 2; degree <= 6; ++degree) {
    const Points points = some.points(7);
    const List weights = some.weights(7);
    const NurbsCurve curve = closed_curve(degree, points, weights);
    const auto start = oracle::curve_derivatives(*curve.as_nurbs(), curve.domain().lo, degree - 1);
    const CurveJet end = curve.evaluate(curve.domain().hi, degree - 1);
    for (int k = 0; k < degree; ++k) EXPECT_LE(oracle::error_in_eps(end.d[k], start[k]), 64) << degree << ", " << k;

    SplineAxis moved(degree, knots_by_rule("uniform", degree, 7, true, {}), Extension::periodic);
    moved.restrict_to({5.5, 11.25});
    const NurbsCurve part(moved, points, weights);
    EXPECT_EQ(part.domain(), Interval(5.5, 11.25));
    EXPECT_EQ(part.period(), 7);
    EXPECT_FALSE(part.is_closed());
    for (double t = 5.5; t <= 11.25; t += 0.125) expect_near(part.point(t), curve.point(t), 1e-13);
    checks::check_nurbs(part);
    checks::check_pieces(part);
    for (const CurvePiece& piece : part.pieces()) checks::check_enclosures(part, piece.domain);
  }
}

// A knot as often as the degree plus one: two curves end to end with a jump.
TEST(NurbsCurve, FullMultiplicityBreaksTheCurve) {
  const Points points = {{0, 0, 0}, {1, 1, 0}, {2, 0, 0}, {5, 5, 1}, {6, 6, 2}, {7, 5, 1}};
  const NurbsCurve curve = open_curve(2, {0, 0, 0, 1, 1, 1, 2, 2, 2}, points);
  EXPECT_EQ(curve.point(1), points[3]);
  expect_near(curve.point(std::nextafter(1.0, 0.0)), points[2], 1e-15);
  const auto pieces = curve.pieces();
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_EQ(Vec3(pieces[0].points[2]), points[2]);
  EXPECT_EQ(Vec3(pieces[1].points[0]), points[3]);
}

TEST(NurbsCurve, NeighbouringPiecesShareTheirEnds) {
  RandomCurves some;
  for (int sample = 0; sample < 40; ++sample) {
    const int degree = 1 + sample % 6, count = degree + 6;
    const auto pieces = open_curve(degree, some.knots(degree, count), some.points(count), some.weights(count)).pieces();
    for (size_t i = 0; i + 1 < pieces.size(); ++i) EXPECT_EQ(pieces[i].points.back(), pieces[i + 1].points.front());
  }
}

TEST(NurbsCurve, ContinuesAlongItsTangents) {
  const NurbsCurve curve = open_curve(3, {0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 6, 6, 6}, kNine);
  expect_near(curve.point(-2), kNine[0] - 2.0 * Vec3(3, 6, 0), 1e-14);
  const CurveJet jet = curve.evaluate(7, 3);
  expect_near(jet.d[0], curve.point(6) + curve.evaluate(6, 1).d[1], 1e-14);
  expect_near(jet.d[1], curve.evaluate(6, 1).d[1], 0);
  expect_near(jet.d[2], Vec3(0), 0);
}

// Only ratios of weights matter; a negative weight is welcome while the denominator keeps its sign.
TEST(NurbsCurve, WeightsMayBeNegativeOnlyWhileTheDenominatorKeepsItsSign) {
  const Points points = {{0, 0, 0}, {1, 2, 0}, {2, 2, 0}, {3, 3, 0}, {5, 2, 0}, {6, 0, 0}};
  const List knots = {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1};
  const NurbsCurve negative = open_curve(5, knots, points, {1, 1, 1, -0.5, 1, 1});
  expect_near(negative.point(0.5), {2.41176470588235, 1.47058823529412, 0}, 1e-14);  // Golovanov 2016, 2.6
  expect_near(open_curve(5, knots, points, {-2, -2, -2, 1, -2, -2}).point(0.5), negative.point(0.5), 1e-15);
  checks::check_enclosures(negative, negative.domain());
  checks::check_nurbs(negative);
  EXPECT_THROW(open_curve(5, knots, points, {1, 1, 1, -5, 1, 1}), FieldError);
  EXPECT_THROW(open_curve(5, knots, points, {0, 1, 1, 1, 1, 1}), FieldError);
  EXPECT_THROW(open_curve(5, knots, points, {1, 1, 1}), FieldError);
  EXPECT_THROW(open_curve(5, knots, points, {0, 0, 0, 0, 0, 0}), FieldError);
  EXPECT_FALSE(open_curve(5, knots, points, {3, 3, 3, 3, 3, 3}).as_nurbs()->points[0].w != 1);
}

// An enclosure of r' shrinks with the interval: half the interval, about half the box.
TEST(NurbsCurve, EnclosuresAreFirstOrderTight) {
  const NurbsCurve circle = nine_point_circle();
  for (const double width : {1e-2, 1e-4, 1e-6}) {
    const CurveEnclosure box = circle.enclose({0.1, 0.1 + width}, 2);
    EXPECT_LE(box.d[0].diameter(), 8 * width);
    EXPECT_LE(box.d[1].diameter(), 200 * width);
    EXPECT_LE(box.d[2].diameter(), 8000 * width);
  }
}

}  // namespace
}  // namespace lekalo::geometry::nurbs_curve_test
