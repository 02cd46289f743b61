// Where circles cross in the picture, by closed form: those that touch from inside or outside, nearly touch, or cross
// at small angles; at places of their own where pieces begin, too.
#include "render/drawing/visibility/picture_crossings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/splines/bezier_curve.h"
#include "render/cameras/cameras.h"
#include "support/tier.h"
#include "support/worst.h"

namespace lekalo::render::picture_crossings_test {
namespace {

using geometry::Affine;
using geometry::Circle;
using geometry::Frame;

constexpr double kSize = 400;  // pixels, one for each unit

struct Found {
  std::vector<Vec2> places;
  int touching = 0;
};

Found crossings(const geometry::CurvePtr& a, const geometry::CurvePtr& b) {
  const CameraPtr camera =
      make_camera(ParallelView{{0, 0, 1000}, {}, {0, 1, 0}, kSize}, static_cast<int>(kSize), static_cast<int>(kSize));
  const ProjectedCurve of_a(a, Affine(), *camera, 0.01), of_b(b, Affine(), *camera, 0.01);
  const PictureCrossings known({&of_b}, kSize, kSize);
  Found found;
  known.with(
      of_a, [](int) { return false; },
      [&](int, const PictureCrossing& crossing) {
        EXPECT_LE(glm::length(of_a.place(crossing.t).p - of_b.place(crossing.t_other).p), 1e-4);
        found.touching += crossing.touching;
        const Vec2 place = of_a.place(crossing.t).p;
        for (const Vec2& one : found.places)
          if (glm::length(one - place) < 1e-6) return;
        found.places.push_back(place);
      });
  return found;
}

TEST(PictureCrossings, OfCirclesThatTouch) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(0, 1);
  double largest = 0;
  for (int k = 0; k < tests::tier_count(40000, 400); ++k) {
    const double large = 60 + 40 * unit(random), small = 10 + 45 * unit(random);
    const bool inside = k % 2 == 0, plain = k % 5 == 0;
    // By so much they are deeper in one another than circles that touch: 0.1 to 1e-5 pixels.
    const int kind = k % 3 - 1;
    const double by = kind * std::pow(10, -1 - 4 * unit(random));
    const double distance = inside ? large - small + by : large + small - by;
    const double angle = plain ? geometry::kPi / 2 * (k % 4) : geometry::kTwoPi * unit(random);
    const Vec3 way(std::cos(angle), std::sin(angle), 0), crosswise(-way.y, way.x, 0);
    const auto circle = [&](const Vec3& center, double radius) {
      const double turn = plain ? 0 : geometry::kTwoPi * unit(random);
      const Vec3 x(std::cos(turn), std::sin(turn), 0);
      return std::make_shared<Circle>(Frame{center, x, {-x.y, x.x, 0}, {0, 0, 1}}, radius);
    };
    const Found found = crossings(circle(Vec3(0), large), circle(distance * way, small));
    if (kind < 0) {
      EXPECT_TRUE(found.places.empty()) << k << " apart by " << by;
      continue;
    }
    const double along = (distance * distance + large * large - small * small) / (2 * distance);
    const double across = kind == 0 ? 0 : std::sqrt(large * large - along * along);
    const auto picture = [&](double y) {
      const Vec3 p = (kind == 0 ? large : along) * way + y * crosswise;
      return Vec2(0.5 * kSize + p.x, 0.5 * kSize - p.y);
    };
    for (const double side : {-1.0, 1.0}) {
      double nearest = geometry::kInfinity;
      for (const Vec2& place : found.places) nearest = std::min(nearest, glm::length(place - picture(side * across)));
      EXPECT_LT(nearest, kind == 0 ? 1e-4 : 1e-6) << k << " by " << by << (inside ? " inside" : " outside");
      if (kind > 0) largest = tests::worse(largest, nearest);
    }
    if (kind > 0) {
      EXPECT_EQ(found.places.size(), 2u) << k << " by " << by;
    }
    for (const Vec2& place : found.places)
      EXPECT_LT(std::min(glm::length(place - picture(across)), glm::length(place - picture(-across))),
                kind == 0 ? 1e-3 : 1e-6)
          << k << " by " << by;
  }
  tests::report_figure("largest_error_pixels", largest);
}

// Two arcs that begin at one place, their directions there by some angle apart or the same: go on in one another, turn
// back (a cusp), or make a corner. Where they have one direction that place is all that their circles have in common.
TEST(PictureCrossings, OfArcsThatMeetAtTheirEnds) {
  std::mt19937 random(21);
  std::uniform_real_distribution<double> unit(0, 1);
  int touching = 0;
  for (int k = 0; k < tests::tier_count(40000, 400); ++k) {
    const double turn = geometry::kTwoPi * unit(random);
    // On from one another; back along one another, the circles apart from there on; and a corner between.
    const int kind = k % 3;
    const double angle = kind == 0 ? geometry::kPi : kind == 1 ? 0 : geometry::kPi * (0.1 + 0.8 * unit(random));
    const Vec3 joint(40 * unit(random) - 20, 40 * unit(random) - 20, 0);
    // Leaves the joint in a direction and bends to one side.
    const auto arc = [&](double direction, double radius, double side) {
      const Vec3 way(std::cos(direction), std::sin(direction), 0), to_center = side * Vec3(-way.y, way.x, 0);
      const double length = 0.25 * geometry::kPi * (0.1 + 0.9 * unit(random));
      const bool backwards = unit(random) < 0.5;
      const Frame from_joint{joint + radius * to_center, -to_center, way, {0, 0, side}};
      if (!backwards) return std::make_shared<Circle>(from_joint, radius, geometry::Interval(0, length));
      const Frame to_joint{joint + radius * to_center, -to_center, -way, {0, 0, -side}};
      return std::make_shared<Circle>(to_joint, radius, geometry::Interval(-length, 0));
    };
    const double side = k % 2 ? 1 : -1, radius = 20 + 80 * unit(random);
    // Of those that turn back the second bends more to the same side, or to the other one.
    const bool same = unit(random) < 0.5;
    const auto first = arc(turn, radius, side);
    const auto second = kind == 1 ? arc(turn, same ? 0.7 * radius : radius, same ? side : -side)
                                  : arc(turn + angle, 20 + 80 * unit(random), k % 4 < 2 ? 1 : -1);
    const Found found = crossings(first, second);
    touching += found.touching > 0;
    const Vec2 place(0.5 * kSize + joint.x, 0.5 * kSize - joint.y);
    if (kind == 2) {
      // Two circles have two places in common at most.
      EXPECT_GE(found.places.size(), 1u) << k;
      EXPECT_LE(found.places.size(), 2u) << k;
      EXPECT_TRUE(std::any_of(found.places.begin(), found.places.end(), [&](const Vec2& one) {
        return glm::length(one - place) < 1e-4;
      })) << k;
      continue;
    }
    // Along one another they are as near as what touches for a while: their curvatures tell how long.
    const double apart = (same ? 1 / 0.7 - 1 : 2) / radius;
    EXPECT_GE(found.places.size(), 1u) << k;
    if (kind == 0) {
      EXPECT_EQ(found.places.size(), 1u) << k;
    }
    for (const Vec2& one : found.places)
      EXPECT_LT(glm::length(one - place), kind == 0 ? 1e-4 : std::sqrt(2 * 1e-4 / apart) + 1e-4) << k;
  }
  tests::report_figure("joints_that_touch", touching);
}

// Two curves that begin at one place in one direction, bent by curvatures that differ little, run within some 1e-4 to
// 1e-7 pixels of one another and cross: y = b x^2 and y = b x^2 + c x^2 (x - x1).
TEST(PictureCrossings, OfCurvesThatCrossAtNearlyNoAngle) {
  std::mt19937 random(23);
  std::uniform_real_distribution<double> unit(0, 1);
  double largest = 0;
  for (int k = 0; k < tests::tier_count(40000, 400); ++k) {
    const double turn = geometry::kTwoPi * unit(random), length = 10, bend = 0.02 * unit(random);
    const Vec3 way(std::cos(turn), std::sin(turn), 0), side(-way.y, way.x, 0);
    const Vec3 begin(40 * unit(random) - 20, 40 * unit(random) - 20, 0);
    const double crossing = 0.3 + 2 * unit(random), depth = std::pow(10, -4 - 3 * unit(random));
    const double third = 27 * depth / (4 * std::pow(crossing, 3));
    // b x^2 + a x^3 has the blossom b (x1 x2 + x2 x3 + x3 x1)/3 + a x1 x2 x3.
    const auto graph = [&](double b, double a) {
      std::vector<Vec3> net;
      const double ordinates[] = {0, 0, b * length * length / 3, b * length * length + a * std::pow(length, 3)};
      for (int i = 0; i <= 3; ++i) net.push_back(begin + length * i / 3 * way + ordinates[i] * side);
      return std::make_shared<geometry::NurbsCurve>(geometry::bezier_curve(net));
    };
    const auto line = graph(bend, 0), curve = graph(bend - third * crossing, third);
    const Found found = k % 2 ? crossings(curve, line) : crossings(line, curve);
    const Vec3 at = begin + crossing * way + bend * crossing * crossing * side;
    const Vec2 place(0.5 * kSize + at.x, 0.5 * kSize - at.y);
    double off = geometry::kInfinity;
    for (const Vec2& one : found.places) off = std::min(off, glm::length(one - place));
    EXPECT_LT(off, 1e-4) << k << ": " << found.places.size();
    largest = tests::worse(largest, off);
  }
  tests::report_figure("largest_error_pixels", largest);
}

// Circles about one place whose radii differ by 1e-3 to 1 pixels run side by side all around.
TEST(PictureCrossings, OfCirclesSideBySide) {
  std::mt19937 random(22);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int k = 0; k < tests::tier_count(4000, 100); ++k) {
    const double radius = 20 + 120 * unit(random), by = std::pow(10, -3 * unit(random));
    const auto circle = [&](double r) {
      const double turn = geometry::kTwoPi * unit(random);
      const Vec3 x(std::cos(turn), std::sin(turn), 0);
      return std::make_shared<Circle>(Frame{Vec3(0), x, {-x.y, x.x, 0}, {0, 0, 1}}, r);
    };
    EXPECT_TRUE(crossings(circle(radius), circle(radius + by)).places.empty()) << k << " apart by " << by;
  }
}

}  // namespace
}  // namespace lekalo::render::picture_crossings_test
