#include "geometry/surfaces/analytic/ellipsoid.h"

#include "geometry/surfaces/analytic_formulas.h"

namespace lekalo::geometry::ellipsoid_test {
namespace {

using checks::distance;
using checks::kSkewFrame;

TEST(Ellipsoid, DerivativesEqualThoseOfTheFormulaIn113Bits) {
  const auto formula = checks::placed(kSkewFrame, [](auto u, auto v) {
    return Triple{Quad(3) * cos(v) * cos(u), Quad(2) * cos(v) * sin(u), Quad(0.5) * sin(v)};
  });
  checks::check_derivatives(Ellipsoid(kSkewFrame, {3, 2, 0.5}), formula, {{-7, 7}, {-1.5, 1.5}});
}

TEST(Ellipsoid, MeetsTheGeneralChecks) {
  checks::check_surface(Ellipsoid(kSkewFrame, {3, 2, 1}), {.closed = true});
  checks::check_surface(Ellipsoid(kSkewFrame, {1, 0.02, 5}), {.closed = true});
  checks::check_surface(Ellipsoid(kSkewFrame, {3, 2, 1}, {{1, 2}, {-kPi / 2, 0.3}}));
}

// Golovanov 2016, 3.1: a, b, c = 3, 2, 1 at u = 0.5, v = 0.3, and the area.
TEST(Ellipsoid, HasTheValuesOfTheTextbook) {
  const Ellipsoid ellipsoid(Frame(), {3, 2, 1});
  EXPECT_LE(distance(ellipsoid.point(0.5, 0.3), {2.515159930782611, 0.916025421694584, 0.295520206661340}), 2e-15);
  EXPECT_LE(distance(ellipsoid.normal(0.5, 0.3), {0.598713656212757, 0.490618141638763, 0.633115942746097}), 2e-15);
  const auto c = checks::curvatures(ellipsoid, 0.5, 0.3);
  EXPECT_NEAR(c.mean, -0.921511803139706, 1e-14);
  EXPECT_NEAR(c.gaussian, 0.585169620359303, 1e-14);
  EXPECT_NEAR(checks::area(ellipsoid), 48.8821463025821, 1e-7);
}

}  // namespace
}  // namespace lekalo::geometry::ellipsoid_test
