// Tubes: points, normals and derivatives, flat ends, lines through what is degenerate, and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/curves/analytic/circle.h"
#include "geometry/describe.h"
#include "geometry/shapes/tube/tube.h"
#include "geometry/shapes/tube/tube_cases.h"
#include "geometry/surfaces/analytic/torus.h"
#include "support/tier.h"

namespace lekalo::geometry::tube_points_test {
namespace {

// The points and derivatives at hits of random lines.
template <class Check>
void check_points(const Tube& tube, const Check& check) {
  std::mt19937_64 random(11);
  int points = 0;
  for (int i = 0; i < 400; ++i) {
    const Line line = random_line(tube.bounds(), 1, 0, random);
    std::vector<SurfaceHit> hits;
    tube.all_hits(line, Interval::entire(), hits);
    for (size_t k = 0; k < hits.size(); ++k) {
      const Vec3 near = line.at(hits[k].t);
      const ShapePoint at = tube.point(hits[k], near);
      EXPECT_LE(glm::length(at.position - near), 1e-10);
      EXPECT_NEAR(glm::length(at.normal), 1, 1e-15);
      // In and out by turns.
      EXPECT_EQ(glm::dot(at.normal, line.direction) < 0, k % 2 == 0);
      EXPECT_LE(std::abs(glm::dot(at.du, at.normal)), 1e-9 * (1 + glm::length(at.du)));
      EXPECT_LE(std::abs(glm::dot(at.dv, at.normal)), 1e-12);
      check(at);
      ++points;
    }
  }
  EXPECT_GT(points, 100);
}

TEST(Tube, PointsOfARingAreThoseOfATorus) {
  // About a plane curve the reference direction keeps its angle with the plane, so that v is that of the torus and a
  // constant.
  const Tube ring(std::make_shared<Circle>(Frame(), 2.0), RadiusLaw(0.5), Caps::round);
  const TorusSurface torus(Frame(), 2, 0.5);
  double shift = kInfinity;
  check_points(ring, [&](const ShapePoint& at) {
    const double v = std::atan2(at.position.z, std::hypot(at.position.x, at.position.y) - 2);
    const SurfaceJet jet = torus.evaluate(at.u, v, 1);
    EXPECT_LE(glm::length(at.position - jet.point()), 1e-13);
    EXPECT_LE(glm::length(at.normal - torus.normal(at.u, v)), 1e-12);
    EXPECT_LE(glm::length(at.du - jet.du()), 1e-12);
    EXPECT_LE(std::abs(std::abs(glm::dot(at.dv, jet.dv())) - 0.25), 1e-12);
    const double turn = std::remainder(at.v * (glm::dot(at.dv, jet.dv()) < 0 ? -1 : 1) - v, kTwoPi);
    if (shift == kInfinity) shift = turn;
    EXPECT_LE(std::abs(std::remainder(turn - shift, kTwoPi)), 1e-7);
  });
}

TEST(Tube, DerivativesOfAConeAreThoseOfItsFormula) {
  // R = 0.3 + 0.2 t about the axis z: the cone r = 0.3 + 0.2 t + ... touches the balls where n . z = -0.2.
  const CurvePtr axis = segment({0, 0, 0}, {0, 0, 2});
  const Tube cone(axis, RadiusLaw(law("0.3 + 0.4*s"), *axis), Caps::round);
  int walls = 0;
  const double k = 0.2, c = std::sqrt(1 - k * k);
  check_points(cone, [&](const ShapePoint& at) {
    if (glm::length(at.du) == 0) return;
    const double z = 2 * at.u, radius = 0.3 + 0.2 * z;
    EXPECT_NEAR(at.normal.z, -k, 1e-9);
    EXPECT_NEAR(at.position.z, z - k * radius, 1e-9);
    const Vec3 m = glm::normalize(Vec3(at.normal.x, at.normal.y, 0));
    EXPECT_LE(glm::length(at.du - 2.0 * (Vec3(0, 0, 1 - k * k) + k * c * m)), 1e-8);
    ++walls;
  });
  EXPECT_GT(walls, 50);
}

TEST(Tube, AnyHelixHasItsNormalsAcross) {
  const auto helix = formula({"cos(t)", "sin(t)", "0.12*t"}, {0, 12});
  check_points(Tube(helix, RadiusLaw(law("0.08 + 0.2*s + 0.03*sin(40*s)"), *helix), Caps::round),
               [](const ShapePoint&) {});
  check_points(Tube(helix, RadiusLaw(0.2), Caps::flat), [](const ShapePoint&) {});
}

TEST(Tube, FlatEndsOfABentTubeLieAcrossTheCurve) {
  const auto arc = formula({"2*cos(t)", "2*sin(t)", "0"}, {0, 1.5});
  const Tube tube(arc, RadiusLaw(0.5), Caps::flat);
  const TorusSurface torus(Frame(), 2, 0.5, {{0, 1.5}, {-kPi, kPi}});
  std::mt19937_64 random(2);
  int caps = 0;
  for (int i = 0; i < tests::tier_count(100000); ++i) {
    const Line line = random_line(tube.bounds(), 0.5, 0, random);
    std::vector<SurfaceHit> hits;
    tube.all_hits(line, Interval::entire(), hits);
    ASSERT_EQ(hits.size() % 2, 0u);
    std::vector<double> walls, expected;
    for (const SurfaceHit& hit : hits) {
      const Vec3 p = line.at(hit.t);
      if (hit.face == 0) {
        walls.push_back(hit.t);
        continue;
      }
      ++caps;
      const double angle = hit.face == 1 ? 0 : 1.5;
      const Vec3 center = 2.0 * Vec3(std::cos(angle), std::sin(angle), 0), across(-std::sin(angle), std::cos(angle), 0);
      EXPECT_LE(glm::length(p - center), 0.5 + 1e-12);
      EXPECT_LE(std::abs(glm::dot(p - center, across)), 1e-13);
      EXPECT_LE(glm::length(tube.point(hit, p).normal - (hit.face == 1 ? -across : across)), 1e-14);
    }
    LineHits on_torus;
    torus.line_hits(line, Interval::entire(), on_torus);
    for (int k = 0; k < on_torus.size(); ++k) expected.push_back(on_torus[k].t);
    std::sort(expected.begin(), expected.end());
    ASSERT_EQ(walls.size(), expected.size()) << "line " << i;
    for (size_t k = 0; k < walls.size(); ++k) EXPECT_LE(std::abs(walls[k] - expected[k]), 1e-9) << "line " << i;
  }
  EXPECT_GT(caps, 20);
}

TEST(Tube, LinesAlongItAndThroughWhatIsDegenerate) {
  const auto count = [](const Tube& tube, const Line& line) {
    std::vector<SurfaceHit> hits;
    tube.all_hits(line, Interval::entire(), hits);
    return hits;
  };
  // Along a straight tube, inside and outside.
  const Tube rod(segment({0, 0, 0}, {0, 0, 2}), RadiusLaw(0.5), Caps::round);
  const auto along = count(rod, {{0.3, 0, -7}, {0, 0, 2}});
  ASSERT_EQ(along.size(), 2u);
  EXPECT_NEAR(along[0].t, (7 - 0.4) / 2, 1e-15);
  EXPECT_NEAR(along[1].t, (9 + 0.4) / 2, 1e-15);
  EXPECT_TRUE(count(rod, {{0.6, 0, -7}, {0, 0, 1}}).empty());
  // Along the axis of a ring without a hole every ball counts the same.
  const Tube ring(std::make_shared<Circle>(Frame(), 1.0), RadiusLaw(1.3), Caps::round);
  const auto through = count(ring, {{0, 0, -7}, {0, 0, 1}});
  ASSERT_EQ(through.size(), 2u);
  EXPECT_NEAR(through[0].t, 7 - std::sqrt(0.69), 1e-12);
  EXPECT_NEAR(through[1].t, 7 + std::sqrt(0.69), 1e-12);
  // Through the cusp itself.
  const Tube cusp(formula({"t^2", "t^3", "0"}, {-1, 1}), RadiusLaw(0.15), Caps::round);
  const auto tip = count(cusp, {{-3, 0, 0}, {1, 0, 0}});
  ASSERT_GE(tip.size(), 2u);
  EXPECT_NEAR(tip[0].t, 2.85, 1e-13);
}

TEST(Tube, RefusesWhatIsNone) {
  const auto helix = formula({"cos(t)", "sin(t)", "0.12*t"}, {0, 12});
  const auto refused = [&](const std::string& text) -> std::string {
    try {
      Tube(helix, RadiusLaw(law(text), *helix), Caps::round);
    } catch (const FieldError& error) {
      return error.field + ": " + error.what();
    }
    return "nothing";
  };
  EXPECT_EQ(refused("0"), "radius: the radius must be greater than 0, found 0");
  EXPECT_EQ(refused("-0.1"), "radius: the radius must be greater than 0, found -0.1");
  EXPECT_EQ(refused("0.5 - s"), "radius: the radius must be greater than 0, and at s = 0.5 it is 0");
  EXPECT_EQ(refused("log(s - 0.5)"), "radius: the formula has no value at s = 0");
  // Below zero between any places where it could be tried.
  EXPECT_NE(refused("(s - 1/3)^2 - 1e-9"), "nothing");
  EXPECT_EQ(refused("0.1 + s"), "nothing");
}

}  // namespace
}  // namespace lekalo::geometry::tube_points_test
