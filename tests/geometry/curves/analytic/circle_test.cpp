#include "geometry/curves/analytic/circle.h"

#include "geometry/curves/curve_checks.h"

namespace lekalo::geometry::circle_test {
namespace {

using checks::distance;

TEST(Circle, KeepsItsRadiusAndMeetsTheGeneralChecks) {
  const Frame frame = frame_about({1000, -2, 5}, {0.2, -0.5, 1});
  for (const Interval arc : {Interval(0, kTwoPi), Interval(-1, 0.25), Interval(2, 2 + 1.5 * kPi)}) {
    const Circle circle(frame, 2.5, arc);
    for (double t = arc.lo; t < arc.hi; t += 0.1) EXPECT_NEAR(distance(circle.point(t), frame.origin), 2.5, 1e-12);
    checks::check_enclosures(circle, arc);
    checks::check_nurbs(circle);
    checks::check_pieces(circle);
    checks::check_period(circle);
  }
}

// The half-angle map against published angles of the quarter circle: s = 0.25 gives (0.92978..., 0.36809...)
// (Golovanov 2016, 2.5).
TEST(Circle, QuarterHasThePublishedPoint) {
  const Circle quarter(Frame(), 1, {0, kPi / 2});
  const auto pieces = quarter.pieces();
  ASSERT_EQ(pieces.size(), 1u);
  const double t = pieces[0].map.natural_of_bezier(0.25);
  EXPECT_LE(distance(quarter.point(t), {0.929788301062430, 0.368094709561873, 0}), 1e-15 * 5);
}

TEST(Circle, ArcThroughThreePointsRunsFromTheFirstThroughTheSecondToTheThird) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 200; ++i) {
    const auto point = [&] { return Vec3(uniform(random), uniform(random), uniform(random)); };
    const Vec3 a = point(), b = point(), c = point();
    const Circle arc = arc_through(a, b, c);
    const double slack = 1e-13 * (1 + arc.radius());
    EXPECT_LE(distance(arc.point(0), a), slack);
    EXPECT_LE(distance(arc.point(arc.domain().hi), c), slack);
    const Vec3 local = arc.frame().to_local_point(b);
    double t = std::atan2(local.y, local.x);
    if (t < 0) t += kTwoPi;
    EXPECT_LT(t, arc.domain().hi);
    EXPECT_LE(distance(arc.point(t), b), slack);
  }
  EXPECT_THROW(arc_through({0, 0, 0}, {1, 1, 1}, {3, 3, 3}), std::invalid_argument);
  EXPECT_THROW(arc_through({0, 0, 0}, {1, 1, 1}, {0, 0, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace lekalo::geometry::circle_test
