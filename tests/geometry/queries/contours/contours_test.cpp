// Contours on surfaces: the checks of Golovanov 2016, 4.6 to 4.8, singular and nearly singular cases whose truth is
// known, and random pairs against counts on a grid of Bernstein forms (support/level_oracle.h).
#include "geometry/contour.h"
#include "geometry/queries/contours/contour_length.h"
#include "geometry/queries/contours/isophote.h"
#include "geometry/queries/contours/plane_section.h"
#include "geometry/queries/contours/silhouette.h"
#include "geometry/queries/contours/surface_intersection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/surfaces/splines/bezier_surface.h"
#include "geometry/surfaces/splines/nurbs_surface.h"
#include "support/level_oracle.h"
#include "support/tier.h"

namespace lekalo::geometry::contours_test {
namespace {

using tests::BernsteinSquare;
using tests::LevelCurves;
using tests::LevelGrid;

Frame at(const Vec3& origin) {
  Frame frame;
  frame.origin = origin;
  return frame;
}
SurfacePtr cylinder(const Frame& frame, double radius, double height) {
  return std::make_shared<CylinderSurface>(frame, radius, height);
}
SurfacePtr sphere(const Vec3& center, double radius) { return std::make_shared<SphereSurface>(at(center), radius); }
SurfacePtr torus(double major, double minor) { return std::make_shared<TorusSurface>(Frame(), major, minor); }
Frame along_x() { return frame_from({-3, 0, 0}, {1, 0, 0}, {0, 1, 0}); }

double length_of(const Contour& contour) { return contour_length(contour).value; }
double length_of(const Contours& found) {
  double sum = 0;
  for (const Contour& one : found.branches) sum += length_of(one);
  return sum;
}
int closed_count(const Contours& found) {
  return static_cast<int>(
      std::count_if(found.branches.begin(), found.branches.end(), [](const Contour& one) { return one.closed; }));
}

// What every contour promises, on the surfaces of its images.
void check_promises(const Contours& found, const std::vector<SurfacePtr>& surfaces, double size) {
  for (const Contour& contour : found.branches) {
    EXPECT_LT(contour.error, 1e-13 * size);
    const Interval domain = contour.curve->domain();
    const Vec3 begin = contour.curve->point(domain.lo), end = contour.curve->point(domain.hi);
    EXPECT_EQ(contour.closed, glm::length(begin - end) < 1e-12 * size);
    for (int k = 0; k <= 20; ++k) {
      const double t = domain.lo + domain.width() * (k + 0.3) / 21;
      const CurveJet r = contour.curve->evaluate(t, 2);
      for (size_t i = 0; i < contour.images.size(); ++i) {
        const Vec3 uv = contour.images[i]->point(t);
        EXPECT_LT(glm::length(surfaces[i]->point(uv.x, uv.y) - r.d[0]), 1e-13 * size);
      }
      // Derivatives against differences.
      const double h = 1e-5 * domain.width();
      const Vec3 before = contour.curve->point(t - h), behind = contour.curve->point(t + h);
      for (const CurvePiece& piece : contour.curve->pieces())
        if (piece.domain.lo < t - h && t + h < piece.domain.hi) {
          EXPECT_LT(glm::length((behind - before) / (2 * h) - r.d[1]), 1e-5 * glm::length(r.d[1])) << t;
        }
      const CurveEnclosure over = contour.curve->enclose({std::max(domain.lo, t - h), std::min(domain.hi, t + h)}, 1);
      EXPECT_TRUE(over.d[0].inflated(1e-14 * size).contains(r.d[0]));
      EXPECT_TRUE(over.d[1].inflated(1e-12).contains(r.d[1]));
    }
  }
}

TEST(Contours, TwoCylindersMeetInTwoLoops) {
  const SurfacePtr a = cylinder(at({0, 0, -3}), 1, 6), b = cylinder(along_x(), 2, 6);
  const Contours found = intersect(a, b);
  ASSERT_EQ(found.branches.size(), 2u);
  EXPECT_TRUE(found.points.empty());
  for (const Contour& loop : found.branches) {
    EXPECT_TRUE(loop.closed);
    EXPECT_NEAR(length_of(loop), 6.39448891369661909, 1e-13);
  }
  check_promises(found, {a, b}, 8);
}

TEST(Contours, EqualCylindersMeetInTwoEllipsesThatCross) {
  const SurfacePtr a = cylinder(at({0, 0, -3}), 1, 6), b = cylinder(along_x(), 1, 6);
  const Contours found = intersect(a, b);
  ASSERT_EQ(found.branches.size(), 2u);
  ASSERT_EQ(found.points.size(), 2u);
  for (const ContourPoint& point : found.points) {
    EXPECT_EQ(point.kind, ContourPointKind::crossing);
    EXPECT_LT(glm::length(glm::abs(point.point) - Vec3(0, 1, 0)), 1e-12);
  }
  // Ellipses in the planes x = z and x = -z with the axes 1 and sqrt 2.
  for (const Contour& one : found.branches) {
    EXPECT_TRUE(one.closed);
    EXPECT_NEAR(length_of(one), 7.640395578055424, 1e-11);
    const Interval t = one.curve->domain();
    const Vec3 first = one.curve->point(0.1 * t.hi);
    const double side = first.x * first.z > 0 ? 1 : -1;
    for (int k = 0; k < 50; ++k) {
      const Vec3 p = one.curve->point(t.hi * k / 50);
      EXPECT_NEAR(p.x, side * p.z, 1e-9);
    }
  }
  check_promises(found, {a, b}, 8);
}

TEST(Contours, VillarceauCircles) {
  const SurfacePtr ring = torus(3, 1);
  const Contours found = plane_section(ring, {0, 0, 0}, {0, -1.0 / 3, std::sqrt(8.0) / 3});
  ASSERT_EQ(found.branches.size(), 2u);
  ASSERT_EQ(found.points.size(), 2u);
  for (const Contour& circle : found.branches) {
    EXPECT_NEAR(length_of(circle), 6 * kPi, 1e-11);
    double nearest = kInfinity, farthest = 0;
    for (const double side : {-1.0, 1.0}) {
      double low = kInfinity, high = 0;
      for (int k = 0; k < 60; ++k) {
        const double apart = glm::length(circle.curve->point(circle.curve->domain().hi * k / 60) - Vec3(side, 0, 0));
        low = std::min(low, apart), high = std::max(high, apart);
      }
      if (high - low < farthest - nearest || farthest == 0) nearest = low, farthest = high;
    }
    EXPECT_NEAR(nearest, 3, 1e-9);
    EXPECT_NEAR(farthest, 3, 1e-9);
  }
  check_promises(found, {ring}, 8);
}

TEST(Contours, VivianisCurveCrossesItself) {
  const SurfacePtr a = sphere({0, 0, 0}, 2), b = cylinder(at({1, 0, -3}), 1, 6);
  const Contours found = intersect(a, b);
  ASSERT_EQ(found.branches.size(), 1u);
  EXPECT_TRUE(found.branches[0].closed);
  EXPECT_NEAR(length_of(found), 2 * 7.64039557805542404, 1e-11);
  ASSERT_EQ(found.points.size(), 1u);
  EXPECT_EQ(found.points[0].kind, ContourPointKind::crossing);
  EXPECT_LT(glm::length(found.points[0].point - Vec3(2, 0, 0)), 1e-12);
  check_promises(found, {a, b}, 8);
}

// The silhouettes of a torus at an elevation are drawn as the offsets, at the minor radius, of an ellipse.
TEST(Contours, TorusSilhouetteIsAnOffsetOfAnEllipse) {
  const SurfacePtr ring = torus(3, 1);
  const double phi = 20 * kPi / 180;
  const Vec3 right(1, 0, 0), up(0, -std::sin(phi), std::cos(phi));
  const Contours found = silhouette(ring, {false, {0, -std::cos(phi), -std::sin(phi)}});
  ASSERT_EQ(found.branches.size(), 2u);
  EXPECT_TRUE(found.points.empty());
  std::vector<Vec2> cusps;
  for (const Contour& contour : found.branches) {
    EXPECT_TRUE(contour.closed);
    for (int k = 0; k < 40; ++k) {
      // The center circle's point nearest in the picture is where the ellipse's normal passes: at the same u.
      const double t = contour.curve->domain().hi * k / 40, u = contour.images[0]->point(t).x;
      const Vec3 p = contour.curve->point(t), c(3 * std::cos(u), 3 * std::sin(u), 0);
      const Vec2 apart(glm::dot(p - c, right), glm::dot(p - c, up));
      EXPECT_NEAR(glm::length(apart), 1, 1e-13);
      const Vec2 tangent(-3 * std::sin(u), -3 * std::cos(u) * std::sin(phi));
      EXPECT_NEAR(glm::dot(apart, tangent), 0, 1e-12);
    }
    for (const double t : contour.cusps) {
      const Vec3 p = contour.curve->point(t);
      cusps.push_back({glm::dot(p, right), glm::dot(p, up)});
    }
  }
  ASSERT_EQ(cusps.size(), 4u);
  for (const Vec2& cusp : cusps) {
    EXPECT_NEAR(std::abs(cusp.x), 2.13563290663288, 1e-13);
    EXPECT_NEAR(std::abs(cusp.y), 0.379038768782451, 1e-13);
  }
  check_promises(found, {ring}, 8);
}

TEST(Contours, CuspsAppearWhereTheMinorRadiusIsLarge) {
  const auto count = [](double degrees) {
    const double phi = degrees * kPi / 180;
    size_t cusps = 0;
    for (const Contour& one : silhouette(torus(3, 1), {false, {0, -std::cos(phi), -std::sin(phi)}}).branches)
      cusps += one.cusps.size();
    return cusps;
  };
  // r > R sin^2: below 35.264 degrees.
  EXPECT_EQ(count(35.2), 4u);
  EXPECT_EQ(count(35.3), 0u);
  EXPECT_EQ(count(70), 0u);
}

TEST(Contours, TorusSeenEdgeOnHasCrossingSilhouettes) {
  const Contours found = silhouette(torus(3, 1), {false, {0, 1, 0}});
  ASSERT_EQ(found.branches.size(), 4u);
  EXPECT_EQ(closed_count(found), 4);
  ASSERT_EQ(found.points.size(), 4u);
  for (const ContourPoint& point : found.points) EXPECT_EQ(point.kind, ContourPointKind::crossing);
  EXPECT_NEAR(length_of(found), 2 * 2 * kPi + 2 * 6 * kPi, 1e-11);
}

TEST(Contours, SphereSilhouettes) {
  const SurfacePtr ball = sphere({0, 0, 0}, 2);
  const Vec3 eye(3, 0, 4);
  const Contours central = silhouette(ball, {true, eye});
  ASSERT_EQ(central.branches.size(), 1u);
  EXPECT_NEAR(length_of(central), kTwoPi * 1.8330302779823359, 1e-12);
  for (int k = 0; k < 20; ++k) EXPECT_NEAR(glm::dot(central.branches[0].curve->point(0.5 * k), eye) / 5, 0.8, 1e-14);
  check_promises(central, {ball}, 4);
  // Through the poles, along seams, across everything.
  for (const Vec3& view : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 1, 0), Vec3(0.3, 0.5, 0.8)}) {
    const Contours parallel = silhouette(ball, {false, view});
    ASSERT_EQ(parallel.branches.size(), 1u) << view.x << " " << view.y;
    EXPECT_TRUE(parallel.branches[0].closed);
    EXPECT_TRUE(parallel.points.empty());
    EXPECT_NEAR(length_of(parallel), 4 * kPi, 1e-11);
  }
  // From inside there is none.
  EXPECT_TRUE(silhouette(ball, {true, {0.3, 0.2, 0.1}}).branches.empty());
}

