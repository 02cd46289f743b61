// Polygons of curves: the sag measured densely stays within the tolerance; the numbers of chords stay at or below the
// corrected counts of Golovanov 2016, 8.3 (parabola, ellipse, cubic), and close to the exact count of a circle.
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/ellipse.h"
#include "geometry/curves/analytic/polyline.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/splines/bezier_curve.h"
#include "geometry/tessellation/tessellate.h"
#include "support/worst.h"

namespace lekalo::geometry::curve_polygon_test {
namespace {

double measured_sag(const Curve& curve, const std::vector<double>& ts) {
  double worst = 0;
  for (size_t i = 0; i + 1 < ts.size(); ++i) {
    const Vec3 a = curve.point(ts[i]), b = curve.point(ts[i + 1]), d = glm::normalize(b - a);
    for (int k = 1; k < 50; ++k) {
      const Vec3 p = curve.point(ts[i] + (ts[i + 1] - ts[i]) * k / 50) - a;
      worst = tests::worse(worst, glm::length(p - glm::dot(p, d) * d));
    }
  }
  return worst;
}

TessellationTolerance sag_only(double sag) { return {sag, kPi, {}}; }

void check(const Curve& curve, double sag, size_t max_chords) {
  const std::vector<double> ts = polygon_parameters(curve, sag_only(sag));
  EXPECT_EQ(ts.front(), curve.domain().lo);
  EXPECT_EQ(ts.back(), curve.domain().hi);
  for (size_t i = 0; i + 1 < ts.size(); ++i) EXPECT_LT(ts[i], ts[i + 1]);
  EXPECT_LE(measured_sag(curve, ts), sag * (1 + 1e-9));
  EXPECT_LE(ts.size() - 1, max_chords);
}

TEST(CurvePolygon, CircleNeedsTheExactCount) {
  const Circle circle(Frame{}, 1);
  for (double sag : {0.1, 0.01, 1e-3, 1e-4, 1e-6}) {
    const auto exact = static_cast<size_t>(std::ceil(kTwoPi / (2 * std::acos(1 - sag))));
    check(circle, sag, exact + 1);
  }
}

TEST(CurvePolygon, ParabolaEllipseAndCubicOfTheBook) {
  // (t, t^2) over [-2, 2]
  const std::vector<Vec3> parabola{{-2, 4, 0}, {0, -4, 0}, {2, 4, 0}};
  check(bezier_curve(parabola), 0.01, 16);
  check(bezier_curve(parabola), 0.001, 48);
  check(Ellipse(Frame{}, 3, 1), 0.01, 30);
  check(Ellipse(Frame{}, 3, 1), 0.001, 93);
  // (t, t^3) over [0, 1], from its inflection
  const std::vector<Vec3> cubic{{0, 0, 0}, {1.0 / 3, 0, 0}, {2.0 / 3, 0, 0}, {1, 1, 0}};
  check(bezier_curve(cubic), 0.01, 6);
  check(bezier_curve(cubic), 0.001, 16);
}

TEST(CurvePolygon, StraightAndCorneredCurves) {
  check(Segment({0, 0, 0}, {3, 4, 5}), 1e-6, 1);
  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {2, 1, 1}};
  EXPECT_EQ(polygon_parameters(polyline(corners), sag_only(1e-3)), (std::vector<double>{0, 1, 2, 3}));
}

TEST(CurvePolygon, CurvesWithCuspsAndLoops) {
  // A cubic with a cusp at t = 1/2 and one with a loop.
  const std::vector<Vec3> cusp{{0, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 0}};
  const std::vector<Vec3> loop{{0, 0, 0}, {3, 2, 1}, {-2, 2, 1}, {1, 0, 0}};
  check(bezier_curve(cusp), 1e-3, 60);
  check(bezier_curve(loop), 1e-3, 60);
}

TEST(CurvePolygon, AngleAndPlaceDecideToo) {
  const Circle circle(Frame{}, 1);
  EXPECT_EQ(polygon_parameters(circle, {1.0, 20 * kPi / 180, {}}).size(), 19u);
  TessellationTolerance tolerance{1, kPi, [](const Vec3& p) { return p.x > 0 ? 1e-2 : 1e-4; }};
  const std::vector<double> ts = polygon_parameters(circle, tolerance);
  // 23 / 2 + 223 / 2 chords by the exact step.
  EXPECT_NEAR(static_cast<double>(ts.size()), 123, 14);
}

}  // namespace
}  // namespace lekalo::geometry::curve_polygon_test
