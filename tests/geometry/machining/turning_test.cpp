// Passes of turning against their formula written out, and orders of holes against all orders (Zavyalov et al. 1985,
// V.3).
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/polyline.h"
#include "geometry/describe.h"
#include "geometry/machining/drilling_order.h"
#include "geometry/machining/turning_pass.h"
#include "tests/geometry/curves/curve_checks.h"

namespace lekalo::geometry::turning_test {
namespace {

CurvePtr built(const Fields& fields) {
  for (const TypeDeclaration& type : geometry_types())
    if (type.name == "turning_pass") return std::any_cast<CurvePtr>(type.build(fields));
  return nullptr;
}

// x = 3 t + t^2, y = 1 + t/2 - t^2/2, below a circle of radius 5 about (2, 0) that runs against x.
Fields fields(int passes, int pass) {
  const std::vector<Vec3> points = {{0, 1, 0}, {1.5, 1.25, 0}, {4, 1, 0}};
  const CurvePtr part = std::make_shared<NurbsCurve>(
      NurbsCurveForm{2, {0, 0, 0, 1, 1, 1}, {Vec4(points[0], 1), Vec4(points[1], 1), Vec4(points[2], 1)}, {}});
  Frame frame;
  frame.origin = {2, 0, 0};
  const CurvePtr blank = std::make_shared<Circle>(frame, 5, Interval(0.3, kPi - 0.3));
  Fields result;
  result.set("of", part);
  result.set("blank", blank);
  result.set("passes", passes);
  result.set("pass", pass);
  result.set("feed_direction", std::string("right"));
  return result;
}

struct Pass {
  double share;
  template <class T>
  Triple<T> operator()(const T& t) const {
    const T x = T(3.0) * t + t * t, y = T(1.0) + T(0.5) * t - T(0.5) * t * t;
    return {x, T(1 - share) * sqrt(T(25.0) - (x - T(2.0)) * (x - T(2.0))) + T(share) * y, T(0.0)};
  }
};

TEST(TurningPass, FollowsItsFormula) {
  for (const int k : {0, 1, 2, 3, 4}) {
    const CurvePtr pass = built(fields(4, k));
    checks::check_derivatives(*pass, Pass{k / 4.0}, pass->domain(), 1e-12);
    checks::check_enclosures(*pass, pass->domain());
  }
}

TEST(TurningPass, AnEllipticEdgeTouchesTheProfile) {
  Fields with_edge = fields(4, 2);
  with_edge.set("edge", std::vector<double>{0.4, 0.2});
  const CurvePtr center = built(with_edge), pass = built(fields(4, 2));
  for (int k = 0; k <= 20; ++k) {
    const double t = k / 20.0;
    const Vec3 off = pass->point(t) - center->point(t), along = pass->evaluate(t, 1).d[1];
    // The profile's point lies on the ellipse, and its tangent is the ellipse's there.
    EXPECT_NEAR(off.x * off.x / 0.16 + off.y * off.y / 0.04, 1, 1e-12);
    EXPECT_NEAR(off.x / 0.16 * along.x + off.y / 0.04 * along.y, 0, 1e-11);
    EXPECT_LT(off.y, 0);
  }
  checks::check_differences(*center, center->domain(), 3, 1e-6);
  checks::check_enclosures(*center, center->domain());
}

TEST(TurningPass, PassesTogetherRemoveTheBlank) {
  double sum = 0;
  for (int k = 1; k <= 4; ++k) {
    const CurvePtr pass = built(fields(4, k));
    const TurningPlan* plan = plan_of<TurningPlan>(*pass).plan;
    sum += removed_volume(*plan->before, *plan->profile).value;
  }
  // pi int_0^4 25 - (x - 2)^2 dx - pi int_0^1 y^2 x' dt, by Simpson's rule, which is exact enough in 4000 parts.
  long double part = 0;
  const int n = 4000;
  for (int k = 0; k <= n; ++k) {
    const long double t = static_cast<long double>(k) / n, y = 1 + t / 2 - t * t / 2;
    part += (k == 0 || k == n ? 1 : k % 2 == 1 ? 4 : 2) * y * y * (3 + 2 * t) / (3.0L * n);
  }
  EXPECT_NEAR(sum, static_cast<double>(kPi * (100 - 16.0L / 3 - part)), 1e-9);
}

TEST(TurningPass, PlacesOfTheToolAreNoFartherApartThanTheFeed) {
  const CurvePtr pass = built(fields(4, 1));
  for (const bool forward : {true, false}) {
    const std::vector<FeedPoint> points = feed_points(*pass, 0.07, 0.1, forward);
    EXPECT_NEAR(points.front().point.x, forward ? 0 : 4, 1e-12);
    EXPECT_NEAR(points.back().point.x, forward ? 4 : 0, 1e-12);
    for (size_t k = 0; k < points.size(); ++k) {
      EXPECT_NEAR(points[k].depth * std::cos(points[k].slope), 0.1, 1e-14);
      if (k > 0) {
        EXPECT_LE(glm::length(points[k].point - points[k - 1].point), 0.07 * (1 + 1e-8));
      }
    }
  }
}

TEST(TurningPass, TellsWhereTheToolDoesNotReach) {
  Fields steep = fields(1, 1);
  steep.set("tool_angle", 0.05);
  EXPECT_THROW(built(steep), FieldError);
  steep.set("feed_direction", std::string("left"));
  EXPECT_THROW(built(steep), FieldError);
  steep.set("tool_angle", 0.5);
  EXPECT_NO_THROW(built(steep));
}

DrillingTask random_task(int holes, bool closed, std::mt19937& random) {
  std::uniform_real_distribution<double> place(0, 10);
  DrillingTask task;
  for (int k = 0; k < holes; ++k) {
    task.holes.push_back({place(random), place(random), 0});
    task.tools.push_back(k % 3);
  }
  task.tool_change = 2;
  task.speed = 1.5;
  task.closed = closed;
  return task;
}

TEST(DrillingOrder, TwoOptNeverLengthens) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 40; ++trial) {
    const DrillingTask task = random_task(4 + trial, trial % 2 == 0, random);
    const std::vector<int> nearest = nearest_order(task), order = two_opt(task, nearest);
    EXPECT_LE(task.time(order), task.time(nearest) + 1e-12);
    EXPECT_EQ(order.front(), 0);
    std::vector<int> sorted = order;
    std::sort(sorted.begin(), sorted.end());
    for (size_t k = 0; k < sorted.size(); ++k) EXPECT_EQ(sorted[k], static_cast<int>(k));
    EXPECT_NEAR(task.time(two_opt(task, order)), task.time(order), 1e-12);
  }
}

TEST(DrillingOrder, IsNoShorterThanTheBestOfAll) {
  std::mt19937 random(6);
  for (int trial = 0; trial < 10; ++trial) {
    const DrillingTask task = random_task(7, trial % 2 == 0, random);
    std::vector<int> all{0, 1, 2, 3, 4, 5, 6};
    double least = kInfinity;
    do least = std::min(least, task.time(all));
    while (std::next_permutation(all.begin() + 1, all.end()));
    EXPECT_GE(task.time(two_opt(task, nearest_order(task))), least - 1e-12);
  }
}

}  // namespace
}  // namespace lekalo::geometry::turning_test