TEST(Contours, GeneratorsOfConesAndCylinders) {
  const Contours two = silhouette(cylinder(Frame(), 1, 2), {false, {0, 1, 0.4}});
  ASSERT_EQ(two.branches.size(), 2u);
  for (const Contour& one : two.branches) {
    EXPECT_FALSE(one.closed);
    EXPECT_NEAR(length_of(one), 2, 1e-13);
    EXPECT_NEAR(std::abs(one.curve->point(1).x), 1, 1e-14);
  }
  const auto cone = std::make_shared<ConeSurface>(Frame(), 1.0, 0.0, 2.0);
  // Half angle atan 1/2 = 26.57 degrees: seen steeper there is no outline.
  const auto seen = [&](double degrees) {
    const double a = degrees * kPi / 180;
    return silhouette(cone, {false, {0, std::sin(a), -std::cos(a)}}).branches.size();
  };
  EXPECT_EQ(seen(26), 0u);
  EXPECT_EQ(seen(27), 2u);
}

TEST(Contours, SectionsThroughPolesAndSeams) {
  const SurfacePtr ball = sphere({0, 0, 0}, 2);
  for (const Vec3& normal : {Vec3(0, 1, 0), Vec3(1, 0.3, 0), Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(1, 2, 3)}) {
    const Contours found = plane_section(ball, {0, 0, 0}, normal);
    ASSERT_EQ(found.branches.size(), 1u);
    EXPECT_TRUE(found.branches[0].closed);
    EXPECT_TRUE(found.points.empty());
    EXPECT_NEAR(length_of(found), 4 * kPi, 1e-11);
    check_promises(found, {ball}, 4);
  }
}

