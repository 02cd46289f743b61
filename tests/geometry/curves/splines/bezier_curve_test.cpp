#include "geometry/curves/splines/bezier_curve.h"

#include "geometry/curves/analytic/polyline.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/curve_checks.h"

namespace lekalo::geometry::bezier_curve_test {
namespace {

using checks::distance;
using Points = std::vector<Vec3>;
using List = std::vector<double>;

void expect_near(const Vec3& a, const Vec3& b, double tolerance) { EXPECT_LE(distance(a, b), tolerance); }

// Golovanov 2016, 2.4; Coursework 2024, 1.2.1.
TEST(BezierCurve, CubicsHaveTheBooksPoints) {
  const NurbsCurve a = bezier_curve(Points{{0, 0, 0}, {1, 3, 0}, {4, 2, 0}, {5, -1, 0}});
  expect_near(a.point(0.3), {1.332, 1.674, 0}, 1e-15);
  expect_near(a.evaluate(0.3, 1).d[1], {5.52, 2.34, 0}, 5e-15);
  const NurbsCurve b = bezier_curve(Points{{0, 0, 0}, {0, 1, 0}, {1, 2, 0}, {3, 0, 0}});
  const double table[3][7] = {{0.25, 0.1875, 0.703125, 1.5, 2.4375, 6, -4.5},
                              {0.5, 0.75, 1.125, 3, 0.75, 6, -9},
                              {0.75, 1.6875, 0.984375, 4.5, -2.0625, 6, -13.5}};
  for (const auto& row : table) {
    const CurveJet jet = b.evaluate(row[0], 2);
    expect_near(jet.d[0], {row[1], row[2], 0}, 1e-15);
    expect_near(jet.d[1], {row[3], row[4], 0}, 4e-15);
    expect_near(jet.d[2], {row[5], row[6], 0}, 1e-14);
  }
}

// The length 4.073387791 of Coursework 2024, 1.2.1, by composite Gauss with two points in each of 4000 intervals.
TEST(BezierCurve, HasThePublishedLength) {
  const NurbsCurve b = bezier_curve(Points{{0, 0, 0}, {0, 1, 0}, {1, 2, 0}, {3, 0, 0}});
  double length = 0;
  const int n = 4000;
  for (int i = 0; i < n; ++i)
    for (const double x : {-1, 1})
      length += glm::length(b.evaluate((i + 0.5 + x / std::sqrt(12.0)) / n, 1).d[1]) / (2 * n);
  EXPECT_NEAR(length, 4.073387791, 1e-9);
}

// Coursework 2024, 1.3.1: the quarter circle with weights 1, 1, 2 and with symmetric weights.
TEST(BezierCurve, QuarterCirclesHaveThePublishedDerivatives) {
  const Points points = {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const NurbsCurve a = bezier_curve(points, List{1, 1, 2});
  expect_near(a.point(0.25), {15. / 17, 8. / 17, 0}, 2e-16);
  expect_near(a.evaluate(0.25, 1).d[1], {-0.8858131488, 1.660899654, 0}, 1e-9);
  const CurveJet half = a.evaluate(0.5, 2);
  expect_near(half.d[0], {0.6, 0.8, 0}, 2e-16);
  expect_near(half.d[1], {-1.28, 0.96, 0}, 1e-15);
  expect_near(half.d[2], {-0.512, -2.816, 0}, 5e-15);
  expect_near(a.evaluate(1, 1).d[1], {-1, 0, 0}, 1e-15);
  const double h = std::sqrt(0.5);
  const NurbsCurve b = bezier_curve(points, List{1, h, 1});
  expect_near(b.point(0.25), {0.9297883011, 0.3680947096, 0}, 1e-10);
  expect_near(b.evaluate(0.25, 1).d[1], {-0.5847955215, 1.477163405, 0}, 1e-9);
  expect_near(b.evaluate(0.5, 1).d[1], {-1.171572875, 1.171572875, 0}, 1e-9);
  for (int i = 0; i <= 100; ++i) EXPECT_NEAR(glm::length(b.point(i / 100.0)), 1, 3e-16);
}

// Golovanov 2016, 2.6: degree 5, the weight of p_3 varied.
TEST(BezierCurve, WeightsPullAsTheBookSays) {
  const Points points = {{0, 0, 0}, {1, 2, 0}, {2, 2, 0}, {3, 3, 0}, {5, 2, 0}, {6, 0, 0}};
  const auto at = [&](double w) { return bezier_curve(points, List{1, 1, 1, w, 1, 1}).point(0.5); };
  expect_near(at(1), {2.6875, 2.1875, 0}, 1e-15);
  expect_near(at(4), {2.83870967741935, 2.58064516129032, 0}, 1e-14);
  expect_near(at(-0.5), {2.41176470588235, 1.47058823529412, 0}, 1e-14);
  // The point moves straight to p_3 and divides the way in the ratio delta : 1.
  EXPECT_NEAR(distance(at(1), at(4)) / distance(at(4), points[3]), 0.9375, 1e-14);
}

TEST(BezierCurve, ContinuesAnalytically) {
  const NurbsCurve parabola = bezier_curve(Points{{0, 0, 0}, {0.5, 0, 0}, {1, 1, 0}}, {}, {0.25, 0.75});
  EXPECT_EQ(parabola.domain(), Interval(0.25, 0.75));
  for (const double t : {-2., -0.5, 0.1, 1.5, 3.}) {
    expect_near(parabola.point(t), {t, t * t, 0}, 1e-14);
    expect_near(parabola.evaluate(t, 2).d[2], {0, 2, 0}, 1e-14);
  }
  checks::check_pieces(parabola);
  checks::check_nurbs(parabola);
}

TEST(BezierCurve, RandomCurvesMeetTheGeneralChecks) {
  std::mt19937_64 random(31);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int degree = 1; degree <= 9; ++degree) {
    Points points;
    List weights;
    for (int i = 0; i <= degree; ++i) {
      points.push_back({uniform(random), uniform(random), uniform(random)});
      weights.push_back(std::pow(10, uniform(random)));
    }
    const NurbsCurve curve = bezier_curve(points, degree % 2 ? weights : List());
    checks::check_differences(curve, {0.1, 0.9});
    checks::check_enclosures(curve, curve.domain());
    checks::check_nurbs(curve);
    checks::check_pieces(curve);
    checks::check_period(curve);
  }
}

TEST(BezierCurve, RefusesTooManyPoints) {
  EXPECT_NO_THROW(bezier_curve(Points(26, Vec3(1))));
  EXPECT_THROW(bezier_curve(Points(27, Vec3(1))), FieldError);
  EXPECT_THROW(bezier_curve(Points(1, Vec3(1))), FieldError);
  EXPECT_THROW(bezier_curve(Points{{0, 0, 0}, {1, 0, 0}}, {}, {-1, 1}), FieldError);
}

TEST(Segment, IsStraight) {
  const Segment segment({1, 2, 3}, {4, 0, 3.5});
  EXPECT_EQ(segment.point(0), Vec3(1, 2, 3));
  EXPECT_EQ(segment.point(1), Vec3(4, 0, 3.5));
  expect_near(segment.point(3), {10, -4, 4.5}, 1e-14);
  checks::check_derivatives(segment,
                            [](const auto& t) {
                              using T = std::decay_t<decltype(t)>;
                              return Triple<T>{1.0 + 3.0 * t, 2.0 - 2.0 * t, 3.0 + 0.5 * t};
                            },
                            {-1, 2});
  checks::check_enclosures(segment, segment.domain());
  checks::check_nurbs(segment);
  checks::check_pieces(segment);
  checks::check_period(segment);
  EXPECT_THROW(Segment({1, 1, 1}, {1, 1, 1}), FieldError);
}

// Golovanov 2016, 2.3 (a): parameter 0..n, derivatives jump, each side's own to the right.
TEST(Polyline, DerivativesAreThoseOfTheSides) {
  const Points points = {{0, 0, 0}, {1, 2, 0}, {3, 3, 0}, {4, 0, 0}, {6, 1, 0}};
  const NurbsCurve open = polyline(points);
  EXPECT_EQ(open.domain(), Interval(0, 4));
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(open.point(i), points[i]);
    expect_near(open.point(i + 0.25), 0.75 * points[i] + 0.25 * points[i + 1], 1e-15);
    expect_near(open.evaluate(i, 1).d[1], points[i + 1] - points[i], 0);
    expect_near(open.evaluate(i + 0.5, 2).d[2], Vec3(0), 0);
  }
  expect_near(open.evaluate(4, 1).d[1], points[4] - points[3], 0);
  expect_near(open.point(5), 2.0 * points[4] - points[3], 1e-15);
  EXPECT_EQ(open.pieces().size(), 4u);
  for (const CurvePiece& piece : open.pieces()) checks::check_enclosures(open, piece.domain);
  checks::check_nurbs(open);
  checks::check_pieces(open);
  checks::check_period(open);
}

TEST(Polyline, ClosedOnesArePeriodic) {
  const Points points = {{0, 0, 0}, {1, 2, 0}, {3, 3, 0}, {4, 0, 0}};
  const NurbsCurve closed = polyline(points, true);
  EXPECT_EQ(closed.domain(), Interval(0, 4));
  EXPECT_TRUE(closed.is_closed());
  expect_near(closed.point(3.5), {2, 0, 0}, 1e-15);
  EXPECT_EQ(closed.point(4), points[0]);
  expect_near(closed.evaluate(4, 1).d[1], points[0] - points[3], 0);
  expect_near(closed.evaluate(0, 1).d[1], points[1] - points[0], 0);
  checks::check_period(closed);
  checks::check_pieces(closed);
  EXPECT_THROW(polyline(Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}}, true), FieldError);
  EXPECT_THROW(polyline(Points{{0, 0, 0}, {0, 0, 0}}), FieldError);
  EXPECT_THROW(polyline(Points{{0, 0, 0}, {1, 0, 0}}, true), FieldError);
}

}  // namespace
}  // namespace lekalo::geometry::bezier_curve_test
