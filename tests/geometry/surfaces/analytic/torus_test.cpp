#include "geometry/surfaces/analytic/torus.h"

#include "geometry/queries/rays/line_intersections.h"
#include "geometry/surfaces/analytic_formulas.h"

namespace lekalo::geometry::torus_test {
namespace {

using checks::distance;
using checks::kSkewFrame;

int hit_count(const Surface& surface, const Line& line) {
  LineHits hits;
  surface.line_hits(line, Interval::entire(), hits);
  return hits.size();
}

TEST(TorusSurface, DerivativesEqualThoseOfTheFormulaIn113Bits) {
  const auto formula = checks::placed(kSkewFrame, [](auto u, auto v) {
    const auto rho = Quad(3) + Quad(1.25) * cos(v);
    return Triple{rho * cos(u), rho * sin(u), Quad(1.25) * sin(v)};
  });
  checks::check_derivatives(TorusSurface(kSkewFrame, 3, 1.25), formula, {{-7, 7}, {-7, 7}});
}

TEST(TorusSurface, RingMeetsTheGeneralChecks) {
  checks::check_surface(TorusSurface(kSkewFrame, 3, 1), {.closed = true});
  checks::check_surface(TorusSurface(kSkewFrame, 100, 0.01), {.closed = true});
  checks::check_surface(TorusSurface(kSkewFrame, 1, 0.999999), {.closed = true});
  checks::check_surface(TorusSurface(kSkewFrame, 3, 1, {{-1, 2}, {3, 5}}));
}

TEST(TorusSurface, HornAppleAndLemonMeetTheGeneralChecks) {
  checks::check_surface(TorusSurface(kSkewFrame, 1, 1), {.closed = true});
  checks::check_surface(TorusSurface(kSkewFrame, 1, 2), {.closed = true});
  checks::check_surface(TorusSurface(kSkewFrame, 1e-9, 2), {.closed = true});
  checks::check_surface(TorusSurface(kSkewFrame, 0, 2), {.closed = true});
  checks::check_surface(TorusSurface(kSkewFrame, -1, 2), {.closed = true});
  checks::check_surface(TorusSurface(kSkewFrame, -1.9, 2), {.closed = true});
  checks::check_surface(TorusSurface(kSkewFrame, 1, 2, {{1, 4}, {0.5, 1.5}}));
}

// Golovanov 2016, 3.1: R = 3, r = 1; principal curvatures -cos v/rho and -1/r.
TEST(TorusSurface, HasTheCurvaturesOfTheTextbook) {
  const TorusSurface torus(kSkewFrame, 3, 1);
  EXPECT_NEAR(checks::curvatures(torus, 1, 0).mean, -0.625, 1e-14);
  EXPECT_NEAR(checks::curvatures(torus, 1, 0).gaussian, 0.25, 1e-14);
  EXPECT_NEAR(checks::curvatures(torus, 1, kPi / 3).gaussian, 1.0 / 7, 1e-14);
  EXPECT_NEAR(checks::curvatures(torus, 1, kPi).gaussian, -0.5, 1e-14);
}

// 4 pi^2 R r, and 4 pi r (R v_m + sqrt(r^2 - R^2)) of the spindle tori (Golovanov 2016, 3.2).
TEST(TorusSurface, HasTheAreasOfTheTextbook) {
  EXPECT_NEAR(checks::area(TorusSurface(kSkewFrame, 3, 1)), 118.435252813072, 1e-10);
  EXPECT_NEAR(checks::area(TorusSurface(kSkewFrame, 1, 2)), 96.1690748807645, 1e-10);
  EXPECT_NEAR(checks::area(TorusSurface(kSkewFrame, 0, 2)), 50.2654824574367, 1e-10);
  EXPECT_NEAR(checks::area(TorusSurface(kSkewFrame, -1, 2)), 17.2122396720496, 1e-10);
}

TEST(TorusSurface, TipsLieOnTheAxis) {
  for (const double major : {1.0, -1.0}) {
    const TorusSurface torus(Frame(), major, 2);
    EXPECT_LE(distance(torus.point(1, torus.domain().v.hi), {0, 0, std::sqrt(3.0)}), 1e-15);
    EXPECT_LE(distance(torus.point(1, torus.domain().v.lo), {0, 0, -std::sqrt(3.0)}), 1e-15);
  }
}

// The axis of a ring, horn, apple, lemon; and a line through the center in the plane of symmetry.
TEST(TorusSurface, AxisAndCenterLinesHitWhatTheyShould) {
  const Line axis{{0, 0, -7}, {0, 0, 1}}, across{{-9, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(hit_count(TorusSurface(Frame(), 3, 1), axis), 0);
  EXPECT_EQ(hit_count(TorusSurface(Frame(), 3, 1), across), 4);
  EXPECT_EQ(hit_count(TorusSurface(Frame(), 1, 1), axis), 0);
  EXPECT_EQ(hit_count(TorusSurface(Frame(), 1, 1), across) % 2, 0);
  EXPECT_EQ(hit_count(TorusSurface(Frame(), 1, 2), axis), 2);
  EXPECT_EQ(hit_count(TorusSurface(Frame(), 1, 2), across), 2);
  EXPECT_EQ(hit_count(TorusSurface(Frame(), -1, 2), axis), 2);
  EXPECT_EQ(hit_count(TorusSurface(Frame(), -1, 2), across), 2);
}

// Lines through a tip: steeper than its cone they pass from the dimple of the apple into the lemon, and each sheet is
// crossed there; apple and lemon stay even. The half-angle of the cone has the sine |R|/r.
TEST(TorusSurface, LinesThroughTheTipsKeepParity) {
  const TorusSurface apple(kSkewFrame, 1, 2), lemon(kSkewFrame, -1, 2);
  const Vec3 tip = kSkewFrame.point({0, 0, std::sqrt(3.0)});
  std::mt19937_64 random(9);
  for (int i = 0; i < 3000; ++i) {
    const Vec3 local = checks::random_direction(random);
    const Vec3 direction = kSkewFrame.direction(local);
    const bool steep = std::hypot(local.x, local.y) < std::abs(local.z) * std::tan(kPi / 6) - 1e-3;
    for (const double away : {0.0, 1.0, 1e4}) {
      const Line line{tip - away * direction, direction};
      const int a = hit_count(apple, line), l = hit_count(lemon, line);
      ASSERT_EQ(a % 2, 0);
      ASSERT_EQ(l % 2, 0);
      ASSERT_GE(a, 2);
      if (steep) {
        ASSERT_EQ(l, 2);
      }
    }
  }
}

// Lines that pass beside a tip, nearer than the roots of a quartic tell from a line through it.
TEST(TorusSurface, LinesBesideTheTipsKeepParity) {
  const LineIntersector apple(std::make_shared<TorusSurface>(kSkewFrame, 1, 2)),
      lemon(std::make_shared<TorusSurface>(kSkewFrame, -1, 2));
  const Vec3 tip = kSkewFrame.point({0, 0, std::sqrt(3.0)});
  std::mt19937_64 random(10);
  std::uniform_real_distribution<double> unit(0, 1);
  int hits = 0;
  for (int i = 0; i < 10000; ++i) {
    const Vec3 direction = checks::random_direction(random);
    const Vec3 by = std::pow(10, -13 + 7 * unit(random)) * checks::random_direction(random);
    const Line line{tip + by - 10.0 * direction, direction};
    ASSERT_EQ(apple.all_hits(line).size() % 2, 0u) << i;
    const size_t inner = lemon.all_hits(line).size();
    ASSERT_EQ(inner % 2, 0u) << i;
    hits += static_cast<int>(inner);
  }
  EXPECT_GT(hits, 2000);
}

// Tangent lines moved by e inward or outward; none may leave a single hit.
TEST(TorusSurface, GrazingLinesHitTwiceOrNotAtAll) {
  const TorusSurface torus(kSkewFrame, 3, 1);
  std::mt19937_64 random(10);
  int lost = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec2 place = checks::random_place(torus.domain(), random);
    const Vec3 p = torus.point(place.x, place.y), n = torus.normal(place.x, place.y);
    const SurfaceJet jet = torus.evaluate(place.x, place.y, 1);
    std::uniform_real_distribution<double> uniform(0, kTwoPi);
    const double angle = uniform(random);
    const Vec3 along = std::cos(angle) * glm::normalize(jet.du()) + std::sin(angle) * glm::normalize(jet.dv());
    for (const double e : {0.0, 1e-15, 1e-13, 1e-11, 1e-9, 1e-6}) {
      ASSERT_EQ(hit_count(torus, {p - e * n, along}) % 2, 0);
      ASSERT_EQ(hit_count(torus, {p + e * n - 1e3 * along, along}) % 2, 0);
    }
    // 1e-9 inside along a convex direction there are two hits close to the point.
    if (std::cos(place.y) > 0.01) {
      LineHits hits;
      torus.line_hits({p - 1e-9 * n, along}, {-1e-2, 1e-2}, hits);
      lost += hits.size() != 2;
    }
  }
  EXPECT_EQ(lost, 0);
}

// The implicit equation at hits of random lines, and as many hits as F has changes of sign (scanned in 113 bits would
// be the same: the steps are far above rounding).
TEST(TorusSurface, FindsAllChangesOfSign) {
  std::mt19937_64 random(13);
  for (const double major : {2.0, 1.0, 0.4}) {
    const TorusSurface outer(Frame(), major, 1);
    for (int i = 0; i < 400; ++i) {
      const Line line{2.0 * checks::random_direction(random), checks::random_direction(random)};
      int changes = 0;
      bool inside = false;
      for (int k = -4000; k <= 4000; ++k) {
        const Vec3 p = line.at(k * 2e-3);
        const double rho = std::hypot(p.x, p.y);
        const double f = std::hypot(rho - major, p.z) - 1;  // the nearer half of the tube: the union, the apple
        if ((f < 0) != inside) ++changes;
        inside = f < 0;
      }
      LineHits hits;
      outer.line_hits(line, {-8, 8}, hits);
      ASSERT_GE(hits.size(), changes);
      if (hits.size() > changes) {  // a short chord between two steps of the scan
        double shortest = kInfinity;
        for (int a = 0; a < hits.size(); ++a)
          for (int b = 0; b < a; ++b) shortest = std::min(shortest, std::abs(hits[a].t - hits[b].t));
        ASSERT_LT(shortest, 2.1e-3);
      }
    }
  }
}

TEST(TorusSurface, RefusesEmptySheetsAndPartsBeyondTheTips) {
  EXPECT_THROW(TorusSurface(Frame(), -2, 2), std::invalid_argument);
  EXPECT_THROW(TorusSurface(Frame(), 1, 0), std::invalid_argument);
  EXPECT_THROW(TorusSurface(Frame(), 1, 2, {{0, 1}, {0, 3}}), std::invalid_argument);
  EXPECT_THROW(TorusSurface(Frame(), 3, 1, {{0, 1}, {0, 7}}), std::invalid_argument);
}

}  // namespace
}  // namespace lekalo::geometry::torus_test