TEST(Contours, SpheresThatNearlyTouch) {
  // Two unit spheres at the distance 2 - d meet in a circle of the radius sqrt(d - d^2/4).
  for (const double d : {1e-2, 1e-4, 1e-6, 1e-8}) {
    const Contours found =
        intersect(sphere({0, 0, 0}, 1), sphere({1.2 - 0.6 * d, 0.96 - 0.48 * d, 1.28 - 0.64 * d}, 1));
    ASSERT_EQ(found.branches.size(), 1u) << d;
    EXPECT_TRUE(found.branches[0].closed);
    EXPECT_NEAR(length_of(found) / kTwoPi, std::sqrt(d - d * d / 4), 1e-9) << d;
    EXPECT_TRUE(found.points.empty()) << d;
  }
  const Contours touching = intersect(sphere({0, 0, 0}, 1), sphere({1.2, 0.96, 1.28}, 1));
  EXPECT_TRUE(touching.branches.empty());
  ASSERT_EQ(touching.points.size(), 1u);
  EXPECT_EQ(touching.points[0].kind, ContourPointKind::contact);
  EXPECT_LT(glm::length(touching.points[0].point - Vec3(0.6, 0.48, 0.64)), 1e-8);
  for (const double gap : {1e-7, 1e-4}) {
    const double s = 1 + gap / 2;
    const Contours apart = intersect(sphere({0, 0, 0}, 1), sphere({1.2 * s, 0.96 * s, 1.28 * s}, 1));
    EXPECT_TRUE(apart.branches.empty()) << gap;
    EXPECT_TRUE(apart.points.empty()) << gap;
  }
}

