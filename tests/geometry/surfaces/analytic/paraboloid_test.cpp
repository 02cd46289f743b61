#include "geometry/surfaces/analytic/paraboloid.h"

#include "geometry/surfaces/analytic_formulas.h"

namespace lekalo::geometry::paraboloid_test {
namespace {

using checks::distance;
using checks::kSkewFrame;

TEST(EllipticParaboloid, DerivativesEqualThoseOfTheFormulaIn113Bits) {
  const auto formula = checks::placed(kSkewFrame, [](auto u, auto v) {
    return Triple{Quad(2) * v * cos(u), Quad(1) * v * sin(u), v * v};
  });
  checks::check_derivatives(EllipticParaboloid(kSkewFrame, 2, 1, EllipticParaboloid::kUnbounded), formula,
                            {{-7, 7}, {-3, 3}});
}

TEST(EllipticParaboloid, MeetsTheGeneralChecks) {
  checks::check_surface(EllipticParaboloid(kSkewFrame, 2, 1, {{0, kTwoPi}, {0, 1.5}}));
  checks::check_surface(EllipticParaboloid(kSkewFrame, 0.1, 0.3, {{-1, 1}, {2, 2.5}}));
  const EllipticParaboloid unbounded(kSkewFrame, 2, 1, EllipticParaboloid::kUnbounded);
  EXPECT_FALSE(unbounded.bounded());
  checks::check_line_hits(unbounded, {{0, kTwoPi}, {0, 5}});
}

// Golovanov 2016, 3.2: a, b = 2, 1 at u = 0.5, v = 0.3.
TEST(EllipticParaboloid, HasTheValuesOfTheTextbook) {
  const EllipticParaboloid surface(Frame(), 2, 1, {{0, kTwoPi}, {0, 1.5}});
  EXPECT_LE(distance(surface.point(0.5, 0.3), {0.526549537134224, 0.143827661581261, 0.09}), 1e-15);
  EXPECT_LE(distance(surface.normal(0.5, 0.3), {0.245285481840837, 0.268000138904366, -0.931671056728365}), 1e-15);
  const auto c = checks::curvatures(surface, 0.5, 0.3);
  EXPECT_NEAR(c.mean, -1.083658919830597, 1e-14);
  EXPECT_NEAR(c.gaussian, 0.753443023113202, 1e-14);
  EXPECT_EQ(surface.normal(1, 0), Vec3(0, 0, -1));
}

TEST(HyperbolicParaboloid, DerivativesEqualThoseOfTheFormulaIn113Bits) {
  const auto formula = checks::placed(kSkewFrame, [](auto u, auto v) {
    return Triple{Quad(2) * u, Quad(1) * v, u * u - v * v};
  });
  checks::check_derivatives(HyperbolicParaboloid(kSkewFrame, 2, 1, HyperbolicParaboloid::kUnbounded), formula,
                            {{-3, 3}, {-3, 3}});
}

TEST(HyperbolicParaboloid, MeetsTheGeneralChecks) {
  checks::check_surface(HyperbolicParaboloid(kSkewFrame, 2, 1, {{-1, 2}, {-3, 0.5}}));
  const HyperbolicParaboloid unbounded(kSkewFrame, 2, 1, HyperbolicParaboloid::kUnbounded);
  checks::check_line_hits(unbounded, {{-4, 4}, {-4, 4}});
}

// Golovanov 2016, 3.2; principal curvatures 2/a^2, -2/b^2 at the saddle.
TEST(HyperbolicParaboloid, HasTheValuesOfTheTextbook) {
  const HyperbolicParaboloid surface(Frame(), 2, 1, {{-1, 1}, {-1, 1}});
  EXPECT_LE(distance(surface.point(0.5, 0.3), {1, 0.3, 0.16}), 1e-15);
  EXPECT_LE(distance(surface.normal(0.5, 0.3), {-0.394055203119550, 0.472866243743460, 0.788110406239101}), 1e-15);
  const auto c = checks::curvatures(surface, 0.5, 0.3);
  EXPECT_NEAR(c.mean, -0.445453707874274, 1e-14);
  EXPECT_NEAR(c.gaussian, -0.385787585355503, 1e-14);
  EXPECT_NEAR(checks::curvatures(surface, 0, 0).gaussian, -1, 1e-15);
  EXPECT_NEAR(checks::curvatures(surface, 0, 0).mean, -0.75, 1e-15);
}

}  // namespace
}  // namespace lekalo::geometry::paraboloid_test
