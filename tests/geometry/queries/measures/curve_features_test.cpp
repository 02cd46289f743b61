// Features of curves whose places are known.
#include "geometry/queries/measures/curve_features.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/formula_curve.h"
#include "geometry/curves/analytic/polyline.h"

namespace lekalo::geometry::curve_features_test {
namespace {

using Kind = CurveFeature::Kind;

FormulaCurve formula(const std::array<std::string, 3>& point, const Interval& domain, bool closed = false) {
  return FormulaCurve(point_formulas(point, {"t"}, Coordinates::cartesian), domain, closed);
}

std::vector<double> places(const CurveFeatures& found, Kind kind) {
  std::vector<double> t;
  for (const CurveFeature& point : found.points)
    if (point.kind == kind) t.push_back(point.t);
  return t;
}

void expect_places(const CurveFeatures& found, Kind kind, const std::vector<double>& expected) {
  const std::vector<double> t = places(found, kind);
  ASSERT_EQ(t.size(), expected.size());
  for (size_t i = 0; i < t.size(); ++i) EXPECT_NEAR(t[i], expected[i], 1e-9);
}

TEST(CurveFeatures, Ellipse) {
  const CurveFeatures found = curve_features(Ellipse(Frame(), 3, 2));
  expect_places(found, Kind::vertex, {0, kPi / 2, kPi, 1.5 * kPi});
  expect_places(found, Kind::inflection, {});
  for (const CurveFeature& point : found.points)
    EXPECT_NEAR(point.curvature, std::abs(point.point.x) > 1 ? 0.75 : 2.0 / 9, 1e-14);
  EXPECT_NEAR(found.area->value, 6 * kPi, 1e-12);
  EXPECT_NEAR(*found.turning_number, 1, 1e-12);
  EXPECT_NEAR(found.total_curvature.value, kTwoPi, 1e-12);
  EXPECT_TRUE(curve_features(Circle(Frame(), 2)).points.empty());
}

TEST(CurveFeatures, Wave) {
  const CurveFeatures found = curve_features(formula({"t", "sin(t)", "0"}, {-1, 7}));
  expect_places(found, Kind::inflection, {0, kPi, kTwoPi});
  expect_places(found, Kind::vertex, {kPi / 2, 1.5 * kPi});
  EXPECT_FALSE(found.area);
  // The same wave in another plane, run backwards.
  expect_places(curve_features(formula({"-t", "-t", "sin(-t)"}, {-1, 7})), Kind::inflection, {0, kPi, kTwoPi});
}

TEST(CurveFeatures, CuspsAndRests) {
  expect_places(curve_features(formula({"t^2", "t^3", "0"}, {-1, 1})), Kind::cusp, {0});
  const CurveFeatures rest = curve_features(formula({"t^3", "t^4", "0"}, {-1, 1}));
  expect_places(rest, Kind::rest, {0});
  expect_places(rest, Kind::cusp, {});
  // The cardioid (Golovanov 2016, 2.1): its cusp is where it closes; area 6 pi a^2.
  const CurveFeatures heart =
      curve_features(formula({"2*(1 - cos(t))*cos(t)", "2*(1 - cos(t))*sin(t)", "0"}, {0, kTwoPi}, true));
  expect_places(heart, Kind::cusp, {0});
  expect_places(heart, Kind::vertex, {kPi});
  EXPECT_FALSE(heart.turning_number);
  EXPECT_NEAR(heart.area->value, 6 * kPi, 1e-11);
  EXPECT_NEAR(heart.total_curvature.value, 4 * kPi, 1e-9);
}

TEST(CurveFeatures, CurvesInSpace) {
  const double c = 0.5, k = 2 / (4 + c * c), torsion = c / (4 + c * c), length = 10 * std::sqrt(4 + c * c);
  const CurveFeatures helix = curve_features(formula({"2*cos(t)", "2*sin(t)", "0.5*t"}, {0, 10}));
  EXPECT_FALSE(helix.plane);
  EXPECT_TRUE(helix.points.empty());
  EXPECT_NEAR(helix.total_curvature.value, k * length, 1e-12);
  EXPECT_NEAR(helix.total_torsion->value, torsion * length, 1e-12);
  // k^2 of (t, t^2, t^3) is largest at 0.
  expect_places(curve_features(formula({"t", "t^2", "t^3"}, {-1, 2})), Kind::vertex, {0});
  expect_places(curve_features(formula({"t", "t^3", "t^4"}, {-1, 2})), Kind::inflection, {0});
}

TEST(CurveFeatures, CornersTurn) {
  const std::vector<Vec3> square{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}};
  const CurveFeatures found = curve_features(polyline(square, true));
  expect_places(found, Kind::corner, {0, 1, 2, 3});
  for (const CurveFeature& corner : found.points) EXPECT_NEAR(corner.angle, -kPi / 2, 1e-14);
  EXPECT_NEAR(found.total_curvature.value, kTwoPi, 1e-12);
}

TEST(CurveFeatures, WindingNumbers) {
  const FormulaCurve eight = formula({"sin(t)", "sin(2*t)", "0"}, {0, kTwoPi}, true);
  EXPECT_EQ(winding_number(eight, {0.5, 0, 0}), -1);
  EXPECT_EQ(winding_number(eight, {-0.5, 0, 0}), 1);
  EXPECT_EQ(winding_number(eight, {0, 0.5, 0}), 0);
  EXPECT_NEAR(*curve_features(eight).turning_number, 0, 1e-12);
  const FormulaCurve snail = formula({"(1 + 2*cos(t))*cos(t)", "(1 + 2*cos(t))*sin(t)", "0"}, {0, kTwoPi}, true);
  EXPECT_EQ(winding_number(snail, {0.5, 0, 0}), 2);
  EXPECT_EQ(winding_number(snail, {2, 0.5, 0}), 1);
  EXPECT_NEAR(*curve_features(snail).turning_number, 2, 1e-12);
  EXPECT_THROW(winding_number(eight, {0, 0, 1}), std::invalid_argument);
  EXPECT_THROW(winding_number(eight, {0, 0, 0}), std::invalid_argument);
  EXPECT_THROW(winding_number(formula({"t", "sin(t)", "0"}, {-1, 7}), {0, 0, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace lekalo::geometry::curve_features_test