// A circle in a plane spline of two by two spans that passes over a knot line by a little, at any place along it.
TEST(Contours, LoopsThatHardlyPassOverAKnot) {
  NurbsSurfaceForm form;
  form.degree_u = form.degree_v = 2;
  form.knots_u = form.knots_v = {0, 0, 0, 0.5, 1, 1, 1};
  for (const double x : {0.0, 0.25, 0.75, 1.0})
    for (const double y : {0.0, 0.25, 0.75, 1.0}) form.points.push_back(Vec4(x, y, 0, 1));
  const auto sheet = std::make_shared<NurbsSurface>(form);
  int step = 0;
  for (double over = 1e-2; over > 1e-9; over *= 0.4) {
    SCOPED_TRACE(over);
    const double r = 0.2 + 0.01 * (step % 3), y = 0.3 + 0.017 * (step++ % 5);
    const Contours found = intersect(sheet, sphere({0.5 + over - r, y, 0}, r));
    EXPECT_TRUE(found.complete);
    ASSERT_EQ(found.branches.size(), 1u);
    EXPECT_TRUE(found.branches[0].closed);
    EXPECT_NEAR(length_of(found), kTwoPi * r, 1e-11);
    const Interval t = found.branches[0].curve->domain();
    for (int k = 0; k < 2000; ++k) {
      const Vec3 p = found.branches[0].curve->point(t.lo + t.width() * k / 2000);
      EXPECT_NEAR(glm::length(p - Vec3(0.5 + over - r, y, 0)), r, 1e-13);
    }
  }
}

TEST(Contours, TangentPlanesOfATorus) {
  // Inside, the plane x = 2 touches at a saddle: a figure of eight.
  const Contours eight = plane_section(torus(3, 1), {2, 0, 0}, {1, 0, 0});
  ASSERT_EQ(eight.points.size(), 1u);
  EXPECT_EQ(eight.points[0].kind, ContourPointKind::crossing);
  EXPECT_LT(glm::length(eight.points[0].point - Vec3(2, 0, 0)), 1e-12);
  ASSERT_EQ(eight.branches.size(), 1u);
  EXPECT_TRUE(eight.branches[0].closed);
  // Outside, x = 4 touches at one point.
  const Contours point = plane_section(torus(3, 1), {4, 0, 0}, {1, 0, 0});
  EXPECT_TRUE(point.branches.empty());
  ASSERT_EQ(point.points.size(), 1u);
  EXPECT_LT(glm::length(point.points[0].point - Vec3(4, 0, 0)), 1e-8);
}

// One closed curve along which the surfaces touch.
void check_touching(const Contours& found, const std::vector<SurfacePtr>& surfaces, double length, double size) {
  EXPECT_TRUE(found.complete);
  EXPECT_FALSE(found.coincident);
  EXPECT_TRUE(found.points.empty());
  ASSERT_EQ(found.branches.size(), 1u);
  EXPECT_EQ(found.branches[0].kind, ContourKind::touching);
  EXPECT_NEAR(length_of(found), length, 1e-12 * length);
  check_promises(found, surfaces, size);
  // The normals agree.
  const Contour& contour = found.branches[0];
  for (int k = 0; surfaces.size() == 2 && k < 10; ++k) {
    const double t = contour.curve->domain().hi * (k + 0.4) / 10;
    const Vec3 a = contour.images[0]->point(t), b = contour.images[1]->point(t);
    EXPECT_LT(glm::length(glm::cross(surfaces[0]->normal(a.x, a.y), surfaces[1]->normal(b.x, b.y))), 1e-10);
  }
}

