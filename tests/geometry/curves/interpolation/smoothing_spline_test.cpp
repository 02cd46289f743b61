// Smoothing and local splines: optimality conditions, the blade section of Zavyalov et al. 1985, reproduction.
#include "geometry/curves/interpolation/smoothing_spline.h"

#include "geometry/curves/curve_checks.h"
#include "geometry/curves/interpolation/blade_section.h"
#include "geometry/curves/interpolation/local_spline.h"
#include "geometry/curves/interpolation/spline_curve.h"

namespace lekalo::geometry::smoothing_spline_test {
namespace {

using checks::distance;
using Points = std::vector<Vec3>;
using List = std::vector<double>;

// Integral of y''^2: y'' is linear between knots.
double energy(const NurbsCurve& curve, const List& t, int k = 1) {
  double sum = 0;
  for (size_t i = 0; i + 1 < t.size(); ++i) {
    const double a = curve.evaluate(t[i], 2).d[2][k], b = curve.evaluate(t[i + 1], 2).d[2][k];
    sum += (t[i + 1] - t[i]) / 3 * (a * a + a * b + b * b);
  }
  return sum;
}

// Jumps of the third derivative at the parameters.
List jumps(const NurbsCurve& curve, const List& t, int k) {
  List result;
  const bool closed = curve.period() > 0;
  // In the middle of a span, where no rounding of a knot takes it to the next one.
  const auto third = [&](double from, double to) { return curve.evaluate(0.5 * (from + to), 3).d[3][k]; };
  for (size_t i = 0; i < t.size(); ++i) {
    const double over_seam = closed ? third(t.back(), t[0] + curve.period()) : 0;
    const double before = i > 0 ? third(t[i - 1], t[i]) : over_seam;
    const double after = i + 1 < t.size() ? third(t[i], t[i + 1]) : over_seam;
    result.push_back(after - before);
  }
  return result;
}

// Kuhn, Tucker: inside the corridor no jump, at its borders one that pulls outwards (Zavyalov et al. 1985, 65).
void check_optimal(const Points& points, const List& t, const List& half_widths, double period = 0) {
  List parameters = t;
  if (period > 0) parameters.push_back(t[0] + period);
  const NurbsCurve curve = corridor_spline(points, parameters, period > 0, half_widths);
  for (int k = 0; k < 3; ++k) {
    const List d = jumps(curve, t, k);
    double largest = 0, size = 0, step = kInfinity;
    for (const double x : d) largest = std::max(largest, std::abs(x));
    for (const Vec3& p : points) size = std::max(size, std::abs(p[k]));
    for (size_t i = 0; i + 1 < t.size(); ++i) step = std::min(step, t[i + 1] - t[i]);
    // Beside it what rounding of values, an epsilon each, makes of third derivatives: 12 / h^3 of it on both sides.
    const double tolerance = 1e-10 * largest + 64 * 0x1p-52 * size / std::pow(step, 3);
    for (size_t i = 0; i < t.size(); ++i) {
      const double off = curve.point(t[i])[k] - points[i][k], width = half_widths[i];
      EXPECT_LE(std::abs(off), width * (1 + 1e-12) + 1e-13);
      if (std::abs(off) < width * (1 - 1e-9)) {
        EXPECT_LE(std::abs(d[i]), tolerance) << i;
      } else if (width > 0) {
        EXPECT_LE(off * d[i], tolerance) << i;
      }
    }
  }
}

TEST(CorridorSpline, IsOptimal) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 20; ++trial) {
    Points points;
    List t, widths;
    for (int i = 0; i < 5 + 4 * trial; ++i) {
      t.push_back((i > 0 ? t.back() : 0) + 1.1 + uniform(random));
      points.push_back({t.back(), uniform(random), std::sin(t.back()) + 0.1 * uniform(random)});
      widths.push_back(i % 7 == 3 ? 0 : 0.3 * (1.1 + uniform(random)));
    }
    check_optimal(points, t, widths);
    check_optimal(points, t, widths, t.back() - t[0] + 0.7);
  }
}

TEST(CorridorSpline, OfTheBladeSectionHasTheSmallestIntegral) {
  const SplineEnd natural{EndRule::natural, {}, {}};
  EXPECT_NEAR(energy(spline_curve(blade_points(), kBladeT, 3, natural, natural), kBladeT), 0.08923, 5e-6);
  EXPECT_NEAR(energy(corridor_spline(blade_points(), kBladeT, false, List(23, 0.1)), kBladeT), 0.07774, 5e-6);
  check_optimal(blade_points(), kBladeT, List(23, 0.1));
}

TEST(CorridorSpline, WhereALineFitsIsALine) {
  const Points points = {{0, 0, 0}, {1, 1.05, 0}, {2, 1.95, 0}, {3, 3, 0}};
  const NurbsCurve curve = corridor_spline(points, List{0, 1, 2, 3}, false, List(4, 0.1));
  EXPECT_LE(energy(curve, {0, 1, 2, 3}), 1e-28);
}

