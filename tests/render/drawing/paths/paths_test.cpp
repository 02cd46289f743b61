// Paths of pictures: arcs are told where circles and their kin are seen and nowhere else; what goes on is one path.
#include "render/drawing/paths/paths.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/splines/bezier_curve.h"
#include "render/drawing/paths/ellipse_fit.h"
#include "render/drawing/paths/joined_paths.h"
#include "render/drawing/random_views.h"
#include "support/worst.h"

namespace lekalo::render::paths_test {
namespace {

using namespace geometry;

constexpr double kTolerance = 0.01;  // pixels

int count(const Path& path, PathStep::Kind kind) {
  return static_cast<int>(
      std::count_if(path.steps.begin(), path.steps.end(), [&](const PathStep& step) { return step.kind == kind; }));
}

// The largest distance of the curve's places from the path.
double distance(const ProjectedCurve& curve, const Interval& t, const Path& path) {
  std::vector<Vec2> places{path.from};
  for (const PathStep& step : path.steps) {
    const Vec2 begin = places.back();
    for (int k = 1; k <= 4000; ++k) places.push_back(point_on(begin, step, k / 4000.0));
  }
  double worst = 0;
  for (int k = 0; k <= 50; ++k) {
    const Vec2 p = curve.place(t.lo + t.width() * k / 50).p;
    double nearest = kInfinity;
    for (const Vec2& q : places) nearest = std::min(nearest, glm::length(p - q));
    worst = tests::worse(worst, nearest);
  }
  return worst;
}

class PathsOfCurves : public ::testing::Test {
 protected:
  Path path_of(const CurvePtr& curve, const Interval& t) {
    SmallScene scene;
    views_.look(scene, central_ = !central_);
    const ProjectedCurve picture(curve, Affine(), *scene.model.camera, 1);
    const Path path = fitted_path(picture, t, {}, kTolerance);
    worst_ = distance(picture, t, path);
    return path;
  }
  Views views_{5};
  bool central_ = false;
  double worst_ = 0;
};

TEST_F(PathsOfCurves, CirclesAreArcs) {
  for (int k = 0; k < 40; ++k) {
    const Frame frame = frame_from({views_.number(-1, 1), 0.3, 0}, views_.direction(), views_.direction());
    const auto circle = std::make_shared<Circle>(frame, views_.number(0.2, 2));
    const Path whole = path_of(circle, circle->domain());
    EXPECT_EQ(count(whole, PathStep::Kind::arc), 4);
    EXPECT_EQ(whole.steps.size(), 4u);
    EXPECT_TRUE(whole.closed);
    EXPECT_LT(worst_, 1.1);  // between places of the arcs; a chord of a wrong arc would be tens of pixels off
    const Interval part{views_.number(0, 2), views_.number(3, 6)};
    const Path some = path_of(circle, part);
    EXPECT_EQ(count(some, PathStep::Kind::arc), static_cast<int>(some.steps.size()));
    EXPECT_FALSE(some.closed);
    // As cubics, and the other way round, it is the same.
    const Path cubics = without_arcs(some, 1e-3), back = reversed(some);
    EXPECT_EQ(count(cubics, PathStep::Kind::arc), 0);
    EXPECT_EQ(cubics.end(), some.end());
    EXPECT_EQ(back.from, some.end());
    EXPECT_EQ(back.end(), some.from);
    EXPECT_LT(glm::length(point_on(back.from, back.steps[0], 0.3) -
                          point_on(some.steps.size() > 1 ? some.steps[some.steps.size() - 2].to : some.from,
                                   some.steps.back(), 0.7)),
              1e-9);
    Vec2 from = cubics.from;
    for (const PathStep& step : cubics.steps) {
      // Its middle lies on the ellipse.
      const PictureEllipse& e = some.steps[0].ellipse;
      const Vec2 off = point_on(from, step, 0.5) - e.center;
      const double x = glm::dot(off, e.x) / glm::dot(e.x, e.x), y = glm::dot(off, e.y) / glm::dot(e.y, e.y);
      EXPECT_NEAR(std::hypot(x, y), 1, 1e-3);
      from = step.to;
    }
  }
}

TEST_F(PathsOfCurves, OthersAreNot) {
  const std::vector<Vec3> points{{-2, 0, 0}, {-1, 2, 1}, {1, -2, 0}, {2, 0, 1}};
  const auto cubic = std::make_shared<NurbsCurve>(bezier_curve(points));
  const auto spiral =
      std::make_shared<NurbsCurve>(bezier_curve(std::vector<Vec3>{{2, 0, 0}, {2, 2, 0}, {-2, 2, 0.1}, {-2, 0, 0}}));
  for (int k = 0; k < 20; ++k) {
    EXPECT_EQ(count(path_of(spiral, spiral->domain()), PathStep::Kind::arc), 0);
    EXPECT_EQ(count(path_of(cubic, cubic->domain()), PathStep::Kind::arc), 0);
  }
}

TEST_F(PathsOfCurves, StraightLinesAreOne) {
  for (int k = 0; k < 400; ++k) {
    const auto segment = std::make_shared<Segment>(2.0 * views_.direction(), 3.0 * views_.direction());
    const Path path = path_of(segment, k % 2 == 0 ? segment->domain() : Interval{0.1, views_.number(0.2, 1)});
    ASSERT_EQ(path.steps.size(), 1u) << k;
    EXPECT_EQ(path.steps[0].kind, PathStep::Kind::line) << k;
  }
}

// A line towards the eye is a point, to the eye and beyond too; one that passes it is straight as far as it is seen.
TEST(PathsOfLines, ThroughTheEye) {
  const Vec3 eye(5, 0, 0);
  const CameraPtr camera = make_camera(PerspectiveView{eye, {0, 0.5, 0.2}, {0, 0, 1}, 0.7}, 600, 450);
  const auto through = std::make_shared<Segment>(Vec3(-3, 0, 0), Vec3(8, 0, 0));
  const ProjectedCurve picture(through, Affine(), *camera, 1);
  ASSERT_FALSE(picture.cells().empty());
  const Vec2 point = picture.cells().front().begin;
  for (const ProjectedCurve::Cell& cell : picture.cells())
    EXPECT_LT(std::max(glm::length(cell.begin - point), glm::length(cell.end - point)), kTolerance);
  EXPECT_NEAR(picture.cells().back().t.hi, 8.0 / 11, 1e-9);
}

TEST(EllipticArc, IsToldFromPlaces) {
  const PictureEllipse ellipse{
      {300, 200}, {80 * std::cos(0.4), 80 * std::sin(0.4)}, {-30 * std::sin(0.4), 30 * std::cos(0.4)}};
  for (const double turn : {0.2, 1.0, 3.0, 6.2, kTwoPi, -2.0, -kTwoPi}) {
    std::vector<Vec2> places;
    for (int k = 0; k <= 20; ++k) places.push_back(ellipse.point(0.7 + turn * k / 20));
    const auto found = elliptic_arc(places, 1e-6, 0.1);
    ASSERT_TRUE(found) << turn;
    const double a = glm::length(found->ellipse.x), b = glm::length(found->ellipse.y);
    EXPECT_NEAR(std::max(a, b), 80, 1e-4);
    EXPECT_NEAR(std::min(a, b), 30, 1e-4);
    EXPECT_NEAR(glm::length(found->ellipse.center - ellipse.center), 0, 1e-4);
    EXPECT_NEAR(glm::length(found->ellipse.point(found->begin) - places.front()), 0, 1e-6);
    EXPECT_NEAR(glm::length(found->ellipse.point(found->end) - places.back()), 0, 1e-6);
    EXPECT_FALSE(elliptic_arc(places, 1e-6, std::abs(turn) * 1.2));
    // One place off it is none; nor forth and back again.
    std::vector<Vec2> off = places;
    off[13] += Vec2(0.01, 0);
    EXPECT_FALSE(elliptic_arc(off, 1e-6, 0.1));
    off = places;
    for (int k = 20; k-- > 0;) off.push_back(places[k]);
    EXPECT_FALSE(elliptic_arc(off, 1e-6, 0.1));
  }
  EXPECT_FALSE(elliptic_arc(std::vector<Vec2>(20, Vec2(1, 2)), 1e-6, 0.1));
}

PathInSpace side(const Vec2& from, const Vec2& to, double depth = 0) {
  Path path;
  path.from = from;
  path.steps = {line_to(to)};
  return {path, Vec3(from, depth), Vec3(to, depth)};
}

TEST(JoinedPaths, GoOnWhereTheyMeet) {
  // A square, one side the other way round.
  const auto square =
      joined({side({0, 0}, {4, 0}), side({4, 4}, {4, 0}), side({4, 4}, {0, 4}), side({0, 4}, {0, 0})}, 1e-6);
  ASSERT_EQ(square.size(), 1u);
  EXPECT_EQ(square[0].path.steps.size(), 4u);
  EXPECT_TRUE(square[0].path.closed);
  EXPECT_EQ(square[0].path.from, Vec2(0, 0));
  EXPECT_EQ(square[0].path.steps[1].to, Vec2(4, 4));
  // Of three that meet the straight ones.
  const auto tee = joined({side({0, 0}, {4, 0}), side({4, 0}, {4, 3}), side({4, 0}, {9, 0})}, 1e-6);
  ASSERT_EQ(tee.size(), 2u);
  EXPECT_EQ(tee[0].path.end(), Vec2(9, 0));
  EXPECT_EQ(tee[1].path.end(), Vec2(4, 3));
  EXPECT_EQ(joined({side({0, 0}, {4, 0}), side({4, 0}, {4, 3}), side({4, 0}, {2, 4})}, 1e-6).size(), 3u);
  // One behind the other only looks so.
  EXPECT_EQ(joined({side({0, 0}, {4, 0}), side({4, 0}, {4, 3}, 1)}, 1e-6).size(), 2u);
  // Cut where something lies over it.
  auto cut = side({4, 0}, {9, 0});
  cut.begin.reset();
  EXPECT_EQ(joined({side({0, 0}, {4, 0}), cut}, 1e-6).size(), 2u);
  // A chain that is given from its middle on.
  const auto chain = joined({side({4, 0}, {6, 1}), side({6, 1}, {9, 0}), side({4, 0}, {0, 3})}, 1e-6);
  ASSERT_EQ(chain.size(), 1u);
  EXPECT_EQ(chain[0].path.from, Vec2(0, 3));
  EXPECT_EQ(chain[0].path.end(), Vec2(9, 0));
  EXPECT_EQ(chain[0].begin, Vec3(0, 3, 0));
  EXPECT_EQ(chain[0].end, Vec3(9, 0, 0));
}

TEST(JoinedPaths, CornersOfThree) {
  const std::vector<PathInSpace> paths{side({0, 0}, {4, 0}), side({4, 0}, {4, 3}), side({2, 4}, {4, 0}),
                                       side({4, 3}, {9, 9}, 1)};
  EXPECT_EQ(ends_at_corners(paths, 1e-6), (std::vector<bool>{true, true, true, false}));
}

}  // namespace
}  // namespace lekalo::render::paths_test