TEST(Contours, SurfacesTouchAlongCurves) {
  // A ball in a tube of its radius, wherever it stands; a ball that fills the ring of a torus and the hole of another;
  // a ball in a cone.
  const SurfacePtr tube = cylinder(at({0, 0, -2}), 1, 4);
  for (const double z : {0.0, 0.1234}) {
    check_touching(intersect(sphere({0, 0, z}, 1), tube), {sphere({0, 0, z}, 1), tube}, kTwoPi, 4);
    check_touching(intersect(tube, sphere({0, 0, z}, 1)), {tube, sphere({0, 0, z}, 1)}, kTwoPi, 4);
  }
  if (tests::is_full_tier()) {  // it takes seconds
    const SurfacePtr ring = torus(2, 1.5), around = sphere({0, 0, 0}, 3.5);
    check_touching(intersect(ring, around), {ring, around}, 7 * kPi, 8);
  }
  const SurfacePtr cone = std::make_shared<ConeSurface>(Frame(), 2.0, 0.0, 2.0), ball = sphere({0, 0, 0}, std::sqrt(2));
  check_touching(intersect(cone, ball), {cone, ball}, kTwoPi, 4);
  // A plane on the top of a torus, as a section and as a surface.
  check_touching(plane_section(torus(3, 1), {0, 0, 1}, {0, 0, 1}), {torus(3, 1)}, 6 * kPi, 8);
  const auto plane = std::make_shared<Plane>(at({0, 0, 1}), Rectangle{{-5, 5}, {-4, 4}});
  check_touching(intersect(torus(3, 1), plane), {torus(3, 1), plane}, 6 * kPi, 8);
  // Parallel cylinders, beside and inside of each other: a common generator of the shorter one's height.
  for (const double apart : {3.0, 1.0}) {
    const Contours found = intersect(cylinder(Frame(), 1, 4), cylinder(at({apart, 0, 0.5}), 2, 3));
    ASSERT_EQ(found.branches.size(), 1u);
    EXPECT_EQ(found.branches[0].kind, ContourKind::touching);
    EXPECT_NEAR(length_of(found), 3, 1e-13);
    EXPECT_TRUE(found.complete);
  }
  // A smaller ball in the tube is told apart.
  EXPECT_TRUE(intersect(sphere({0, 0, 0}, 0.9999), tube).branches.empty());
  EXPECT_EQ(intersect(sphere({0, 0, 0}, 1.0001), tube).branches.size(), 2u);
}

TEST(Contours, SurfacesCoincide) {
  const auto square = [](const Rectangle& domain, double z = 0) {
    return std::make_shared<Plane>(at({0, 0, z}), domain);
  };
  const auto check_border = [](const Contours& found, int loops, double length) {
    EXPECT_TRUE(found.coincident);
    EXPECT_TRUE(found.complete);
    EXPECT_TRUE(found.points.empty());
    EXPECT_EQ(found.branches.size(), static_cast<size_t>(loops));
    for (const Contour& border : found.branches) {
      EXPECT_EQ(border.kind, ContourKind::border);
      EXPECT_TRUE(border.closed);
    }
    EXPECT_NEAR(length_of(found), length, 1e-12 * length);
  };
  check_border(intersect(square({{-1, 1}, {-1, 1}}), square({{0.2, 3}, {-0.5, 0.7}})), 1, 4);
  check_border(intersect(square({{-1, 1}, {-1, 1}}), square({{-1, 1}, {-1, 1}})), 1, 8);
  check_border(plane_section(square({{-1, 1}, {-1, 1}}), {0, 0, 0}, {0, 0, 1}), 1, 8);
  check_border(intersect(cylinder(Frame(), 1, 4), cylinder(at({0, 0, 2}), 1, 3)), 2, 4 * kPi);
  // A part of a sphere on the whole: two meridians and two parallels.
  const auto part = std::make_shared<SphereSurface>(Frame(), 1, Rectangle{{0.3, 1.2}, {-0.4, 0.5}});
  check_border(intersect(sphere({0, 0, 0}, 1), part), 1, 1.8 + 0.9 * (std::cos(0.4) + std::cos(0.5)));
  // The whole has no border; to see that takes seconds.
  if (tests::is_full_tier()) check_border(intersect(sphere({0, 0, 0}, 1), sphere({0, 0, 0}, 1)), 0, 0);
  // Squares that share a part of an edge only touch there; above each other they do not meet.
  const Contours edge = intersect(square({{-1, 1}, {-1, 1}}), square({{1, 3}, {-0.5, 0.7}}));
  EXPECT_FALSE(edge.coincident);
  ASSERT_EQ(edge.branches.size(), 1u);
  EXPECT_EQ(edge.branches[0].kind, ContourKind::touching);
  EXPECT_NEAR(length_of(edge), 1.2, 1e-13);
  EXPECT_TRUE(intersect(square({{-1, 1}, {-1, 1}}), square({{0.2, 3}, {-0.5, 0.7}}, 1e-6)).branches.empty());
  EXPECT_TRUE(plane_section(square({{-1, 1}, {-1, 1}}), {0, 0, 1}, {0, 0, 1}).complete);
}