TEST(SmoothingSpline, StandsBetweenTheInterpolantAndTheLine) {
  const NurbsCurve exact = smoothing_spline(blade_points(), kBladeT, false, 0);
  for (size_t i = 0; i < kBladeT.size(); ++i) EXPECT_LE(distance(exact.point(kBladeT[i]), blade_points()[i]), 1e-12);
  const NurbsCurve line = smoothing_spline(blade_points(), kBladeT, false, 1e15);
  EXPECT_LE(glm::length(line.evaluate(0, 2).d[2]), 1e-11);
}

// A change of any value of the smoothing spline makes its functional larger: the gradient vanishes.
TEST(SmoothingSpline, IsStationary) {
  const double stiffness = 30;
  List weights, closed_t = kBladeT;
  closed_t.push_back(60);
  for (int i = 0; i < 23; ++i) weights.push_back(1 + 0.1 * i);
  const NurbsCurve curve = smoothing_spline(blade_points(), kBladeT, false, stiffness, weights);
  const List d = jumps(curve, kBladeT, 1);
  for (size_t i = 0; i < kBladeT.size(); ++i)
    EXPECT_NEAR(weights[i] * (curve.point(kBladeT[i]).y - kBladeZ[i]) + stiffness * d[i], 0, 1e-9);
  const NurbsCurve closed = smoothing_spline(blade_points(), closed_t, true, stiffness, weights);
  const List e = jumps(closed, kBladeT, 1);
  for (size_t i = 0; i < kBladeT.size(); ++i)
    EXPECT_NEAR(weights[i] * (closed.point(kBladeT[i]).y - kBladeZ[i]) + stiffness * e[i], 0, 1e-9);
}

TEST(LocalSpline, OfOrderFourReproducesCubicsOfOrderTwoLines) {
  const auto cubic = [](double t) { return Vec3(t, t * t * t - 2 * t, 3 - t * t); };
  const List t = {-1, -0.5, 0.1, 1.3, 1.7, 2.6, 4};
  Points points, line;
  for (const double x : t) points.push_back(cubic(x)), line.push_back({x, 2 - 3 * x, 1});
  const NurbsCurve curve = local_spline({points, t, false}, 4), straight = local_spline({line, t, false}, 2);
  EXPECT_EQ(curve.domain(), Interval(-1, 4));
  for (int i = 0; i <= 50; ++i) {
    EXPECT_LE(distance(curve.point(-1 + 0.1 * i), cubic(-1 + 0.1 * i)), 5e-14);
    EXPECT_LE(distance(straight.point(-1 + 0.1 * i), {-1 + 0.1 * i, 5 - 0.3 * i, 1}), 1e-14);
  }
}

// Zavyalov et al. 1985, (97): weights of neighbours on equal steps, open and closed.
TEST(LocalSpline, HasTheBooksWeightsAtKnots) {
  Points unit(11, Vec3(0));
  unit[5].x = 1;
  List t;
  for (int i = 0; i <= 11; ++i) t.push_back(i);
  for (const bool closed : {false, true}) {
    const PointSequence data{unit, std::span(t).first(closed ? 12 : 11), closed};
    const NurbsCurve second = local_spline(data, 2), fourth = local_spline(data, 4);
    const List book = {-1. / 36, 1. / 9, 5. / 6, 1. / 9, -1. / 36};
    for (int i = 3; i <= 7; ++i) EXPECT_NEAR(fourth.point(i).x, book[i - 3], 1e-15);
    EXPECT_NEAR(second.point(5).x, 2. / 3, 1e-15);
    EXPECT_NEAR(second.point(4).x, 1. / 6, 1e-15);
    EXPECT_NEAR(second.point(3).x, 0, 1e-15);
  }
}

TEST(LocalSpline, OfOrderTwoInterpolatesItsEnds) {
  const NurbsCurve curve = local_spline({blade_points(), kBladeT, false}, 2);
  EXPECT_LE(distance(curve.point(kBladeT.front()), blade_points().front()), 1e-13);
  EXPECT_LE(distance(curve.point(kBladeT.back()), blade_points().back()), 1e-13);
}

// 47 passes in the corridor come within 0.008 of the printed column.
TEST(LocalSpline, SmoothsTheBladeSectionAsPrinted) {
  const Points smooth = smoothed_points({blade_points(), kBladeT, false}, 4, 47, List(23, 0.1));
  double largest = 0;
  for (size_t i = 0; i < kBladeT.size(); ++i) {
    EXPECT_LE(std::abs(smooth[i].y - kBladeZ[i]), 0.1 + 1e-12);
    EXPECT_NEAR(smooth[i].x, kBladeT[i], 1e-11);
    largest = std::max(largest, std::abs(smooth[i].y - kBladeSmoothed[i]));
  }
  EXPECT_LE(largest, 0.0085);
}

}  // namespace
}  // namespace lekalo::geometry::smoothing_spline_test
