#include "geometry/surfaces/analytic/cone.h"

#include "geometry/surfaces/analytic_formulas.h"

namespace lekalo::geometry::cone_test {
namespace {

using checks::distance;
using checks::kSkewFrame;

int hit_count(const Surface& surface, const Line& line) {
  LineHits hits;
  surface.line_hits(line, Interval::entire(), hits);
  return hits.size();
}

TEST(ConeSurface, DerivativesEqualThoseOfTheFormulaIn113Bits) {
  const auto formula = checks::placed(kSkewFrame, [](auto u, auto v) {
    const auto rho = Quad(1.5) + (Quad(0.25) - Quad(1.5)) * v;
    return Triple{rho * cos(u), rho * sin(u), Quad(3) * v};
  });
  checks::check_derivatives(ConeSurface(kSkewFrame, 1.5, 0.25, 3), formula, {{-7, 7}, {-1, 2}});
}

TEST(ConeSurface, MeetsTheGeneralChecks) {
  checks::check_surface(ConeSurface(kSkewFrame, 1.5, 0.25, 3));
  checks::check_surface(ConeSurface(kSkewFrame, 1.5, 0, 3));
  checks::check_surface(ConeSurface(kSkewFrame, 0, 2, 0.5, {{-1, 2}, {0, 1}}));
  checks::check_surface(ConeSurface(kSkewFrame, 1, 1 + 1e-9, 1));
  checks::check_surface(ConeSurface(kSkewFrame, 1, 3, 2, {{0, kTwoPi}, {-1.5, 0.75}}));  // both nappes
  for (const double height : {2.0, -2.0})                                                // the other one
    checks::check_surface(ConeSurface(kSkewFrame, 1, 3, height, {{0, kTwoPi}, {-1.5, -0.75}}));
}

TEST(CylinderSurface, MeetsTheGeneralChecks) {
  checks::check_surface(CylinderSurface(kSkewFrame, 1.5, 3));
  checks::check_surface(CylinderSurface(kSkewFrame, 0.01, 100, {{2, 5}, {0.25, 0.5}}));
  checks::check_surface(CylinderSurface(frame_about({5e5, 0, 1e6}, {1, 1, 0}), 20, 3));
  const CylinderSurface unbounded(kSkewFrame, 2, 1, CylinderSurface::kUnbounded);
  EXPECT_FALSE(unbounded.bounded());
  EXPECT_TRUE(unbounded.pieces().empty());
  checks::check_line_hits(unbounded, {{0, kTwoPi}, {-50, 70}}, {.closed = true});
}

// Golovanov 2016, 3.2: r = 1, h = 2, half-angle 30 degrees.
TEST(ConeSurface, HasTheValuesOfTheTextbook) {
  const ConeSurface cone(Frame(), 1, 1 + 2 * std::tan(kPi / 6), 2);
  EXPECT_LE(distance(cone.point(0.5, 0.3), {1.181586078896490, 0.645503416865914, 0.6}), 1e-14);
  EXPECT_LE(distance(cone.normal(0.5, 0.3), {0.760008792515292, 0.415194695654277, -0.5}), 1e-14);
  const auto c = checks::curvatures(cone, 0.5, 0.3);
  EXPECT_NEAR(2 * c.mean, -0.643210686118680, 1e-14);  // the other principal curvature is zero
  EXPECT_NEAR(c.gaussian, 0, 1e-15);
  EXPECT_NEAR(checks::area(cone), 22.8879753234465, 1e-12 * 23);
}

TEST(CylinderSurface, HasTheCurvatureAndAreaOfACylinder) {
  const CylinderSurface cylinder(kSkewFrame, 2, 3);
  EXPECT_NEAR(checks::curvatures(cylinder, 1, 0.5).mean, -0.25, 1e-15);
  EXPECT_NEAR(checks::area(cylinder), 2 * kPi * 2 * 3, 1e-12 * 38);
}

// A line through the apex steeper than the generatrices crosses one hit on each nappe: a single nappe is hit once, the
// double one twice. A flatter line only touches.
TEST(ConeSurface, LinesThroughTheApexKeepParity) {
  const ConeSurface upper(kSkewFrame, 0, 1, 2), lower(kSkewFrame, 1, 0, 2);
  const ConeSurface both(kSkewFrame, 1, -1, 2);
  std::mt19937_64 random(7);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 local = checks::random_direction(random);
    const Vec3 direction = kSkewFrame.direction(local);
    if (std::abs(std::abs(local.z) * 0.5 - std::hypot(local.x, local.y)) < 1e-3) continue;
    const bool steep = std::abs(local.z) * 0.5 > std::hypot(local.x, local.y);
    const auto line = [&](const Vec3& apex, double away) { return Line{apex - away * direction, direction}; };
    for (const double away : {0.0, 1.0, 1e3}) {
      const Line to_origin = line(kSkewFrame.origin, away);
      const Line to_top = line(kSkewFrame.point({0, 0, 2}), away);
      const Line to_middle = line(kSkewFrame.point({0, 0, 1}), away);
      const int u = hit_count(upper, to_origin), l = hit_count(lower, to_top), b = hit_count(both, to_middle);
      if (steep) {
        ASSERT_EQ(u, 1);
        ASSERT_EQ(l, 1);
        ASSERT_EQ(b, 2);
      } else {
        ASSERT_EQ(u % 2, 0);
        ASSERT_EQ(l % 2, 0);
        ASSERT_EQ(b % 2, 0);
      }
    }
  }
  // Exactly along the axis, where all is exact.
  EXPECT_EQ(hit_count(ConeSurface(Frame(), 0, 1, 1), {{0, 0, -5}, {0, 0, 1}}), 1);
}

TEST(ConeSurface, NormalAtTheApexFollowsTheParallel) {
  const ConeSurface cone(Frame(), 0, 1, 1);
  for (const double u : {0.0, 2.0, 5.0})
    EXPECT_LE(distance(cone.normal(u, 0), Vec3(std::cos(u), std::sin(u), -1) / std::sqrt(2.0)), 1e-15);
}

// A line in the cylinder, or parallel to its axis, has no single hits.
TEST(CylinderSurface, GeneratricesAreNoHits) {
  const CylinderSurface cylinder(Frame(), 1, 1, CylinderSurface::kUnbounded);
  EXPECT_EQ(hit_count(cylinder, {{1, 0, 0}, {0, 0, 1}}), 0);
  EXPECT_EQ(hit_count(cylinder, {{0.5, 0, 0}, {0, 0, 1}}), 0);
}

}  // namespace
}  // namespace lekalo::geometry::cone_test