TEST(Contours, WrongInputIsRefused) {
  const auto unbounded = std::make_shared<Plane>(Frame());
  EXPECT_THROW(silhouette(unbounded, {}), std::invalid_argument);
  EXPECT_THROW(intersect(unbounded, unbounded), std::invalid_argument);
  EXPECT_THROW(silhouette(torus(3, 1), {false, {0, 0, 0}}), std::invalid_argument);
  EXPECT_THROW(plane_section(torus(3, 1), {0, 0, 0}, {0, 0, 0}), std::invalid_argument);
  EXPECT_THROW(isophote(torus(3, 1), {0, 0, 1}, 0), std::invalid_argument);
  EXPECT_THROW(isophote(unbounded, {0, 0, 1}, 1), std::invalid_argument);
  EXPECT_THROW(isophote(torus(3, 1), {0, 0, 0}, 1), std::invalid_argument);
  EXPECT_THROW(reflection_line(unbounded, {}, {}), std::invalid_argument);
  EXPECT_THROW(reflection_line(torus(3, 1), {}, {{0, 0, 5}, {0, 0, 0}}), std::invalid_argument);
  EXPECT_THROW(plane_section(unbounded, {0, 0, 0}, {1, 0, 0}), std::invalid_argument);
  EXPECT_NO_THROW(intersect(torus(3, 1), unbounded));
}

TEST(Contours, IsophotesOfASphereAreParallels) {
  const Contours found = isophote(sphere({1, 2, 3}, 2), {1, 2, 2}, kPi / 3);
  ASSERT_EQ(found.branches.size(), 1u);
  EXPECT_NEAR(length_of(found), kTwoPi * 2 * std::sin(kPi / 3), 1e-12);
  for (int k = 0; k < 20; ++k)
    EXPECT_NEAR(glm::dot(found.branches[0].curve->point(0.5 * k) - Vec3(1, 2, 3), Vec3(1, 2, 2)) / 3, 1, 1e-13);
}

// Each point of a reflection line sends the line of sight to the lamp.
TEST(Contours, ReflectionLinesMeetTheLamp) {
  const SurfacePtr ring = torus(3, 1);
  const Vec3 eye(2, -9, 5);
  const Line lamp{{0, 0, 8}, {1, 0.2, 0}};
  const Contours found = reflection_line(ring, {true, eye}, lamp);
  ASSERT_FALSE(found.branches.empty());
  for (const Contour& one : found.branches)
    for (int k = 0; k < 20; ++k) {
      const double t = one.curve->domain().hi * (k + 0.5) / 20;
      const Vec3 p = one.curve->point(t), uv = one.images[0]->point(t), n = ring->normal(uv.x, uv.y);
      const Vec3 d = glm::reflect(glm::normalize(p - eye), n), l = glm::normalize(lamp.direction);
      const Vec3 across = glm::cross(d, l);
      EXPECT_NEAR(glm::dot(p - lamp.origin, across) / glm::length(across), 0, 1e-12);
    }
}

// --- random patches

struct RandomPatch {
  std::shared_ptr<NurbsSurface> surface;
  std::array<BernsteinSquare, 4> homogeneous;  // w x, w y, w z, w

  RandomPatch(std::mt19937& random, double height, double unevenness) {
    std::uniform_real_distribution<double> d(-1, 1);
    NurbsSurfaceForm form;
    form.degree_u = form.degree_v = 3;
    form.knots_u = form.knots_v = {0, 0, 0, 0, 1, 1, 1, 1};
    for (BernsteinSquare& b : homogeneous) b.n = b.m = 3;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const double w = std::exp(unevenness * d(random));
        const Vec3 p(i / 1.5 - 1 + 0.2 * d(random), j / 1.5 - 1 + 0.2 * d(random), height * d(random));
        const Vec4 q(w * p, w);
        form.points.push_back(q);
        for (int k = 0; k < 4; ++k) homogeneous[k].c.push_back(q[k]);
      }
    surface = std::make_shared<NurbsSurface>(form);
  }
};

struct Counts {
  int clear = 0, unclear = 0, curves = 0;
};

