// Polylines and splines of curves: the books' numbers of spans, proof against dense samples, corners.
#include "geometry/curves/operations/spline_of_curve.h"

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/ellipse.h"
#include "geometry/curves/analytic/polyline.h"
#include "geometry/curves/curve_checks.h"
#include "geometry/curves/operations/polyline_of_curve.h"

namespace lekalo::geometry::spline_of_curve_test {
namespace {

using checks::distance;

double largest_distance(const Curve& curve, const Curve& of) {
  double largest = 0;
  const Interval t = of.domain();
  for (int i = 0; i <= 20000; ++i) {
    const double at = t.clamp(t.lo + t.width() * i / 20000);
    largest = std::max(largest, distance(curve.point(at), of.point(at)));
  }
  return largest;
}

int spans(const NurbsCurve& curve) { return static_cast<int>(curve.pieces().size()); }

std::vector<double> distinct_knots(const NurbsCurve& curve) {
  std::vector<double> knots = curve.axis().knots();
  knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
  return knots;
}

const Circle kCircle(Frame{}, 1000);
const Ellipse kQuarter(Frame{}, 1000, 10, {0, kPi / 2});

// Zavyalov et al. 1985, II.5: R = 1000, tolerance 0.1 takes 15 equal spans, not 14.
TEST(SplineOfCurve, CircleTakesTheBooksSpans) {
  const NurbsCurve spline = spline_of_curve(kCircle, 0.1, {.even = true});
  EXPECT_EQ(spans(spline), 15);
  EXPECT_NEAR(largest_distance(spline, kCircle), 0.07994, 5e-6);
  EXPECT_LE(spans(spline_of_curve(kCircle, 0.1)), 15);
  EXPECT_NEAR(spline.period(), kTwoPi, 1e-15);
  checks::check_period(spline);
  checks::check_pieces(spline);
  EXPECT_EQ(spline_of_curve(kQuarter, 0.1).period(), 0);
  const NurbsCurve by_length = spline_of_curve(kCircle, 0.1, {.by_length = true});
  EXPECT_NEAR(by_length.period(), 2000 * kPi, 1e-9);
  EXPECT_NEAR(glm::length(by_length.point(-123)), 1000, 0.1);
}

// The same: a quarter of an ellipse 1000 x 10; four spans, five by length.
TEST(SplineOfCurve, QuarterEllipseTakesTheBooksSpans) {
  const NurbsCurve even = spline_of_curve(kQuarter, 0.1, {.even = true});
  EXPECT_EQ(spans(even), 4);
  EXPECT_NEAR(largest_distance(even, kQuarter), 0.0606, 5e-5);
  const NurbsCurve longest = spline_of_curve(kQuarter, 0.1);
  EXPECT_EQ(spans(longest), 4);
  EXPECT_LE(largest_distance(longest, kQuarter), 0.1);
  const NurbsCurve by_length = spline_of_curve(kQuarter, 0.1, {.by_length = true});
  EXPECT_EQ(spans(by_length), 5);
  EXPECT_NEAR(by_length.domain().hi, 1000.2745824, 5e-8);
  const std::vector<double> book = {0, 0.946, 10.366, 70.96, 339.81, 1000.2}, knots = distinct_knots(by_length);
  for (size_t k = 1; k < 5; ++k) EXPECT_GE(knots[k], book[k]) << k;
  for (const double s : knots) EXPECT_NEAR(glm::length(by_length.evaluate(s, 1).d[1]), 1, 1e-12);
}

TEST(SplineOfCurve, ToleranceHoldsAtAnySize) {
  for (const double tolerance : {1e-1, 1e-3, 1e-6, 1e-9}) {
    const NurbsCurve spline = spline_of_curve(kQuarter, 1000 * tolerance);
    EXPECT_LE(largest_distance(spline, kQuarter), 1000 * tolerance);
    if (tolerance < 1e-2) {
      EXPECT_GE(largest_distance(spline, kQuarter), 200 * tolerance);
    }
  }
}

TEST(SplineOfCurve, KeepsCornersAndReproducesCubics) {
  const NurbsCurve corners = polyline(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {4, 3, 1}});
  for (const NurbsCurve& curve : {spline_of_curve(corners, 1e-9), polyline_of_curve(corners, 1e-9)}) {
    EXPECT_EQ(spans(curve), 3);
    EXPECT_LE(largest_distance(curve, corners), 4e-15);
    checks::check_pieces(curve);
  }
}

// Zavyalov et al. 1985, I.4: sagitta R (1 - cos(h / 2)), half of it where balanced.
TEST(PolylineOfCurve, CircleHasTheSagittaOfItsChords) {
  for (const double tolerance : {100., 1., 1e-3}) {
    const NurbsCurve chords = polyline_of_curve(kCircle, tolerance, {.even = true});
    const double h = kTwoPi / spans(chords);
    EXPECT_NEAR(largest_distance(chords, kCircle) / (1000 * (1 - std::cos(h / 2))), 1, 1e-6);
    EXPECT_LE(1000 * (1 - std::cos(h / 2)), tolerance);
    EXPECT_GT(1000 * (h * spans(chords) / (spans(chords) - 1)) * h / 8, 0.85 * tolerance);
    const NurbsCurve balanced = polyline_of_curve(kCircle, tolerance, {.balanced = true, .even = true});
    EXPECT_LE(largest_distance(balanced, kCircle), tolerance);
    EXPECT_LT(spans(balanced), tolerance < 50 ? 0.78 * spans(chords) : spans(chords));
  }
}

TEST(PolylineOfCurve, SpeedAlongTheCurveDoesNotCount) {
  const NurbsCurve line(SplineAxis(3, {0, 0, 0, 0, 1, 1, 1, 1}, Extension::analytic),
                        std::vector<Vec3>{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {1, 1, 1}});
  EXPECT_EQ(spans(polyline_of_curve(line, 1e-9)), 1);
}

}  // namespace
}  // namespace lekalo::geometry::spline_of_curve_test
