// Rims of sheets: curves whose answer is known by how they are made.
#include "geometry/queries/intersections/sheet_rim.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/curves/analytic/formula_curve.h"
#include "geometry/describe.h"

namespace lekalo::geometry::sheet_rim_test {
namespace {

FormulaCurve closed_curve(const std::string& x, const std::string& y) {
  return FormulaCurve(point_formulas({x, y, "0"}, {"t"}, Coordinates::cartesian), Interval(0, kTwoPi), true);
}

// The image of a disc under z + a z^n with n a < 1 is one-to-one, with n a > 1 it folds.
TEST(SheetRim, ImagesOfDiscsUnderPolynomials) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0.1, 0.9);
  for (int n = 2; n <= 5; ++n)
    for (int sample = 0; sample < 3; ++sample) {
      const std::string a = std::to_string(uniform(random) / n), k = std::to_string(n);
      const SheetRim found =
          sheet_rim(closed_curve("cos(t) + " + a + "*cos(" + k + "*t)", "sin(t) + " + a + "*sin(" + k + "*t)"));
      EXPECT_EQ(found.turning_number, 1);
      EXPECT_EQ(found.crossings, 0);
      EXPECT_TRUE(found.is_rim);
    }
}

// z^2 about 1.2 in a disc that does not hold the branch point 0 is locally one-to-one; about 0.6 it holds it.
TEST(SheetRim, SquareOfADisc) {
  const auto square_of_disc = [](const std::string& center) {
    const std::string x = "(" + center + " + cos(t))", y = "sin(t)";
    return sheet_rim(closed_curve(x + "^2 - " + y + "^2", "2*" + x + "*" + y));
  };
  EXPECT_EQ(square_of_disc("1.2").turning_number, 1);
  EXPECT_TRUE(square_of_disc("1.2").is_rim);
  EXPECT_EQ(square_of_disc("0.6").turning_number, 2);
  EXPECT_FALSE(square_of_disc("0.6").is_rim);
}

// exp maps discs of any radius locally one-to-one: above pi the image covers itself.
TEST(SheetRim, ExponentialOfADiscCoversItself) {
  const auto exponential = [](const std::string& radius) {
    const std::string x = radius + "*cos(t)", y = radius + "*sin(t)";
    return sheet_rim(closed_curve("exp(0.2*" + x + ")*cos(" + y + ")", "exp(0.2*" + x + ")*sin(" + y + ")"));
  };
  const SheetRim small = exponential("2.5"), large = exponential("4");
  EXPECT_EQ(small.crossings, 0);
  EXPECT_TRUE(small.is_rim);
  EXPECT_GT(large.crossings, 0);
  EXPECT_EQ(large.turning_number, 1);
  EXPECT_TRUE(large.is_rim);
}

TEST(SheetRim, RefusesWhatHasNoAnswer) {
  const FormulaCurve open(point_formulas({"t", "t^2", "0"}, {"t"}, Coordinates::cartesian), Interval(0, 1), false);
  EXPECT_THROW(sheet_rim(open), std::invalid_argument);
  const FormulaCurve twice = closed_curve("cos(2*t)", "sin(2*t)");
  EXPECT_THROW(sheet_rim(twice), std::invalid_argument);
}

}  // namespace
}  // namespace lekalo::geometry::sheet_rim_test