void compare(const Contours& found, const LevelCurves& truth, Counts& counts, int number) {
  if (truth.unclear) {
    ++counts.unclear;
    return;
  }
  ++counts.clear;
  counts.curves += truth.loops + truth.open;
  EXPECT_TRUE(found.complete) << number;
  EXPECT_EQ(closed_count(found), truth.loops) << number;
  EXPECT_EQ(static_cast<int>(found.branches.size()) - closed_count(found), truth.open) << number;
  EXPECT_TRUE(found.points.empty()) << number;
}

void report(const Counts& counts) {
  tests::report_figure("compared", counts.clear);
  tests::report_figure("curves", counts.curves);
  tests::report_figure("unclear_to_the_oracle", counts.unclear);
  EXPECT_LT(counts.unclear, 0.1 * (counts.clear + counts.unclear) + 1);
}

constexpr int kGridDepth = 8;
constexpr double kSameCusp = 1e-5;  // in the parameters

TEST(RandomContours, PatchesWithSpheres) {
  std::mt19937 random(41);
  std::uniform_real_distribution<double> d(-1, 1);
  Counts counts;
  for (int k = 0; k < tests::tier_count(500, 12); ++k) {
    const RandomPatch patch(random, 0.8, k % 3 ? 0.5 : 2.0);
    const Vec3 c(0.6 * d(random), 0.6 * d(random), 0.6 * d(random));
    const double r = 0.3 + 0.5 * std::abs(d(random));
    const auto& [x, y, z, w] = patch.homogeneous;
    const auto apart = [&](const BernsteinSquare& a, double from) { return (a - from * w) * (a - from * w); };
    const BernsteinSquare f = apart(x, c.x) + apart(y, c.y) + apart(z, c.z) - (r * r) * (w * w);
    const SurfacePtr ball = sphere(c, r);
    const Contours found = intersect(patch.surface, ball);
    compare(found, LevelGrid::count(f, kGridDepth), counts, k);
    check_promises(found, {patch.surface, ball}, 3);
  }
  report(counts);
}

TEST(RandomContours, PatchesWithTori) {
  std::mt19937 random(43);
  std::uniform_real_distribution<double> d(-1, 1);
  Counts counts;
  for (int k = 0; k < tests::tier_count(500, 12); ++k) {
    const RandomPatch patch(random, 0.8, 0.5);
    const double R = 0.5 + 0.2 * d(random), r = 0.2 + 0.1 * d(random);
    const auto& [x, y, z, w] = patch.homogeneous;
    const BernsteinSquare sum = x * x + y * y + z * z + (R * R - r * r) * (w * w);
    const BernsteinSquare f = sum * sum - (4 * R * R) * ((x * x + y * y) * (w * w));
    const SurfacePtr ring = torus(R, r);
    const Contours found = intersect(patch.surface, ring);
    compare(found, LevelGrid::count(f, kGridDepth), counts, k);
    check_promises(found, {patch.surface, ring}, 3);
  }
  report(counts);
}

TEST(RandomContours, PlaneSections) {
  std::mt19937 random(47);
  std::uniform_real_distribution<double> d(-1, 1);
  Counts counts;
  for (int k = 0; k < tests::tier_count(500, 25); ++k) {
    const RandomPatch patch(random, 0.8, k % 2 ? 0.5 : 3.0);
    const Vec3 n = glm::normalize(Vec3(0.4 * d(random), 0.4 * d(random), 1)), o(0, 0, 0.3 * d(random));
    const auto& [x, y, z, w] = patch.homogeneous;
    const BernsteinSquare f = n.x * x + n.y * y + n.z * z - glm::dot(n, o) * w;
    const Contours found = plane_section(patch.surface, o, n);
    compare(found, LevelGrid::count(f, kGridDepth), counts, k);
    check_promises(found, {patch.surface}, 3);
  }
  report(counts);
}

