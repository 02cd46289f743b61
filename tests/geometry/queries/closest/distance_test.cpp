// Distances with all local minima: analytic pairs, bodies, and random pairs against a search that shares no code with
// it.
#include "geometry/queries/closest/distance.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/bodies/trims/trimmed_surface.h"
#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/polyline.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/splines/bezier_curve.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/surfaces/splines/bezier_surface.h"
#include "support/distance_oracle.h"
#include "support/tier.h"

namespace lekalo::geometry::distance_test {
namespace {

void expect_certain(const Distance& found, double distance) {
  EXPECT_NEAR(found.distance, distance, 4e-15 * std::max(1.0, distance));
  EXPECT_LE(found.bound, found.distance);
  EXPECT_GE(found.bound, found.distance - 1e-13);
}

TEST(CurveDistance, OfSkewSegments) {
  const Segment a({0, 0, 0}, {4, 0, 0}), b({1, -1, 1}, {1, 3, 1}), behind({5, -1, 1}, {5, 3, 1});
  const Distance inside = distance(&a, &b);
  expect_certain(inside, 1);
  ASSERT_EQ(inside.minima.size(), 1u);
  EXPECT_TRUE(inside.minima[0].isolated);
  EXPECT_NEAR(inside.minima[0].a.t, 0.25, 1e-15);
  EXPECT_NEAR(inside.minima[0].b.t, 0.25, 1e-15);
  const Distance end = distance(&a, &behind);
  expect_certain(end, std::sqrt(2.0));
  ASSERT_EQ(end.minima.size(), 1u);
  EXPECT_EQ(end.minima[0].a.t, 1);
}

TEST(CurveDistance, OfParallelSegmentsIsNotIsolated) {
  const Segment a({0, 0, 0}, {4, 0, 0}), b({1, 2, 0}, {6, 2, 0}), far({5, 0, 0}, {6, 0, 0});
  const Distance found = distance(&a, &b);
  expect_certain(found, 2);
  ASSERT_EQ(found.minima.size(), 1u);
  EXPECT_FALSE(found.minima[0].isolated);
  EXPECT_NEAR(found.minima[0].range_a[0].lo, 0.25, 1e-15);
  EXPECT_NEAR(found.minima[0].range_a[0].hi, 1, 1e-15);
  EXPECT_NEAR(found.minima[0].range_b[0].lo, 0, 1e-15);
  EXPECT_NEAR(found.minima[0].range_b[0].hi, 0.6, 1e-15);
  const Distance in_line = distance(&a, &far);
  expect_certain(in_line, 1);
  ASSERT_EQ(in_line.minima.size(), 1u);
  EXPECT_TRUE(in_line.minima[0].isolated);
}

TEST(CurveDistance, OfCirclesAcrossEachOther) {
  // In the planes z = 0 and x = 5: nearest where (5 - 2 cos t)^2 + (2 sin t -+ 1)^2 is least, t = atan(1 / 5).
  const Circle a(Frame(), 2), b(frame_about({5, 0, 0}, {1, 0, 0}), 1);
  const Distance found = distance(&a, &b);
  expect_certain(found, std::sqrt(26.0) - 2);
  ASSERT_EQ(found.minima.size(), 2u);
  EXPECT_NEAR(found.minima[1].distance, found.distance, 1e-14);
}

TEST(CurveDistance, OfCoaxialCirclesIsTheSameAllAround) {
  Frame up;
  up.origin = {0, 0, 3};
  const Circle a(Frame(), 2), b(up, 1);
  const Distance found = distance(&a, &b);
  EXPECT_NEAR(found.distance, std::sqrt(10.0), 1e-14);
  EXPECT_LE(found.bound, found.distance);
  EXPECT_GT(found.bound, found.distance - 1e-2);
  ASSERT_EQ(found.minima.size(), 1u);
  EXPECT_FALSE(found.minima[0].isolated);
  EXPECT_EQ(found.minima[0].range_a[0], a.domain());
  EXPECT_EQ(found.minima[0].range_b[0], b.domain());
}

TEST(CurveDistance, IntersectionsAreMinima) {
  const Circle circle(Frame(), 2);
  const Segment chord({-3, 1, 0}, {3, 1, 0}), tangent({-3, 2, 0}, {3, 2, 0});
  const Distance crossing = distance(&circle, &chord);
  EXPECT_TRUE(crossing.meet);
  EXPECT_EQ(crossing.distance, 0);
  ASSERT_GE(crossing.minima.size(), 2u);
  EXPECT_NEAR(crossing.minima[0].a.point.y, 1, 1e-15);
  EXPECT_NEAR(crossing.minima[1].a.point.y, 1, 1e-15);
  const Distance touching = distance(&circle, &tangent);
  EXPECT_TRUE(touching.meet);
  EXPECT_NEAR(touching.minima[0].a.t, kPi / 2, 1e-5);
}

TEST(CurveDistance, OfAKinkAndAClosedPolyline) {
  const NurbsCurve square = polyline(std::vector<Vec3>{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, true);
  // Above a corner, seen diagonally: the corner is nearest.
  const Segment post({2, 2, -1}, {2, 2, 1});
  const Distance found = distance(&square, &post);
  expect_certain(found, std::sqrt(2.0));
  ASSERT_EQ(found.minima.size(), 1u);
  EXPECT_NEAR(found.minima[0].a.point.x, 1, 1e-15);
  // From inside all four sides are.
  const Segment axis({0, 0, -1}, {0, 0, 1});
  EXPECT_EQ(distance(&square, &axis).minima.size(), 4u);
}

TEST(CurveDistance, OfLongPolylinesIsThatOfTheirSegments) {
  std::vector<Vec3> p, q;
  for (int k = 0; k <= 100; ++k) {
    const double t = kTwoPi * k / 100;
    p.emplace_back(std::cos(t), std::sin(t), 0.1 * std::sin(7 * t));
    q.emplace_back(1.3 * std::cos(t), 0.9 * std::sin(t), 0.3 + 0.1 * std::cos(5 * t));
  }
  double least = kInfinity;
  for (size_t i = 0; i + 1 < p.size(); ++i)
    for (size_t k = 0; k + 1 < q.size(); ++k) {
      const Segment a(p[i], p[i + 1]), b(q[k], q[k + 1]);
      least = std::min(least, distance(&a, &b).distance);
    }
  const NurbsCurve a = polyline(p), b = polyline(q);
  const Distance all = distance(&a, &b), nearest = distance(&a, &b, DistanceMinima::nearest);
  expect_certain(all, least);
  expect_certain(nearest, least);
  EXPECT_EQ(nearest.minima.size(), 1u);
  EXPECT_TRUE(nearest.minima[0].isolated);
  EXPECT_NEAR(nearest.minima[0].a.t, 32, 1e-12);
}

TEST(CurveDistance, FromAPointIsThatOfItsFeet) {
  const Circle circle(Frame(), 2);
  const Distance found = distance(Vec3(3, 0, 4), &circle);
  expect_certain(found, std::sqrt(17.0));
  EXPECT_EQ(found.minima.size(), 1u);
  const Distance all = distance(Vec3(0, 0, 1), &circle);
  ASSERT_EQ(all.minima.size(), 1u);
  EXPECT_FALSE(all.minima[0].isolated);
}

TEST(SurfaceDistance, OfALineFromATorus) {
  // Above the top circle z = 1, rho = 3, along a chord at y = 1: nearest to the circle's points at its height.
  const TorusSurface torus(Frame(), 3, 1);
  const Segment line({-6, 1, 3}, {6, 1, 3});
  const Distance found = distance(&line, &torus);
  expect_certain(found, 2);
  ASSERT_EQ(found.minima.size(), 2u);
  EXPECT_NEAR(std::abs(found.minima[0].a.point.x), std::sqrt(8.0), 1e-7);
}

TEST(SurfaceDistance, OfSpheres) {
  const SphereSurface a(Frame(), 1), b(frame_about({3, 1, 0.5}, {0, 0, 1}), 1),
      above(frame_about({0, 0, 4}, {0, 0, 1}), 1), around(Frame(), 2), across(frame_about({1, 0, 0}, {0, 0, 1}), 1);
  const Distance apart = distance(&a, &b);
  expect_certain(apart, std::sqrt(10.25) - 2);
  EXPECT_EQ(apart.minima.size(), 1u);
  // Pole to pole.
  const Distance poles = distance(&a, &above);
  EXPECT_NEAR(poles.distance, 2, 1e-15);
  ASSERT_EQ(poles.minima.size(), 1u);
  EXPECT_TRUE(poles.minima[0].isolated);
  EXPECT_NEAR(poles.minima[0].a.point.z, 1, 1e-15);
  const Distance concentric = distance(&a, &around);
  EXPECT_NEAR(concentric.distance, 1, 1e-14);
  ASSERT_EQ(concentric.minima.size(), 1u);
  EXPECT_FALSE(concentric.minima[0].isolated);
  EXPECT_LE(concentric.bound, concentric.distance);
  const Distance intersection = distance(&a, &across);
  EXPECT_TRUE(intersection.meet);
  ASSERT_EQ(intersection.minima.size(), 1u);
  EXPECT_NEAR(glm::length(intersection.minima[0].a.point), 1, 1e-14);
  EXPECT_NEAR(glm::length(intersection.minima[0].a.point - Vec3(1, 0, 0)), 1, 1e-14);
}

TEST(SurfaceDistance, OfPlanes) {
  const Plane floor(Frame{}), tile(frame_about({0.5, 0.3, 2}, {0, 0, 1}), {{-1, 1}, {-1, 1}}),
      tilted(frame_about({0, 0, 5}, {1, 2, 8}), {{-1, 1}, {-1, 1}});
  const SphereSurface sphere(frame_about({7, 8, 4}, {1, 2, 3}), 1.5);
  const Distance parallel = distance(&tile, &floor);
  expect_certain(parallel, 2);
  ASSERT_EQ(parallel.minima.size(), 1u);
  EXPECT_FALSE(parallel.minima[0].isolated);
  EXPECT_NEAR(parallel.minima[0].range_a[0].lo, -1, 1e-12);
  EXPECT_NEAR(parallel.minima[0].range_a[1].hi, 1, 1e-12);
  expect_certain(distance(&sphere, &floor), 2.5);
  const Distance corner = distance(&tilted, &floor);
  double lowest = kInfinity;
  for (const double u : {-1, 1})
    for (const double v : {-1, 1}) lowest = std::min(lowest, tilted.point(u, v).z);
  expect_certain(corner, lowest);
  EXPECT_EQ(corner.minima.size(), 1u);
  EXPECT_TRUE(distance(&floor, &floor).meet);
  EXPECT_NEAR(distance(Vec3(1, 2, -3), &floor).distance, 3, 1e-15);
}

TEST(BodyDistance, OfBoxes) {
  const Body a = box(Frame(), {1, 1, 1}), beside = box(frame_about({3, 0.2, 0.4}, {0, 0, 1}), {1, 1, 1}),
             diagonal = box(frame_about({2, 2, 2}, {0, 0, 1}), {1, 1, 1}),
             inside = box(frame_about({0.25, 0.25, 0.3}, {0, 0, 1}), {0.5, 0.5, 0.5}),
             through = box(frame_about({0.5, 0.5, 0.5}, {1, 1, 1}), {1, 1, 1});
  const Distance faces = distance(&a, &beside, DistanceMinima::nearest);
  expect_certain(faces, 2);
  ASSERT_EQ(faces.minima.size(), 1u);
  EXPECT_FALSE(faces.minima[0].isolated);
  EXPECT_EQ(faces.minima[0].a.kind, DistancePlace::Kind::face);
  EXPECT_EQ(faces.minima[0].b.kind, DistancePlace::Kind::face);
  const Distance corners = distance(&a, &diagonal);
  expect_certain(corners, std::sqrt(3.0));
  EXPECT_EQ(corners.minima[0].a.kind, DistancePlace::Kind::vertex);
  EXPECT_TRUE(corners.minima[0].isolated);
  EXPECT_NEAR(distance(&a, &inside, DistanceMinima::nearest).distance, 0.2, 1e-15);
  EXPECT_TRUE(distance(&a, &through).meet);
}

TEST(BodyDistance, OfCylindersAndBalls) {
  const Body upright = cylinder_body(Frame(), 1, 2), beside = cylinder_body(frame_about({4, 0, 0}, {0, 0, 1}), 1, 2),
             ball_above = ball(frame_about({0.2, 0.3, 5}, {0, 0, 1}), 1),
             block = box(frame_about({2, -1, 0}, {0, 0, 1}), {2, 2, 2});
  const Distance parallel = distance(&upright, &beside, DistanceMinima::nearest);
  EXPECT_NEAR(parallel.distance, 2, 1e-14);
  ASSERT_EQ(parallel.minima.size(), 1u);
  EXPECT_FALSE(parallel.minima[0].isolated);
  EXPECT_NEAR(parallel.minima[0].range_a[1].lo, upright.faces[parallel.minima[0].a.index].surface->domain().v.lo, 1e-9);
  expect_certain(distance(&upright, &ball_above), 2);
  EXPECT_NEAR(distance(&upright, &block, DistanceMinima::nearest).distance, 1, 1e-14);
  // A point in the middle of a face, and one beside a rim.
  expect_certain(distance(Vec3(0.1, 0.2, 3), &upright), 1);
  expect_certain(distance(Vec3(2, 0, 3), &upright), std::sqrt(2.0));
}

TEST(BodyDistance, TheTipOfAConeIsAVertex) {
  const Body cone = frustum(frame_about({0.3, 0.2, 0.1}, {1, 2, 3}), 1, 0, 2);
  const Vec3 axis = glm::normalize(Vec3(1, 2, 3)), tip = Vec3(0.3, 0.2, 0.1) + 2.0 * axis;
  for (const Vec3& beside : {Vec3(0), Vec3(0.1, 0, 0), Vec3(0, -0.3, 0.2)}) {
    const Distance found = distance(tip + axis + beside, &cone, DistanceMinima::nearest);
    expect_certain(found, glm::length(axis + beside));
    ASSERT_EQ(found.minima.size(), 1u);
    EXPECT_TRUE(found.minima[0].isolated);
    EXPECT_EQ(found.minima[0].b.kind, DistancePlace::Kind::vertex);
  }
}

TEST(BodyDistance, TrimsAreKept) {
  // A square plate with a round hole over a point and a line that pass through the hole.
  const auto plane = std::make_shared<Plane>(Frame(), Rectangle{{-3, 3}, {-3, 3}});
  const std::vector<Curve2Ptr> curves{
      std::make_shared<NurbsCurve>(polyline(std::vector<Vec3>{{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}}, true)),
      std::make_shared<Circle>(Frame(), 1)};
  const Body plate = trimmed_surface(plane, curves);
  const Distance centre = distance(Vec3(0, 0.25, 0), &plate);
  expect_certain(centre, 0.75);
  ASSERT_EQ(centre.minima.size(), 1u);
  EXPECT_EQ(centre.minima[0].b.kind, DistancePlace::Kind::edge);
  const Segment needle({0.25, 0, -1}, {0.25, 0, 1}), above({0.25, 0, 1}, {1.5, 0, 1});
  expect_certain(distance(&needle, &plate), 0.75);
  const Distance flat = distance(&above, &plate);
  expect_certain(flat, 1);
  ASSERT_EQ(flat.minima.size(), 1u);
  EXPECT_FALSE(flat.minima[0].isolated);
  EXPECT_NEAR(flat.minima[0].range_a[0].lo, 0.6, 1e-12);
  EXPECT_NEAR(flat.minima[0].range_a[0].hi, 1, 1e-12);
}

TEST(BodyDistance, OfATrimmedSphereByItsRim) {
  // A round patch of the parameter plane: the foot point on the sphere where that lies in the patch, else on the rim.
  const auto sphere = std::make_shared<SphereSurface>(Frame(), 1);
  Frame middle;
  middle.origin = {2, 0.3, 0};
  const Circle rim(middle, 0.6);
  const Body patch = trimmed_surface(sphere, {std::make_shared<Circle>(rim)});
  std::mt19937_64 random(22);
  const auto number = [&] { return std::uniform_real_distribution<double>(-2.5, 2.5)(random); };
  int on_rim = 0;
  const int points = tests::tier_count(1000, 20);
  for (int k = 0; k < points; ++k) {
    const Vec3 p(number(), number(), number());
    const Vec2 foot_point(std::atan2(p.y, p.x), std::asin(p.z / glm::length(p)));
    double expected = std::abs(glm::length(p) - 1);
    if (!(glm::length(foot_point - Vec2(middle.origin)) < 0.6)) {
      ++on_rim;
      expected = kInfinity;
      for (int i = 0; i < 20000; ++i) {
        const Vec3 uv = rim.point(kTwoPi * i / 20000);
        expected = std::min(expected, glm::length(sphere->point(uv.x, uv.y) - p));
      }
    }
    const Distance found = distance(p, &patch, DistanceMinima::nearest);
    EXPECT_LE(found.distance, expected + 1e-15) << k;
    EXPECT_GE(found.distance, expected - 1e-6) << k;
    EXPECT_GE(found.bound, found.distance - 1e-13);
  }
  EXPECT_GT(on_rim, points / 2);
}

// Random pairs: none of the minima that sampling and descent find is lost, and no place is nearer than the first.

double unit(std::mt19937_64& random) { return std::uniform_real_distribution<double>(0, 1)(random); }
std::vector<Vec3> random_points(std::mt19937_64& random, int n, double shift) {
  std::vector<Vec3> points(n + 1);
  for (Vec3& p : points) p = {unit(random), unit(random) + shift, unit(random)};
  return points;
}
Grid<Vec3> random_net(std::mt19937_64& random, int n, int m, double height) {
  std::vector<Vec3> points;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= m; ++j)
      points.emplace_back((i + 0.6 * unit(random)) / n, (j + 0.6 * unit(random)) / m, height + unit(random));
  return {n + 1, m + 1, points};
}

void append(std::vector<double>& parameters, const DistancePlace& place) {
  if (place.kind == DistancePlace::Kind::curve)
    parameters.push_back(place.t);
  else
    parameters.insert(parameters.end(), {place.u, place.v});
}

template <int N>
void expect_all(const Distance& found, const tests::DistanceOracle<N>& oracle, int trial, int& minima) {
  ASSERT_FALSE(found.minima.empty()) << "trial " << trial;
  EXPECT_LE(found.bound, found.distance);
  EXPECT_GE(found.bound, found.distance - 1e-12) << "trial " << trial;
  const std::vector<double> truth = oracle.minima();
  ASSERT_FALSE(truth.empty());
  EXPECT_LE(found.distance, truth[0] + 1e-14) << "trial " << trial;
  for (const double distance : truth)
    EXPECT_TRUE(std::any_of(found.minima.begin(), found.minima.end(),
                            [&](const DistanceMinimum& one) { return std::abs(one.distance - distance) < 1e-9; }))
        << "trial " << trial << " at distance " << distance;
  for (const DistanceMinimum& one : found.minima) {
    std::vector<double> parameters;
    append(parameters, one.a);
    append(parameters, one.b);
    std::array<double, N> at;
    ASSERT_EQ(parameters.size(), at.size());
    std::copy(parameters.begin(), parameters.end(), at.begin());
    EXPECT_NEAR(oracle.distance(at), one.distance, 1e-14);
    EXPECT_TRUE(one.isolated) << "trial " << trial;
    EXPECT_TRUE(oracle.is_minimum(at, 1e-5))
        << "trial " << trial << " at distance " << one.distance << " at " << testing::PrintToString(at);
  }
  minima += static_cast<int>(found.minima.size());
}

TEST(RandomDistance, OfCurvesLosesNoMinimum) {
  std::mt19937_64 random(11);
  int minima = 0;
  const int pairs = tests::tier_count(1000);
  for (int trial = 0; trial < pairs; ++trial) {
    const auto p = random_points(random, 2 + trial % 5, 0), q = random_points(random, 2 + trial / 5 % 5, 1.2);
    const NurbsCurve a = bezier_curve(p), b = bezier_curve(q);
    const tests::DistanceOracle<2> oracle(
        [&](const std::array<double, 2>& x) { return tests::bezier_point(p, x[0]) - tests::bezier_point(q, x[1]); },
        48);
    expect_all<2>(distance(&a, &b), oracle, trial, minima);
  }
  tests::report_figure("pairs", pairs);
  tests::report_figure("minima", minima);
}

TEST(RandomDistance, OfCurvesFromSurfacesLosesNoMinimum) {
  std::mt19937_64 random(12);
  int minima = 0;
  const int pairs = tests::tier_count(1000);
  for (int trial = 0; trial < pairs; ++trial) {
    const int n = 1 + trial % 3, m = 1 + trial / 3 % 3;
    const Grid<Vec3> net = random_net(random, n, m, -1.4);
    const auto p = random_points(random, 2 + trial % 4, 0);
    const NurbsCurve a = bezier_curve(p);
    const NurbsSurface b = bezier_surface(net);
    const tests::DistanceOracle<3> oracle(
        [&](const std::array<double, 3>& x) {
          return tests::bezier_point(p, x[0]) - tests::bezier_point(net, x[1], x[2]);
        },
        16);
    expect_all<3>(distance(&a, &b), oracle, trial, minima);
  }
  tests::report_figure("pairs", pairs);
  tests::report_figure("minima", minima);
}

// The same against halving, which finds all: none lost, none too many.
template <int N>
void expect_exactly(const Distance& found, const tests::Bernstein<3>& way, const tests::DistanceOracle<N>& oracle,
                    int trial, int& minima, int& unclear_pairs) {
  bool unclear = false;
  const auto truth = tests::minima_by_halving<N>(way, oracle, unclear);
  if (unclear) {
    ++unclear_pairs;
    return;
  }
  ASSERT_EQ(found.minima.size(), truth.size()) << "trial " << trial << ": " << testing::PrintToString(truth);
  for (const auto& place : truth)
    EXPECT_TRUE(std::any_of(found.minima.begin(), found.minima.end(),
                            [&](const DistanceMinimum& one) {
                              std::vector<double> parameters;
                              append(parameters, one.a);
                              append(parameters, one.b);
                              for (int i = 0; i < N; ++i)
                                if (std::abs(parameters[i] - place[i]) > 1e-6) return false;
                              return true;
                            }))
        << "trial " << trial << " at " << testing::PrintToString(place);
  minima += static_cast<int>(truth.size());
}

TEST(RandomDistance, OfCurvesIsExactlyThatOfHalving) {
  std::mt19937_64 random(14);
  int minima = 0, unclear = 0;
  const int pairs = tests::tier_count(1000);
  for (int trial = 0; trial < pairs; ++trial) {
    const auto p = random_points(random, 2 + trial % 4, 0), q = random_points(random, 2 + trial / 4 % 4, 0.4);
    tests::Bernstein<3> way;
    way.degree = {static_cast<int>(p.size()) - 1, static_cast<int>(q.size()) - 1, 0};
    for (const Vec3& a : p)
      for (const Vec3& b : q) way.c.push_back({a.x - b.x, a.y - b.y, a.z - b.z});
    const NurbsCurve a = bezier_curve(p), b = bezier_curve(q);
    const tests::DistanceOracle<2> oracle(
        [&](const std::array<double, 2>& x) { return tests::bezier_point(p, x[0]) - tests::bezier_point(q, x[1]); }, 8);
    expect_exactly<2>(distance(&a, &b), way, oracle, trial, minima, unclear);
  }
  EXPECT_LT(unclear, pairs / 20 + 2);
  tests::report_figure("pairs", pairs - unclear);
  tests::report_figure("minima", minima);
}

TEST(RandomDistance, OfCurvesFromSurfacesIsExactlyThatOfHalving) {
  std::mt19937_64 random(15);
  int minima = 0, unclear = 0;
  const int pairs = tests::tier_count(1000);
  for (int trial = 0; trial < pairs; ++trial) {
    const Grid<Vec3> net = random_net(random, 1 + trial % 3, 1 + trial / 3 % 2, -0.8);
    const auto p = random_points(random, 2 + trial % 2, 0);
    tests::Bernstein<3> way;
    way.degree = {static_cast<int>(p.size()) - 1, net.rows - 1, net.columns - 1};
    for (const Vec3& a : p)
      for (const Vec3& b : net.values) way.c.push_back({a.x - b.x, a.y - b.y, a.z - b.z});
    const NurbsCurve a = bezier_curve(p);
    const NurbsSurface b = bezier_surface(net);
    const tests::DistanceOracle<3> oracle(
        [&](const std::array<double, 3>& x) {
          return tests::bezier_point(p, x[0]) - tests::bezier_point(net, x[1], x[2]);
        },
        8);
    expect_exactly<3>(distance(&a, &b), way, oracle, trial, minima, unclear);
  }
  EXPECT_LT(unclear, pairs / 5 + 2);
  tests::report_figure("pairs", pairs - unclear);
  tests::report_figure("minima", minima);
}

TEST(RandomDistance, OfSurfacesLosesNoMinimum) {
  std::mt19937_64 random(13);
  int minima = 0;
  const int pairs = tests::tier_count(1000);
  for (int trial = 0; trial < pairs; ++trial) {
    const Grid<Vec3> p = random_net(random, 1 + trial % 3, 1 + trial / 3 % 3, -1.4),
                     q = random_net(random, 1 + trial / 9 % 3, 1 + trial / 27 % 3, 0);
    const NurbsSurface a = bezier_surface(p), b = bezier_surface(q);
    const tests::DistanceOracle<4> oracle(
        [&](const std::array<double, 4>& x) {
          return tests::bezier_point(p, x[0], x[1]) - tests::bezier_point(q, x[2], x[3]);
        },
        8);
    expect_all<4>(distance(&a, &b), oracle, trial, minima);
  }
  tests::report_figure("pairs", pairs);
  tests::report_figure("minima", minima);
}

}  // namespace
}  // namespace lekalo::geometry::distance_test
