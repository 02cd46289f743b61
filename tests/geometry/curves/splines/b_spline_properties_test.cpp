// Properties of B-spline curves on random ones (Piegl, Tiller 1997, 3.2).
#include <gtest/gtest.h>

#include <random>

#include "geometry/curves/splines/nurbs_curve.h"

namespace lekalo::geometry::b_spline_properties_test {
namespace {

struct RandomCurve {
  int degree;
  std::vector<double> knots;
  std::vector<Vec3> points;

  explicit RandomCurve(std::mt19937_64& random) {
    std::uniform_real_distribution<double> uniform(0, 1);
    degree = 1 + static_cast<int>(random() % 4);
    const int count = degree + 1 + static_cast<int>(random() % 6);
    knots.assign(degree + 1, 0);
    // Inner knots stand once, or as often as leaves the curve in one piece.
    for (int left = count - degree - 1; left > 0;) {
      const double knot = knots.back() + 0.2 + uniform(random);
      for (int times = 1 + static_cast<int>(random() % degree); times > 0 && left > 0; --times, --left)
        knots.push_back(knot);
    }
    knots.insert(knots.end(), degree + 1, knots.back() + 0.5);
    for (int i = 0; i < count; ++i) points.emplace_back(uniform(random), uniform(random), 0);
  }
  NurbsCurve curve() const { return NurbsCurve(SplineAxis(degree, knots, Extension::tangent), points); }
};

int sign_changes(const std::vector<double>& values) {
  int changes = 0;
  double last = 0;
  for (const double x : values) {
    if (x == 0) continue;
    if (last * x < 0) ++changes;
    last = x;
  }
  return changes;
}

TEST(BSplineProperties, NoLineMeetsTheCurveMoreOftenThanThePolygon) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int n = 0; n < 60; ++n) {
    const RandomCurve of(random);
    const NurbsCurve curve = of.curve();
    for (int line = 0; line < 20; ++line) {
      const double angle = 2 * kPi * uniform(random);
      const Vec3 across(std::cos(angle), std::sin(angle), 0), through(uniform(random), uniform(random), 0);
      std::vector<double> of_curve, of_polygon;
      for (const Vec3& p : of.points) of_polygon.push_back(glm::dot(across, p - through));
      for (int k = 0; k <= 500; ++k)
        of_curve.push_back(
            glm::dot(across, curve.point(curve.domain().lo + curve.domain().width() * k / 500) - through));
      EXPECT_LE(sign_changes(of_curve), sign_changes(of_polygon));
    }
  }
}

// In any direction the curve over a span goes no farther than its degree + 1 control points.
TEST(BSplineProperties, ASpanLiesInTheHullOfItsPoints) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int n = 0; n < 60; ++n) {
    const RandomCurve of(random);
    const NurbsCurve curve = of.curve();
    for (size_t span = of.degree; span + of.degree + 1 < of.knots.size(); ++span) {
      const double lo = of.knots[span], hi = of.knots[span + 1];
      for (int k = 0; k < 20 && lo < hi; ++k) {
        const double angle = 2 * kPi * uniform(random);
        const Vec3 along(std::cos(angle), std::sin(angle), 0);
        double farthest = -kInfinity;
        for (size_t i = span - of.degree; i <= span; ++i) farthest = std::max(farthest, glm::dot(along, of.points[i]));
        EXPECT_LE(glm::dot(along, curve.point(lo + (hi - lo) * uniform(random))), farthest + 1e-14);
      }
    }
  }
}

TEST(BSplineProperties, AControlPointMovesTheCurveBetweenItsKnotsOnly) {
  std::mt19937_64 random(5);
  for (int n = 0; n < 60; ++n) {
    RandomCurve of(random);
    const NurbsCurve before = of.curve();
    const size_t i = random() % of.points.size();
    of.points[i] += Vec3(0.3, -0.4, 0);
    const NurbsCurve after = of.curve();
    for (int k = 0; k <= 200; ++k) {
      const double t = before.domain().lo + before.domain().width() * k / 200;
      const double moved = glm::length(after.point(t) - before.point(t));
      if (t < of.knots[i] || t > of.knots[i + of.degree + 1]) {
        EXPECT_EQ(moved, 0);
      } else if (t > of.knots[i] && t < of.knots[i + of.degree + 1]) {
        EXPECT_GT(moved, 0);
      }
    }
  }
}

}  // namespace
}  // namespace lekalo::geometry::b_spline_properties_test
