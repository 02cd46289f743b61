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

// The largest jump of the second derivative at knots.
double largest_jump(const NurbsCurve& curve, const List& knots) {
  double largest = 0;
  for (const double t : knots) {
    const double before = curve.domain().lo == t ? curve.domain().hi : t;
    largest =
        std::max(largest, glm::length(curve.evaluate(t, 2).d[2] - curve.evaluate(std::nextafter(before, -1), 2).d[2]));
  }
  return largest;
}

// Zavyalov et al. 1985, II.5, problem 7b: with large weights of the jumps the spline of class C2, with none the best of
// class C1; between them the sum of squares and jumps is smallest.
TEST(FitCurve, WeighsJumpsOfTheSecondDerivative) {
  for (const bool closed : {false, true}) {
    const Data data = noisy(60, 0.1, closed);
    const List knots = even_knots(data.sequence(closed), 5);
    const NurbsCurve smooth = fit_curve(data.sequence(closed), knots, {});
    const NurbsCurve stiff = fit_curve(data.sequence(closed), knots, {.jump_weights = {1e10}});
    for (double t = 0; t < 6; t += 0.25) EXPECT_LE(distance(stiff.point(t), smooth.point(t)), 1e-8);
    double last_sum = 0, last_jump = kInfinity;
    for (const double weight : {0., 1e-3, 0.1, 10.}) {
      const NurbsCurve fit = fit_curve(data.sequence(closed), knots, {.jump_weights = {weight}});
      EXPECT_GE(sum_of_squares(fit, data), last_sum - 1e-13);
      EXPECT_LE(largest_jump(fit, knots), last_jump + 1e-9);
      last_sum = sum_of_squares(fit, data), last_jump = largest_jump(fit, knots);
      for (const double t : knots) {
        const double before = std::nextafter(fit.domain().lo == t ? fit.domain().hi : t, -1);
        EXPECT_LE(glm::length(fit.evaluate(t, 1).d[1] - fit.evaluate(before, 1).d[1]), 1e-11);
      }
      EXPECT_EQ(fit.axis().distinct(), closed ? 10 : 12);
      checks::check_pieces(fit);
    }
  }
}

// The gradient of the sum of squares and weighted jumps vanishes: a control point moved either way makes it larger.
TEST(FitCurve, WithWeightedJumpsHasTheSmallestSum) {
  for (const bool closed : {false, true}) {
    const Data data = noisy(40, 0.2, closed);
    const List knots = even_knots(data.sequence(closed), 4);
    List weights;
    for (size_t j = 0; j < knots.size(); ++j) weights.push_back(0.02 * (j + 1));
    const NurbsCurve fit = fit_curve(data.sequence(closed), knots, {.jump_weights = weights});
    const auto sum = [&](const NurbsCurve& curve) {
      double all = sum_of_squares(curve, data);
      for (size_t j = 0; j < knots.size(); ++j) all += weights[j] * std::pow(largest_jump(curve, {knots[j]}), 2);
      return all;
    };
    for (int i = 0; i < fit.axis().distinct(); ++i) {
      double sums[2];
      for (const int side : {0, 1}) {
        Points moved;
        for (int j = 0; j < fit.axis().distinct(); ++j) moved.push_back(Vec3(fit.points()[j]));
        moved[i].x += side == 0 ? 1e-3 : -1e-3;
        sums[side] = sum(NurbsCurve(fit.axis(), moved));
        EXPECT_GT(sums[side], sum(fit));
      }
      EXPECT_NEAR(sums[0], sums[1], 1e-10);
    }
  }
}

TEST(FitCurve, RefusesJumpWeightsThatDoNotFit) {
  const Data data = noisy(40, 0.1, false);
  const auto refuses = [&](const FitOptions& options) {
    EXPECT_THROW(fit_curve(data.sequence(), {1, 2, 3}, options), FieldError);
  };
  refuses({.degree = 4, .jump_weights = {1}});
  refuses({.jump_weights = {1, 2}});
  refuses({.jump_weights = {1, 2, -1}});
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
