// Fewer knots and lower degrees: what was elevated or refined is found again; the bound holds against samples.
#include "geometry/curves/splines/spline_reduction.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/curves/splines/nurbs_operations.h"
#include "geometry/curves/splines/periodic_curve.h"

namespace lekalo::geometry::spline_reduction_test {
namespace {

NurbsCurveForm random_form(std::mt19937& random, int degree, int spans, bool rational) {
  std::uniform_real_distribution<double> coordinate(-2, 2), weight(0.5, 2), step(0.2, 1.5);
  NurbsCurveForm form{degree, std::vector<double>(static_cast<size_t>(degree) + 1, 0.0), {}, {}};
  for (int k = 1; k < spans; ++k) form.knots.push_back(form.knots.back() + step(random));
  form.knots.insert(form.knots.end(), static_cast<size_t>(degree) + 1, form.knots.back() + step(random));
  for (size_t i = 0; i + static_cast<size_t>(degree) + 1 < form.knots.size(); ++i) {
    const double w = rational ? weight(random) : 1;
    form.points.emplace_back(w * coordinate(random), w * coordinate(random), w * coordinate(random), w);
  }
  return form;
}

double largest_seen(const NurbsCurveForm& a, const NurbsCurveForm& b) {
  const NurbsCurve one(a), other(b);
  double largest = 0;
  for (int k = 0; k <= 500; ++k) {
    const double t = a.domain().lo + a.domain().width() * k / 500;
    largest = std::max(largest, glm::length(one.point(t) - other.point(t)));
  }
  return largest;
}

TEST(SplineReduction, FindsAgainWhatWasThere) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 12; ++trial) {
    const NurbsCurveForm form = random_form(random, 1 + trial % 4, 4, trial % 2);
    const ReducedCurve lower = reduced_degree(elevate_degree(form, 2), form.degree);
    EXPECT_EQ(lower.form.knots, form.knots);
    EXPECT_LT(lower.bound, 1e-12);
    EXPECT_LT(largest_seen(form, lower.form), 1e-12);
    const double t = 0.3 * form.domain().hi;
    const NurbsCurveForm refined = insert_knot(form, t, form.degree);
    const std::vector<double> added(static_cast<size_t>(form.degree), t);
    const ReducedCurve fewer = without_knots(refined, added);
    EXPECT_EQ(fewer.form.knots, form.knots);
    EXPECT_LT(fewer.bound, 1e-12);
    EXPECT_EQ(with_fewest_knots(refined, 1e-9).form.knots, form.knots);
  }
}

TEST(SplineReduction, BoundsHold) {
  std::mt19937 random(6);
  for (int trial = 0; trial < 12; ++trial) {
    const NurbsCurveForm form = random_form(random, 3, 5, trial % 2);
    for (const ReducedCurve& reduced :
         {reduced_degree(form, 2), without_knots(form, std::vector<double>{form.knots[5]}),
          with_fewest_knots(form, 1)}) {
      const double seen = largest_seen(form, reduced.form);
      EXPECT_GE(reduced.bound * (1 + 1e-12), seen);
      EXPECT_LT(reduced.bound, 30 * seen + 1e-12);
      EXPECT_LT(glm::length(NurbsCurve(form).point(0) - NurbsCurve(reduced.form).point(0)), 1e-13);
    }
    EXPECT_LE(with_fewest_knots(form, 0.1).bound, 0.1);
  }
  EXPECT_THROW(without_knots(random_form(random, 3, 3, false), std::vector<double>{0.123}), std::invalid_argument);
}

NurbsCurve closed_curve(std::mt19937& random, int degree) {
  std::uniform_real_distribution<double> coordinate(-2, 2), step(0.2, 1.5);
  const int n = 6;
  std::vector<double> knots{0};
  for (int k = 0; k < n; ++k) knots.push_back(knots.back() + step(random));
  const double period = knots.back();
  while (static_cast<int>(knots.size()) < n + 2 * degree + 1) knots.push_back(knots[knots.size() - n] + period);
  std::vector<Vec3> points;
  for (int k = 0; k < n; ++k) points.emplace_back(coordinate(random), coordinate(random), coordinate(random));
  return NurbsCurve(SplineAxis(degree, knots, Extension::periodic), points);
}

TEST(PeriodicCurve, OperationsKeepThePeriod) {
  std::mt19937 random(7);
  for (const int degree : {1, 2, 3, 5}) {
    const NurbsCurve curve = closed_curve(random, degree);
    EXPECT_TRUE(is_whole_period(curve));
    const double t = curve.domain().lo + 0.37 * curve.domain().width();
    const NurbsCurve refined = in_every_period(curve, [&](NurbsCurveForm form) {
      for (int turn = -1; turn <= 1; ++turn) form = insert_knot(form, t + turn * curve.period());
      return form;
    });
    const NurbsCurve elevated = in_every_period(curve, [](const NurbsCurveForm& form) { return elevate_degree(form); });
    const NurbsCurve seamed = periodic_curve(clamped_part(*curve.as_nurbs(), curve.domain()));
    EXPECT_EQ(refined.axis().distinct(), curve.axis().distinct() + 1);
    EXPECT_EQ(elevated.axis().distinct(), 2 * curve.axis().distinct());
    EXPECT_EQ(seamed.axis().distinct(), curve.axis().distinct() + degree - 1);
    for (const NurbsCurve* same : {&refined, &elevated, &seamed}) {
      EXPECT_TRUE(is_whole_period(*same));
      EXPECT_NEAR(same->period(), curve.period(), 1e-14 * curve.period());
      for (double x = curve.domain().lo - 1; x < curve.domain().hi + 1; x += 0.171)
        EXPECT_LT(glm::length(same->point(x) - curve.point(x)), 1e-13) << degree << " " << x;
    }
  }
}

TEST(PeriodicCurve, NeedsEndsThatMeet) {
  const NurbsCurveForm open{1, {0, 0, 1, 1}, {{0, 0, 0, 1}, {1, 0, 0, 1}}, {}};
  EXPECT_THROW(periodic_curve(open), std::invalid_argument);
}

}  // namespace
}  // namespace lekalo::geometry::spline_reduction_test