// i . (s_u x s_v) w^3 / w: the determinant of (i, 0), (A, w), (A_u, w_u), (A_v, w_v).
//
// On the outline (i, 0) = a (A_u, w_u) + b (A_v, w_v) + ... (A, w), so that with any fourth row c the determinants of
// i, A, A_v, c and of i, A, A_u, c are a and -b times a common factor. A cusp is where f_u a + f_v b = 0; where the
// factor vanishes depends on c.
TEST(RandomContours, Silhouettes) {
  std::mt19937 random(53);
  std::uniform_real_distribution<double> d(-1, 1);
  Counts counts;
  int cusps = 0;
  for (int k = 0; k < tests::tier_count(200, 20); ++k) {
    const RandomPatch patch(random, 0.8, 0.4);
    const bool central = k % 2;
    const Vec3 view(3 * d(random), 3 * d(random), central ? 3 + d(random) : 0.5 * d(random));
    // Central: (s - eye) . ..., and s lies in the span of the other rows.
    const std::array<double, 4> row = {view.x, view.y, view.z, central ? 1.0 : 0.0};
    const auto& h = patch.homogeneous;
    std::array<BernsteinSquare, 4> hu, hv;
    for (int i = 0; i < 4; ++i) hu[i] = h[i].by_u(), hv[i] = h[i].by_v();
    const auto minor = [&](int a, int b, int c) {
      return h[a] * (hu[b] * hv[c] - hu[c] * hv[b]) - h[b] * (hu[a] * hv[c] - hu[c] * hv[a]) +
             h[c] * (hu[a] * hv[b] - hu[b] * hv[a]);
    };
    const BernsteinSquare f =
        row[0] * minor(1, 2, 3) - row[1] * minor(0, 2, 3) + row[2] * minor(0, 1, 3) - row[3] * minor(0, 1, 2);
    const Contours found = silhouette(patch.surface, {central, view});
    const tests::LevelCurves truth = LevelGrid::count(f, kGridDepth);
    compare(found, truth, counts, k);
    check_promises(found, {patch.surface}, 3);
    if (truth.unclear) continue;

    std::vector<BernsteinSquare> both{f};
    for (const std::array<double, 4>& c : {std::array{0.3, -0.8, 0.5, 0.1}, std::array{-0.6, 0.2, 0.7, -0.4}}) {
      // The determinant of i, A, e, c by the minors of its constant rows.
      const auto determinant = [&](const std::array<BernsteinSquare, 4>& e) {
        BernsteinSquare sum{h[0].n + e[0].n, h[0].m + e[0].m, {}};
        sum.c.assign((sum.n + 1) * (sum.m + 1), 0);
        for (int p = 0; p < 4; ++p)
          for (int q = p + 1; q < 4; ++q) {
            std::array<int, 2> rest{};
            for (int r = 0, at = 0; r < 4; ++r)
              if (r != p && r != q) rest[at++] = r;
            const double sign = (p + q) % 2 ? 1 : -1;
            sum = sum + (sign * (row[rest[0]] * c[rest[1]] - row[rest[1]] * c[rest[0]])) * (h[p] * e[q] - h[q] * e[p]);
          }
        return sum;
      };
      both.push_back(f.by_u() * determinant(hv) - f.by_v() * determinant(hu));
    }
    std::vector<std::array<double, 2>> expected = tests::common_zeros(both, 26, kSameCusp);
    size_t count = 0;
    for (const Contour& one : found.branches)
      for (const double t : one.cusps) {
        ++count;
        const Vec3 at = one.images[0]->point(t);
        const size_t before = expected.size();
        std::erase_if(expected, [&](const std::array<double, 2>& zero) {
          return std::abs(zero[0] - at.x) < kSameCusp && std::abs(zero[1] - at.y) < kSameCusp;
        });
        EXPECT_EQ(expected.size() + 1, before) << k << ": a cusp at " << at.x << " " << at.y << " that is none";
      }
    cusps += static_cast<int>(count);
    for (const auto& lost : expected) ADD_FAILURE() << k << ": a cusp lost at " << lost[0] << " " << lost[1];
  }
  report(counts);
  tests::report_figure("cusps", cusps);
}

// Parts of surfaces that are closed when whole: branches end on their borders, and nothing is missing.
TEST(Contours, OfPartsOfClosedSurfaces) {
  const auto half = std::make_shared<TorusSurface>(Frame(), 2.0, 0.8, Rectangle{{0.2, 2.9}, {0, kTwoPi}});
  const Contours seen = silhouette(half, {false, glm::normalize(Vec3(-0.2, 0.9, -0.4))});
  EXPECT_TRUE(seen.complete);
  ASSERT_EQ(seen.branches.size(), 2u);
  for (const Contour& branch : seen.branches) {
    EXPECT_FALSE(branch.closed);
    const Interval domain = branch.curve->domain();
    for (const double t : {domain.lo, domain.hi}) {
      const double u = branch.images[0]->point(t).x;
      EXPECT_LT(std::min(std::abs(u - 0.2), std::abs(u - 2.9)), 1e-9);
    }
  }
  const auto shell = std::make_shared<CylinderSurface>(Frame(), 1.0, 3.0, Rectangle{{0.3, 4.0}, {0, 3}});
  const auto across = std::make_shared<TorusSurface>(Frame(), 2.0, 1.4);
  EXPECT_TRUE(intersect(shell, across).complete);
}

}  // namespace
}  // namespace lekalo::geometry::contours_test
