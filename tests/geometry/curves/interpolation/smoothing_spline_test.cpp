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
void check_optimal(const Points& points, const List& t, const List& half_widths, double period = 0,
                   const EndTangents& ends = {}) {
  List parameters = t;
  if (period > 0) parameters.push_back(t[0] + period);
  const NurbsCurve curve = corridor_spline(points, parameters, period > 0, half_widths, ends);
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

// With slopes at one end or both they are kept, and the conditions are the same.
TEST(CorridorSpline, WithEndTangentsIsOptimal) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 40; ++trial) {
    Points points;
    List t, widths;
    for (int i = 0; i < 3 + 3 * (trial / 4); ++i) {
      t.push_back((i > 0 ? t.back() : 0) + 1.1 + uniform(random));
      points.push_back({t.back(), uniform(random), std::sin(t.back()) + 0.1 * uniform(random)});
      widths.push_back(i % 7 == 3 ? 0 : 0.3 * (1.1 + uniform(random)));
    }
    const Vec3 first(1, 2 * uniform(random), 1), last(0.5, 2 * uniform(random), 0);
    EndTangents ends;
    if (trial % 4 != 0) ends.start = first;
    if (trial % 4 != 1) ends.end = last;
    check_optimal(points, t, widths, 0, ends);
    const NurbsCurve curve = corridor_spline(points, t, false, widths, ends);
    if (ends.start) {
      EXPECT_LE(glm::length(curve.evaluate(t.front(), 1).d[1] - first), 1e-12);
    }
    if (ends.end) {
      EXPECT_LE(glm::length(curve.evaluate(t.back(), 1).d[1] - last), 1e-12);
    }
  }
}

// Whatever fits in a wide corridor: the second derivative that both slopes ask for is the same everywhere.
TEST(CorridorSpline, OfTwoSlopesIsAParabolaWhereItFits) {
  const Points points = {{0, 0, 0}, {1, 1, 0}, {2, 0, 0}, {3, 1, 0}};
  const List t = {0, 1, 2, 3};
  const EndTangents ends{Vec3(1, 0, 0), Vec3(1, 3, 0)};
  const NurbsCurve curve = corridor_spline(points, t, false, List(4, 10), ends);
  for (const double at : {0., 0.7, 2., 3.}) {
    EXPECT_NEAR(curve.point(at).y, at * at / 2 - 1.25, 1e-14);
    EXPECT_NEAR(curve.point(at).x, at, 1e-14);
  }
}

// Lines that touch bounds without pulling at them: points that only rounding holds do not keep the search going.
TEST(CorridorSpline, FindsLinesThatTouchTheCorridor) {
  const List t = {0, 1, 2, 3, 4};
  for (const double slope : {-2., 0., 0.3, 1. / 3}) {
    Points points;
    for (int i = 0; i < 5; ++i) points.push_back({t[i], slope * t[i] + (i % 2 == 0 ? 0.1 : -0.1), 0});
    const Vec3 along(1, slope, 0);
    for (const EndTangents& ends :
         {EndTangents{}, EndTangents{along, {}}, EndTangents{{}, along}, EndTangents{along, along}}) {
      const NurbsCurve curve = corridor_spline(points, t, false, List(5, 0.1), ends);
      EXPECT_LE(energy(curve, t), 1e-24);
    }
  }
}

TEST(CorridorSpline, RefusesTangentsAtEndsThatAClosedCurveHasNot) {
  const Points points = {{0, 0, 0}, {1, 1, 0}, {2, 0, 0}};
  EXPECT_THROW(corridor_spline(points, List{0, 1, 2, 3}, true, List(3, 0.1), {Vec3(1, 0, 0), {}}), FieldError);
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
  const Vec3 slope(1, 2, 0);
  const NurbsCurve clamped = smoothing_spline(blade_points(), kBladeT, false, stiffness, weights, {slope, slope});
  const List c = jumps(clamped, kBladeT, 1);
  for (size_t i = 0; i < kBladeT.size(); ++i)
    EXPECT_NEAR(weights[i] * (clamped.point(kBladeT[i]).y - kBladeZ[i]) + stiffness * c[i], 0, 1e-9);
  EXPECT_NEAR(clamped.evaluate(kBladeT.front(), 1).d[1].y, 2, 1e-12);
  EXPECT_NEAR(clamped.evaluate(kBladeT.back(), 1).d[1].y, 2, 1e-12);
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

// Zavyalov et al. 1985, II.5, problem 7a: parabolas are found again from any of their points; of noise around a wave
// the coarse values keep less than its points have.
TEST(LocalSpline, MeansOfManyPoints) {
  const auto parabola = [](double t) { return Vec3(1e6 + t, 2 - t * t, 3 * t * t - t); };
  Points points;
  List t;
  for (int i = 0; i <= 40; ++i) t.push_back(0.1 * i + 0.02 * (i % 3)), points.push_back(parabola(t.back()));
  const List knots = {0, 0.7, 1.9, 3, t.back()};
  const Points values = local_means({points, t, false}, knots);
  for (size_t j = 0; j < knots.size(); ++j) EXPECT_LE(distance(values[j], parabola(knots[j])), 1e-9);

  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-0.3, 0.3);
  Points noisy;
  List angles, coarse;
  double noise = 0, left = 0;
  for (int i = 0; i <= 400; ++i) angles.push_back(kTwoPi * i / 400);
  for (int j = 0; j <= 16; ++j) coarse.push_back(kTwoPi * j / 16);
  for (int i = 0; i < 400; ++i) {
    const double off = uniform(random);
    noise += off * off / 400;
    noisy.push_back({std::cos(angles[i]), std::sin(angles[i]) + off, 0});
  }
  const Points means = local_means({noisy, angles, true}, coarse);
  ASSERT_EQ(means.size(), 16);
  for (int j = 0; j < 16; ++j) left += std::pow(means[j].y - std::sin(coarse[j]), 2) / 16;
  // The value of a parabola by 51 evenly spread points has 9/4 / 51 of their variance; the wave's own part is below it.
  EXPECT_LE(left, 3 * 9. / 4 / 51 * noise);
  for (int j = 0; j < 16; ++j) EXPECT_NEAR(means[j].x, std::cos(coarse[j]), 1e-3);
}

TEST(LocalSpline, RefusesMeansOfTooFewPoints) {
  const List t = {0, 1, 2, 3};
  EXPECT_THROW(local_means({Points(4, Vec3(0)), t, false}, List{0, 0.5, 1.5, 3}), FieldError);
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
