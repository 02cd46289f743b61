// Points by arc length, against curves whose length is known in closed form.
#include "geometry/queries/measures/arc_length.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/curves/analytic/polyline.h"
#include "geometry/curves/splines/bezier_curve.h"

namespace lekalo::geometry::arc_length_test {
namespace {

TEST(ArcLength, OfAPolyline) {
  const std::vector<Vec3> points{{0, 0, 0}, {3, 0, 0}, {3, 1, 0}};
  const auto curve = polyline(points);
  EXPECT_NEAR(parameter_at_fraction(curve, 0.5), 2.0 / 3, 1e-14);
  EXPECT_NEAR(parameter_at_fraction(curve, 0.875), 1.5, 1e-14);
  EXPECT_EQ(parameter_at_fraction(curve, 0), 0);
  EXPECT_EQ(parameter_at_fraction(curve, 1), 2);
}

// r = (2 t, t^2): the length from 0 to t is t sqrt(1 + t^2) + asinh t.
TEST(ArcLength, OfAParabola) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {2, 1, 0}};
  const auto curve = bezier_curve(points);
  const auto length = [](double t) { return t * std::sqrt(1 + t * t) + std::asinh(t); };
  for (const double t : {0.1, 0.3, 0.5, 0.9})
    EXPECT_NEAR(parameter_at_fraction(curve, length(t) / length(1)), t, 1e-13);
}

// r = (t^3, 0): the speed vanishes at the beginning, where Newton's steps leave the bracket.
TEST(ArcLength, WhereTheCurveRests) {
  const std::vector<Vec3> points{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {1, 0, 0}};
  const auto curve = bezier_curve(points);
  EXPECT_NEAR(parameter_at_fraction(curve, 0.001), 0.1, 1e-12);
}

TEST(ArcLength, NoneAtAll) {
  const std::vector<Vec3> points{{1, 2, 3}, {1, 2, 3}};
  EXPECT_THROW(parameter_at_fraction(bezier_curve(points), 0.5), std::invalid_argument);
}

}  // namespace
}  // namespace lekalo::geometry::arc_length_test
