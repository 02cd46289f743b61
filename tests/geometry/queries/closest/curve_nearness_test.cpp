// Hausdorff's and Frechet's distance: closed forms, and brackets against brute force on dense samples.
#include "geometry/queries/closest/curve_nearness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/formula_curve.h"
#include "geometry/curves/analytic/polyline.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/splines/bezier_curve.h"

namespace lekalo::geometry::curve_nearness_test {
namespace {

CurvePtr segment(const Vec3& a, const Vec3& b) { return std::make_shared<Segment>(a, b); }

CurvePtr circle(const Vec3& center, double radius) {
  Frame frame;
  frame.origin = center;
  return std::make_shared<Circle>(frame, radius);
}

CurvePtr formula(const std::array<std::string, 3>& point, const Interval& domain) {
  return std::make_shared<FormulaCurve>(point_formulas(point, {"t"}, Coordinates::cartesian), domain);
}

template <class Bracket>
void expect_bracket(const Bracket& found, double expected) {
  EXPECT_LE(found.lower, expected * (1 + 1e-14));
  EXPECT_GE(found.upper, expected * (1 - 1e-14));
  EXPECT_LE(found.upper - found.lower, kNearness * found.upper);
}

// Circles of radii R, r at the distance c: c + |R - r| (Zavyalov et al. 1985, II.2).
TEST(HausdorffDistance, ClosedForms) {
  expect_bracket(hausdorff_distance(circle({0, 0, 0}, 1), circle({0.2, 0, 0}, 0.5)), 0.7);
  expect_bracket(hausdorff_distance(circle({0, 0, 0}, 2), circle({0, 0.3, 0}, 2)), 0.3);
  expect_bracket(hausdorff_distance(circle({0, 0, 0}, 1), circle({0, 0, 0}, 1.1)), 0.1);
  // A segment below the middle of another: the farther of its end and of the ends of the other.
  const CurvePtr bar = segment({-2, 0, 0}, {2, 0, 0});
  expect_bracket(hausdorff_distance(bar, segment({0, -1, 0}, {0, -3, 0})), 3);
  expect_bracket(hausdorff_distance(bar, segment({0, -1, 0}, {0, -1.2, 0})), std::sqrt(5.0));
  expect_bracket(hausdorff_distance(segment({0, 1, 0}, {5, 1, 0}), segment({0.5, 0, 0}, {4, 0, 0})), std::sqrt(2.0));
}

// A circle about the corner of a polyline: a quarter of it is as far from the corner.
TEST(HausdorffDistance, AboutACorner) {
  const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  expect_bracket(hausdorff_distance(std::make_shared<NurbsCurve>(polyline(square, true)), circle({0, 0, 0}, 1)), 1);
}

TEST(HausdorffDistance, CurvesThatJump) {
  EXPECT_THROW(hausdorff_distance(circle({0, 0, 0}, 1), formula({"t", "floor(t)", "0"}, {0, 2.5})),
               std::invalid_argument);
}

TEST(HausdorffDistance, OfACurveFromItself) {
  const HausdorffDistance found = hausdorff_distance(circle({0, 0, 0}, 1), circle({0, 0, 0}, 1));
  EXPECT_LT(found.upper, 1e-6);
}

std::vector<Vec3> samples(const Curve& curve, int count) {
  std::vector<Vec3> points;
  for (int k = 0; k <= count; ++k)
    points.push_back(curve.point(curve.domain().lo + curve.domain().width() * k / count));
  return points;
}

double directed(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double largest = 0;
  for (const Vec3& p : a) {
    double least = kInfinity;
    for (const Vec3& q : b) least = std::min(least, glm::length(p - q));
    largest = std::max(largest, least);
  }
  return largest;
}

// Of points one after another (Eiter, Mannila 1994): not less than that of the curves, and more by a step at most.
double discrete_frechet(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  std::vector<double> row(b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    double diagonal = row[0];
    for (size_t j = 0; j < b.size(); ++j) {
      const double d = glm::length(a[i] - b[j]), above = row[j];
      const double before = i == 0 && j == 0 ? 0
                            : i == 0         ? row[j - 1]
                            : j == 0         ? above
                                             : std::min({above, row[j - 1], diagonal});
      diagonal = above;
      row[j] = std::max(d, before);
    }
  }
  return row.back();
}

CurvePtr random_curve(std::mt19937& random) {
  std::uniform_real_distribution<double> coordinate(-1, 1);
  std::vector<Vec3> points;
  for (int i = 0; i < 5; ++i) points.emplace_back(coordinate(random), coordinate(random), coordinate(random));
  return std::make_shared<NurbsCurve>(bezier_curve(points));
}

TEST(CurveNearness, BracketsAgreeWithBruteForce) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 8; ++trial) {
    const CurvePtr a = random_curve(random), b = random_curve(random);
    const std::vector<Vec3> p = samples(*a, 1500), q = samples(*b, 1500);
    const double step = 0.02;
    const HausdorffDistance hausdorff = hausdorff_distance(a, b);
    const double sampled = std::max(directed(p, q), directed(q, p));
    EXPECT_LE(hausdorff.lower, sampled + step);
    EXPECT_GE(hausdorff.upper, sampled - step);
    EXPECT_LE(hausdorff.upper - hausdorff.lower, kNearness * hausdorff.upper);
    EXPECT_NEAR(glm::length(hausdorff.point - hausdorff.nearest), hausdorff.lower, 1e-12);
    const Nearness frechet = frechet_distance(*a, *b);
    const double discrete = discrete_frechet(p, q);
    EXPECT_LE(frechet.lower, discrete);
    EXPECT_GE(frechet.upper, discrete - step);
    EXPECT_LE(frechet.upper - frechet.lower, 3 * kNearness * frechet.upper);
    EXPECT_GE(frechet.upper, hausdorff.lower);
  }
}

// Zavyalov et al. 1985, II.2: the same loop run twice in two ways has the Hausdorff distance 0 and that of Frechet is
// its width.
TEST(FrechetDistance, ClosedForms) {
  const CurvePtr bar = segment({-2, 0, 0}, {2, 0, 0});
  expect_bracket(frechet_distance(*bar, *segment({0, -1, 0}, {0, -3, 0})), std::sqrt(13.0));
  expect_bracket(frechet_distance(*bar, *segment({2, 1, 0}, {-2, 1, 0})), std::sqrt(17.0));
  const CurvePtr one = formula({"cos(t)", "sin(t)", "0"}, {0, kTwoPi}),
                 back = formula({"cos(t)", "-sin(t)", "0"}, {0, kTwoPi});
  EXPECT_LT(hausdorff_distance(one, back).upper, 1e-6);
  expect_bracket(frechet_distance(*one, *back), 2);
}

}  // namespace
}  // namespace lekalo::geometry::curve_nearness_test
