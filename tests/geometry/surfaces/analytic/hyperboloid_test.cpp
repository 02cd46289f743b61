#include "geometry/surfaces/analytic/hyperboloid.h"

#include "geometry/surfaces/analytic_formulas.h"

namespace lekalo::geometry::hyperboloid_test {
namespace {

using checks::distance;
using checks::kSkewFrame;

const Vec3 kAxes(2, 1, 1.5);
const Rectangle kPart{{0, kTwoPi}, {-1.5, 2}};

TEST(HyperboloidOneSheet, DerivativesEqualThoseOfTheFormulaIn113Bits) {
  const auto formula = checks::placed(kSkewFrame, [](auto u, auto v) {
    return Triple{Quad(2) * cosh(v) * cos(u), Quad(1) * cosh(v) * sin(u), Quad(1.5) * sinh(v)};
  });
  checks::check_derivatives(HyperboloidOneSheet(kSkewFrame, kAxes, kPart), formula, {{-7, 7}, {-3, 3}});
}

TEST(HyperboloidOneSheet, MeetsTheGeneralChecks) {
  checks::check_surface(HyperboloidOneSheet(kSkewFrame, kAxes, kPart));
  checks::check_surface(HyperboloidOneSheet(kSkewFrame, {0.01, 0.02, 1}, {{2, 4}, {1, 1.25}}));
  const HyperboloidOneSheet unbounded(kSkewFrame, kAxes, HyperboloidOneSheet::kUnbounded);
  EXPECT_FALSE(unbounded.bounded());
  checks::check_line_hits(unbounded, kPart);
}

// Golovanov 2016, 3.2: a, b, c = 2, 1, 1.5 at u = 0.5, v = 0.3; K at the waist -a^2/(b^2 c^2).
TEST(HyperboloidOneSheet, HasTheValuesOfTheTextbook) {
  const HyperboloidOneSheet surface(Frame(), kAxes, kPart);
  EXPECT_LE(distance(surface.point(0.5, 0.3), {1.834741702543762, 0.501161980159946, 0.456780440170714}), 2e-15);
  EXPECT_LE(distance(surface.normal(0.5, 0.3), {0.646889648136434, 0.706794850862215, -0.286312455070647}), 2e-15);
  const auto c = checks::curvatures(surface, 0.5, 0.3);
  EXPECT_NEAR(c.mean, -0.167695494220515, 1e-14);
  EXPECT_NEAR(c.gaussian, -0.439560371906354, 1e-14);
  EXPECT_NEAR(checks::curvatures(surface, 0, 0).gaussian, -16.0 / 9, 1e-14);
}

TEST(HyperboloidTwoSheets, DerivativesEqualThoseOfTheFormulaIn113Bits) {
  const auto formula = checks::placed(kSkewFrame, [](auto u, auto v) {
    return Triple{Quad(2) * sinh(v) * cos(u), Quad(1) * sinh(v) * sin(u), Quad(1.5) * cosh(v)};
  });
  checks::check_derivatives(HyperboloidTwoSheets(kSkewFrame, kAxes, HyperboloidTwoSheets::kUnbounded), formula,
                            {{-7, 7}, {-3, 3}});
}

TEST(HyperboloidTwoSheets, MeetsTheGeneralChecks) {
  checks::check_surface(HyperboloidTwoSheets(kSkewFrame, kAxes, {{0, kTwoPi}, {0, 2}}));
  checks::check_surface(HyperboloidTwoSheets(kSkewFrame, {2, 1, -1.5}, {{-1, 2}, {0.25, 0.5}}));
  const HyperboloidTwoSheets unbounded(kSkewFrame, kAxes, HyperboloidTwoSheets::kUnbounded);
  checks::check_line_hits(unbounded, {{0, kTwoPi}, {0, 2.5}});
}

// Golovanov 2016, 3.2; the normal at the vertex is downward on the upper sheet.
TEST(HyperboloidTwoSheets, HasTheValuesOfTheTextbook) {
  const HyperboloidTwoSheets surface(Frame(), kAxes, {{0, kTwoPi}, {0, 2}});
  EXPECT_LE(distance(surface.point(0.5, 0.3), {0.534483398541903, 0.145994805701806, 1.568007771193291}), 2e-15);
  EXPECT_LE(distance(surface.normal(0.5, 0.3), {0.184444517339792, 0.201524998121529, -0.961960443654212}), 2e-15);
  const auto c = checks::curvatures(surface, 0.5, 0.3);
  EXPECT_NEAR(c.mean, -0.805930526120679, 1e-13);
  EXPECT_NEAR(c.gaussian, 0.403388558430077, 1e-13);
  EXPECT_EQ(surface.normal(1, 0), Vec3(0, 0, -1));
}

// The axis meets each sheet once, at its vertex.
TEST(HyperboloidTwoSheets, SheetsAreApart) {
  LineHits upper, lower;
  const Line axis{{0, 0, -7}, {0, 0, 1}};
  HyperboloidTwoSheets(Frame(), kAxes, HyperboloidTwoSheets::kUnbounded).line_hits(axis, Interval::entire(), upper);
  HyperboloidTwoSheets(Frame(), {2, 1, -1.5}, HyperboloidTwoSheets::kUnbounded)
      .line_hits(axis, Interval::entire(), lower);
  ASSERT_EQ(upper.size(), 1);
  ASSERT_EQ(lower.size(), 1);
  EXPECT_DOUBLE_EQ(upper[0].t, 8.5);
  EXPECT_DOUBLE_EQ(lower[0].t, 5.5);
}

}  // namespace
}  // namespace lekalo::geometry::hyperboloid_test
