// Sections, silhouettes and intersections of bodies, against elementary geometry.
#include "geometry/queries/contours/body_contours.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/queries/contours/contour_length.h"
#include "geometry/queries/contours/surface_intersection.h"
#include "support/tier.h"

namespace lekalo::geometry::body_contours_test {
namespace {

double length_of(const BodyContour& branch) {
  double sum = 0;
  for (const BodyContourPart& part : branch.parts) sum += contour_length(part.contour, part.t).value;
  return sum;
}

// Each part begins where the one before ends, and a closed branch comes back.
void check_chain(const BodyContour& branch) {
  for (size_t k = 0; k + 1 < branch.parts.size(); ++k)
    EXPECT_LT(glm::length(branch.parts[k].end - branch.parts[k + 1].begin), 1e-9);
  if (branch.closed) {
    EXPECT_LT(glm::length(branch.parts.back().end - branch.parts.front().begin), 1e-9);
  }
}

TEST(BodyContours, HexagonThroughACube) {
  const Body cube = box(Frame(), {2, 2, 2});
  const BodyContours found = plane_section(cube, {1, 1, 1}, {1, 1, 1});
  ASSERT_EQ(found.branches.size(), 1u);
  EXPECT_TRUE(found.branches[0].closed);
  EXPECT_EQ(found.branches[0].parts.size(), 6u);
  check_chain(found.branches[0]);
  EXPECT_NEAR(length_of(found.branches[0]), 6 * std::sqrt(2.0), 1e-13);
  EXPECT_TRUE(found.complete);
  EXPECT_TRUE(plane_section(cube, {3, 3, 3}, {1, 1, 1}).branches.empty());
}

TEST(BodyContours, PlanesAcrossATorus) {
  const Body ring = torus_body(Frame(), 3, 1);
  const BodyContours two = plane_section(ring, {0, 0, 0}, {0, 1, 0});
  ASSERT_EQ(two.branches.size(), 2u);
  for (const BodyContour& circle : two.branches) {
    EXPECT_TRUE(circle.closed);
    EXPECT_NEAR(length_of(circle), kTwoPi, 1e-12);
  }
}

// A box of side 2 about the corner of which a ball of radius 1.2 stands: three quarter circles.
TEST(BodyContours, BallAtTheCornerOfABox) {
  const Body cube = box(Frame(), {2, 2, 2}), round = ball(Frame(), 1.2);
  const BodyContours found = intersect(cube, round);
  ASSERT_EQ(found.branches.size(), 1u);
  EXPECT_TRUE(found.branches[0].closed);
  EXPECT_EQ(found.branches[0].parts.size(), 3u);
  check_chain(found.branches[0]);
  EXPECT_NEAR(length_of(found.branches[0]), 3 * 0.25 * kTwoPi * 1.2, 1e-12);
  for (const BodyContourPart& part : found.branches[0].parts) {
    EXPECT_EQ(cube.faces[part.face].origin.role.substr(1), "_min");
    EXPECT_EQ(part.other_face, 0);
  }
}

TEST(BodyContours, GeneratorsOfACone) {
  const Body cone = frustum(Frame(), 1, 0.5, 2);
  const BodyContours found = silhouette(cone, {false, {0, 1, 0}});
  ASSERT_EQ(found.branches.size(), 2u);
  for (const BodyContour& one : found.branches) {
    EXPECT_FALSE(one.closed);
    EXPECT_NEAR(length_of(one), std::hypot(2, 0.5), 1e-13);
  }
}

// The boundaries of two solids meet in loops.
TEST(BodyContours, SolidsMeetInLoops) {
  std::mt19937 random(5);
  const auto number = [&](double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); };
  const auto direction = [&] { return glm::normalize(Vec3(number(-1, 1), number(-1, 1), number(-1, 1))); };
  const auto solid = [&](int kind) {
    Frame frame = frame_from({0, 0, 0}, direction(), direction());
    frame.origin = 0.5 * Vec3(number(-1, 1), number(-1, 1), number(-1, 1));
    const double r = number(0.6, 1.4), h = number(0.8, 2.5);
    switch (kind % 5) {
      case 0:
        return box(frame, {r, h, number(0.7, 2)});
      case 1:
        return frustum(frame, r, r, h);
      case 2:
        return frustum(frame, r, r * number(0.2, 0.8), h);
      case 3:
        return ball(frame, r);
      default:
        return torus_body(frame, r, r * number(0.2, 0.7));
    }
  };
  int loops = 0, incomplete = 0, pairs = 0;
  for (int k = 0; k < tests::tier_count(2000, tests::min_of_slow(100)); ++k, ++pairs) {
    const BodyContours found = intersect(solid(k), solid(k / 5));
    if (!found.complete) {
      ++incomplete;
      continue;
    }
    for (const BodyContour& branch : found.branches) {
      ++loops;
      EXPECT_TRUE(branch.closed) << "pair " << k;
      check_chain(branch);
    }
  }
  EXPECT_LE(incomplete, pairs / 50);
  EXPECT_GT(loops, pairs / 2);
  tests::report_figure("loops", loops);
  tests::report_figure("incomplete", incomplete);
}

}  // namespace
}  // namespace lekalo::geometry::body_contours_test
