// Tension splines: the formula itself, their limits, smoothness, shape.
#include "geometry/curves/interpolation/tension_spline.h"

#include "geometry/curves/curve_checks.h"
#include "geometry/curves/interpolation/point_parameters.h"
#include "geometry/curves/interpolation/spline_curve.h"

namespace lekalo::geometry::tension_spline_test {
namespace {

using checks::distance;
using Points = std::vector<Vec3>;
using List = std::vector<double>;

const Points kPoints = {{0, 0, 0}, {1, 2, 1}, {3, 3, 0}, {4, 0, -1}, {6, 1, 2}, {6.5, 4, 0}};
const List kOpen = {0, 1, 2.5, 3, 5, 5.5}, kClosed = {0, 1, 2.5, 3, 5, 5.5, 7};

TEST(TensionSpline, WithoutTensionIsTheCubicSpline) {
  const SplineEnd natural{EndRule::natural, {}, {}};
  const NurbsCurve open = tension_spline({kPoints, kOpen, false}, List(5, 0));
  const NurbsCurve cubic = spline_curve(kPoints, kOpen, 3, natural, natural);
  const NurbsCurve closed = tension_spline({kPoints, kClosed, true}, List(6, 0));
  const NurbsCurve closed_cubic = closed_spline_curve(kPoints, kClosed, 3);
  for (int i = 0; i <= 140; ++i) {
    const double t = 0.05 * i;
    if (t <= 5.5) {
      EXPECT_LE(distance(open.point(t), cubic.point(t)), 1e-14);
    }
    EXPECT_LE(distance(closed.point(t), closed_cubic.point(t)), 2e-14);
  }
}

TEST(TensionSpline, UnderLargeTensionIsThePolygon) {
  const NurbsCurve curve = tension_spline({kPoints, kOpen, false}, List(5, 1e8));
  for (int span = 0; span < 5; ++span)
    for (const double u : {0., 0.1, 0.5, 0.9})
      EXPECT_LE(distance(curve.point(kOpen[span] + u * (kOpen[span + 1] - kOpen[span])),
                         (1 - u) * kPoints[span] + u * kPoints[span + 1]),
                2e-7);  // step * turn of the slope / tension
}

TEST(TensionSpline, IsOfClassC2AndFollowsItsFormula) {
  const List tensions = {0.5, 3, 0, 20, 1, 7};
  for (const bool closed : {false, true}) {
    const PointSequence data{kPoints, closed ? std::span<const double>(kClosed) : kOpen, closed};
    const auto p = std::span(tensions).first(closed ? 6 : 5);
    const NurbsCurve curve = closed ? tension_spline(data, p) : tension_spline(data, p, Vec3(1, 0, 2), {});
    for (int i = closed ? 0 : 1; i < (closed ? 6 : 5); ++i) {
      const double t = data.parameter(i), before = data.closed && i == 0 ? 7 - 1e-10 : t - 1e-10;
      for (int k = 0; k <= 2; ++k)
        EXPECT_LE(distance(curve.evaluate(before, k).d[k], curve.evaluate(t, k).d[k]), 1e-6) << i << " " << k;
    }
    if (!closed) {
      EXPECT_LE(distance(curve.evaluate(0, 1).d[1], {1, 0, 2}), 1e-14);
      EXPECT_LE(glm::length(curve.evaluate(5.5, 2).d[2]), 1e-13);
    }
    for (size_t i = 0; i < p.size(); ++i) {
      const double h = data.step(i), lo = data.parameter(i), scale = h * h / (2 * (p[i] * p[i] + 3 * p[i] + 3));
      const Vec3 c = scale * curve.evaluate(lo, 2).d[2], d = scale * curve.evaluate(lo + h * (1 - 1e-12), 2).d[2];
      for (const double u : {0.1, 0.5, 0.75}) {
        const double v = 1 - u;
        const Vec3 book = v * data.point(i) + u * data.point(i + 1) + (v * v * v / (1 + p[i] * u) - v) * c +
                          (u * u * u / (1 + p[i] * v) - u) * d;
        EXPECT_LE(distance(curve.point(lo + u * h), book), 1e-10) << i << " " << u;
      }
    }
    checks::check_pieces(curve);
    checks::check_enclosures(curve, curve.domain());
  }
}

// Data with a steep rise: the cubic swings out of them, the drawn one does not.
TEST(TensionSpline, KeepsTheShapeOfItsPoints) {
  const Points rise = {{0, 0, 0}, {1, 0.05, 0}, {2, 0.2, 0}, {3, 4, 0}, {4, 4.2, 0}, {5, 4.25, 0}};
  const List t = {0, 1, 2, 3, 4, 5};
  const PointSequence data{rise, t, false};
  const auto lowest_slope = [&](const NurbsCurve& curve) {
    double lowest = kInfinity;
    for (int i = 100; i <= 400; ++i) lowest = std::min(lowest, curve.evaluate(0.01 * i, 1).d[1].y);
    return lowest;
  };
  EXPECT_LT(lowest_slope(tension_spline(data, List(5, 0))), -0.1);
  const List tensions = shape_keeping_tensions(data, List(5, 0));
  const NurbsCurve curve = tension_spline(data, tensions);
  EXPECT_GE(lowest_slope(curve), 0);
  for (int i = 0; i < 50; ++i) {
    EXPECT_NEAR(curve.point(0.1 * i).x, 0.1 * i, 1e-14);
    const double bend = curve.evaluate(0.1 * i, 2).d[2].y;
    if (i > 10 && i < 20) {
      EXPECT_GE(bend, 0) << i;
    }
    if (i > 30 && i < 40) {
      EXPECT_LE(bend, 0) << i;
    }
  }
  EXPECT_EQ(shape_keeping_tensions({rise, t, false}, tensions), tensions);
}

}  // namespace
}  // namespace lekalo::geometry::tension_spline_test
