// Least squares: interpolation where there is no choice, optimality, tolerances, moving parameters.
#include "geometry/curves/interpolation/fit_curve.h"

#include "geometry/curves/curve_checks.h"
#include "geometry/curves/interpolation/lagrange_curve.h"
#include "geometry/curves/interpolation/point_parameters.h"

namespace lekalo::geometry::fit_curve_test {
namespace {

using checks::distance;
using Points = std::vector<Vec3>;
using List = std::vector<double>;

struct Data {
  Points points;
  List parameters;
  PointSequence sequence(bool closed = false) const { return {points, parameters, closed}; }
};

// Points near a wave, closed with its last parameter.
Data noisy(int count, double noise, bool closed) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(-noise, noise);
  Data data;
  for (int i = 0; i < count + (closed ? 1 : 0); ++i) data.parameters.push_back(kTwoPi * i / count);
  for (int i = 0; i < count; ++i) {
    const double t = data.parameters[i];
    data.points.push_back({std::cos(t) + uniform(random), 2 * std::sin(t) + uniform(random), std::sin(2 * t)});
  }
  return data;
}

double sum_of_squares(const NurbsCurve& curve, const Data& data) {
  double sum = 0;
  for (size_t i = 0; i < data.points.size(); ++i)
    sum += std::pow(distance(curve.point(data.parameters[i]), data.points[i]), 2);
  return sum;
}

// Zavyalov et al. 1985, I.1: as many points as coefficients.
TEST(FitCurve, OfAsManyPointsAsCoefficientsInterpolates) {
  const Data data{{{0, 0, 0}, {1, 2, 0}, {3, 3, 1}, {4, 0, 0}, {6, 1, 2}}, {0, 1, 1.5, 3, 4}};
  const NurbsCurve fit = fit_curve(data.sequence(), {}, {.degree = 4});
  const NurbsCurve exact = lagrange_curve(data.points, data.parameters);
  for (int i = 0; i <= 40; ++i) EXPECT_LE(distance(fit.point(0.1 * i), exact.point(0.1 * i)), 2e-14);
}

TEST(FitCurve, HasTheSmallestSum) {
  for (const bool closed : {false, true}) {
    const Data data = noisy(60, 0.1, closed);
    const NurbsCurve fit = fit_curve(data.sequence(closed), even_knots(data.sequence(closed), 6), {});
    const double smallest = sum_of_squares(fit, data);
    for (int i = 0; i < fit.axis().distinct(); ++i) {
      Points control;
      for (int j = 0; j < fit.axis().distinct(); ++j) control.push_back(Vec3(fit.points()[j]));
      double sums[2];
      for (const int side : {0, 1}) {
        Points moved = control;
        moved[i].y += side == 0 ? 1e-3 : -1e-3;
        sums[side] = sum_of_squares(NurbsCurve(fit.axis(), moved), data);
        EXPECT_GT(sums[side], smallest);
      }
      EXPECT_NEAR(sums[0], sums[1], 1e-12);
    }
    EXPECT_EQ(fit.period() > 0, closed);
    checks::check_pieces(fit);
  }
}

TEST(FitCurve, KeepsToItsTolerance) {
  for (const bool closed : {false, true})
    for (const double tolerance : {0.3, 0.1, 1e-3, 1e-6}) {
      const Data data = noisy(200, 0, closed);
      const NurbsCurve fit = fit_within(data.sequence(closed), tolerance, {});
      for (size_t i = 0; i < data.points.size(); ++i)
        EXPECT_LE(distance(fit.point(data.parameters[i]), data.points[i]), tolerance);
      if (tolerance > 1e-4) {
        EXPECT_LT(fit.axis().distinct(), 40) << tolerance;
      }
    }
}

TEST(FitCurve, StiffnessDrawsItStraight) {
  const Data data = noisy(40, 0.1, false);
  const NurbsCurve fit = fit_curve(data.sequence(), even_knots(data.sequence(), 8), {.stiffness = 1e12});
  for (const double t : {0.3, 2., 5.}) EXPECT_LE(glm::length(fit.evaluate(t, 2).d[2]), 1e-9);
}

// Zavyalov et al. 1985, II.5e: chord lengths of points of a circle with uneven steps are not its angles.
TEST(FitCurve, MovingParametersBringsItNearer) {
  Points points;
  for (int i = 0; i <= 24; ++i) {
    const double angle = 4.5 * std::pow(i / 24., 1.7);
    points.push_back({std::cos(angle), std::sin(angle), 0});
  }
  const List uniform = point_parameters({"uniform", {}}, points, false);
  const PointSequence data{points, uniform, false};
  const List knots = even_knots(data, 4);
  const auto radial = [&](const NurbsCurve& curve) {
    double worst = 0;
    for (int i = 0; i <= 400; ++i) worst = std::max(worst, std::abs(glm::length(curve.point(0.06 * i)) - 1));
    return worst;
  };
  const double before = radial(fit_curve(data, knots, {})), after = radial(fit_curve(data, knots, {.passes = 200}));
  EXPECT_LT(after, 0.5 * before);
}

TEST(FitCurve, RefusesWhatPointsDoNotDetermine) {
  const Data data{{{0, 0, 0}, {1, 2, 0}, {3, 3, 1}, {4, 0, 0}}, {0, 1, 1.5, 3}};
  try {
    fit_curve(data.sequence(), {0.5, 1.2}, {});
    FAIL();
  } catch (const FieldError& error) {
    EXPECT_STREQ(error.what(), "4 points do not determine a spline of degree 3 with 6 control points");
  }
}

}  // namespace
}  // namespace lekalo::geometry::fit_curve_test
