#include "geometry/surfaces/analytic/sphere.h"

#include "geometry/surfaces/analytic_formulas.h"

namespace lekalo::geometry::sphere_test {
namespace {

using checks::distance;
using checks::kSkewFrame;

TEST(SphereSurface, DerivativesEqualThoseOfTheFormulaIn113Bits) {
  const auto formula = checks::placed(kSkewFrame, [](auto u, auto v) {
    const Quad r = 2.5;
    return Triple{r * cos(v) * cos(u), r * cos(v) * sin(u), r * sin(v)};
  });
  checks::check_derivatives(SphereSurface(kSkewFrame, 2.5), formula, {{-7, 7}, {-1.5, 1.5}});
}

TEST(SphereSurface, MeetsTheGeneralChecks) {
  checks::check_surface(SphereSurface(kSkewFrame, 2.5), {.closed = true});
  checks::check_surface(SphereSurface(kSkewFrame, 2.5, {{-1, 2}, {-0.5, kPi / 2}}));
  checks::check_surface(SphereSurface(kSkewFrame, 1e-3, {{3, 9}, {0.1, 0.2}}));
  SphereSurface inward(frame_about({1000, 2000, -3000}, {0, 0, 1}), 1);
  inward.set_reversed(true);
  checks::check_surface(inward, {.closed = true});
}

// Curvatures of a sphere, normal outward: H = -1/R, K = 1/R^2; area 4 pi R^2, of a zone 2 pi R h.
TEST(SphereSurface, HasTheCurvatureAndAreaOfASphere) {
  const SphereSurface sphere(kSkewFrame, 2);
  for (const double v : {-1.2, 0.0, 0.7}) {
    const auto c = checks::curvatures(sphere, 0.3, v);
    EXPECT_NEAR(c.mean, -0.5, 1e-14);
    EXPECT_NEAR(c.gaussian, 0.25, 1e-14);
  }
  EXPECT_NEAR(checks::area(sphere), 16 * kPi, 1e-12 * 50);
  const SphereSurface zone(kSkewFrame, 2, {{0, kTwoPi}, {0, kPi / 6}});
  EXPECT_NEAR(checks::area(zone), 2 * kPi * 2 * 1, 1e-12 * 12);
}

TEST(SphereSurface, NormalsAtThePolesAreTheAxis) {
  SphereSurface sphere(kSkewFrame, 2);
  for (const double u : {0.0, 1.0, 4.0}) {
    EXPECT_LE(distance(sphere.normal(u, kPi / 2), kSkewFrame.z), 1e-15);
    EXPECT_LE(distance(sphere.normal(u, -kPi / 2), -kSkewFrame.z), 1e-15);
  }
  sphere.set_reversed(true);
  EXPECT_LE(distance(sphere.normal(0, kPi / 2), -kSkewFrame.z), 1e-15);
}

// Lines at the distance R (1 -+ e) from the center: two hits or none, never one, from near and from far.
TEST(SphereSurface, GrazingLinesHitTwiceOrNotAtAll) {
  const SphereSurface sphere(Frame(), 1);
  for (const double away : {0.0, 1e3, 1e6}) {
    for (int k = 1; k <= 14; ++k) {
      const double e = std::pow(10.0, -k);
      LineHits inside, outside;
      sphere.line_hits({{1 - e, -away, 0}, {0, 1, 0}}, Interval::entire(), inside);
      sphere.line_hits({{1 + e, -away, 0}, {0, 1, 0}}, Interval::entire(), outside);
      EXPECT_EQ(inside.size(), 2) << e;
      EXPECT_EQ(outside.size(), 0) << e;
      // Half the chord, sqrt(2 e - e^2) for the e that 1 - e rounds to.
      const double exact = 1 - (1 - e);
      EXPECT_NEAR(inside[1].t - inside[0].t, 2 * std::sqrt(exact * (2 - exact)), 1e-12 + 3e-16 * away);
    }
    LineHits touching;
    sphere.line_hits({{1, -away, 0}, {0, 1, 0}}, Interval::entire(), touching);
    EXPECT_EQ(touching.size() % 2, 0);
  }
}

TEST(SphereSurface, RefusesImpossibleDomains) {
  EXPECT_THROW(SphereSurface(Frame(), 0), std::invalid_argument);
  EXPECT_THROW(SphereSurface(Frame(), 1, {{0, 7}, {0, 1}}), std::invalid_argument);
  EXPECT_THROW(SphereSurface(Frame(), 1, {{0, 1}, {0, 1.6}}), std::invalid_argument);
  EXPECT_THROW(SphereSurface(Frame(), 1, {{0, 1}, {1, 1}}), std::invalid_argument);
}

}  // namespace
}  // namespace lekalo::geometry::sphere_test
