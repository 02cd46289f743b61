// Points above and below surfaces, inside and outside of regions and bodies: the checks of Golovanov 2016, 4.11, and
// closed forms.
#include "geometry/queries/closest/position.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/bodies/trims/trimmed_surface.h"
#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/polyline.h"
#include "geometry/shapes/csg/half_space.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/surfaces/splines/bezier_surface.h"
#include "support/tier.h"

namespace lekalo::geometry::position_test {
namespace {

using Side = SurfacePosition::Side;

TEST(PositionBySurface, ASphereHasItsNormalOutside) {
  SphereSurface sphere(Frame(), 2);
  const SurfacePosition above = position(Vec3(1, 2, 2), sphere);
  EXPECT_EQ(above.side, Side::above);
  EXPECT_NEAR(above.height, 1, 1e-15);
  EXPECT_EQ(position(Vec3(0.1, 0.2, 0.1), sphere).side, Side::below);
  EXPECT_EQ(position(Vec3(0, 0, 2), sphere).side, Side::on);
  EXPECT_EQ(position(Vec3(0, 0, 5), sphere).side, Side::above);
  sphere.set_reversed(true);
  EXPECT_EQ(position(Vec3(1, 2, 2), sphere).side, Side::below);
}

TEST(PositionBySurface, BeyondABorderTheTangentPlaneGoesOn) {
  const Plane square(Frame(), {{0, 4}, {0, 4}});
  EXPECT_EQ(position(Vec3(2, 2, 1), square).side, Side::above);
  EXPECT_EQ(position(Vec3(6, 2, 1), square).side, Side::above);
  EXPECT_EQ(position(Vec3(6, 7, -1), square).side, Side::below);
  EXPECT_EQ(position(Vec3(6, 2, 0), square).side, Side::beside);
  EXPECT_EQ(position(Vec3(4, 2, 0), square).side, Side::on);
  const Plane floor(Frame{});
  EXPECT_NEAR(position(Vec3(20, -30, -1.5), floor).height, -1.5, 1e-15);
}

TEST(PositionBySurface, ACreaseHasTheSumOfItsNormals) {
  // A roof with its ridge along y; r_u x r_v looks up.
  NurbsSurfaceForm form;
  form.knots_u = {0, 0, 1, 2, 2};
  form.knots_v = {0, 0, 1, 1};
  form.points = {{-2, 0, 0, 1}, {-2, 1, 0, 1}, {0, 0, 1, 1}, {0, 1, 1, 1}, {2, 0, 0, 1}, {2, 1, 0, 1}};
  const NurbsSurface roof(form);
  EXPECT_EQ(position(Vec3(0, 0.5, 3), roof).side, Side::above);
  EXPECT_EQ(position(Vec3(0.01, 0.5, 1.5), roof).side, Side::above);
  EXPECT_EQ(position(Vec3(0, 0.5, 0.5), roof).side, Side::below);
}

using Loop = std::vector<TrimRegion::Part>;
Loop closed(const std::vector<Vec3>& points) { return {{std::make_shared<NurbsCurve>(polyline(points, true)), true}}; }

TEST(PositionInRegion, OfASquareWithAHole) {
  // The square [0, 4]^2 with a clockwise unit hole about its middle.
  const std::vector<Loop> loops{closed({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}),
                                closed({{1.5, 1.5, 0}, {1.5, 2.5, 0}, {2.5, 2.5, 0}, {2.5, 1.5, 0}})};
  const auto at = [&](double u, double v) { return position(Vec2(u, v), loops); };
  EXPECT_EQ(at(2, 2).where, Containment::outside);
  EXPECT_NEAR(at(2, 2).distance, 0.5, 1e-15);
  EXPECT_EQ(at(2, 2).loop, 1);
  EXPECT_EQ(at(0.5, 0.5).where, Containment::inside);
  EXPECT_NEAR(at(0.5, 0.5).distance, 0.5, 1e-15);
  EXPECT_EQ(at(-1, -1).where, Containment::outside);  // the nearest place is a vertex
  EXPECT_NEAR(at(-1, -1).distance, std::sqrt(2.0), 1e-15);
  EXPECT_EQ(at(1.2, 1.2).where, Containment::inside);  // a vertex of the hole
  EXPECT_EQ(at(4, 1).where, Containment::on);
  EXPECT_EQ(at(4, 4).where, Containment::on);
  EXPECT_EQ(at(1.5, 2).where, Containment::on);
}

TEST(PositionInRegion, OfAFaceOnAPeriodicSurface) {
  // A disc of the parameter plane over the seam of a cylinder.
  const auto sphere = std::make_shared<SphereSurface>(Frame(), 1);
  Frame middle;
  middle.origin = {kTwoPi, 0, 0};
  const Body patch = trimmed_surface(sphere, {std::make_shared<Circle>(middle, 0.5)});
  EXPECT_EQ(position(Vec2(0.1, 0), patch, 0).where, Containment::inside);
  EXPECT_EQ(position(Vec2(kTwoPi - 0.1, 0), patch, 0).where, Containment::inside);
  EXPECT_NEAR(position(Vec2(0.1, 0), patch, 0).distance, 0.4, 1e-14);
  EXPECT_EQ(position(Vec2(0.7, 0), patch, 0).where, Containment::outside);
}

TEST(PositionInBody, OfPrimitives) {
  const Body block = box(Frame(), {1, 2, 3}), round = ball(Frame(), 2), ring = torus_body(Frame(), 3, 1);
  EXPECT_EQ(position(Vec3(0.5, 1, 1), block).where, Containment::inside);
  EXPECT_NEAR(position(Vec3(0.5, 1, 0.25), block).distance, 0.25, 1e-15);
  const BodyPosition corner = position(Vec3(-1, -1, -1), block);
  EXPECT_EQ(corner.where, Containment::outside);
  EXPECT_TRUE(corner.by_lines);
  EXPECT_NEAR(corner.distance, std::sqrt(3.0), 1e-15);
  EXPECT_EQ(position(Vec3(1, 1, 1), block).where, Containment::on);
  EXPECT_EQ(position(Vec3(1, 2, 3), block).where, Containment::on);
  EXPECT_EQ(position(Vec3(0, 0, 0), round).where, Containment::inside);
  EXPECT_NEAR(position(Vec3(0, 0, 0), round).distance, 2, 1e-15);
  EXPECT_EQ(position(Vec3(0, 0, 2.5), round).where, Containment::outside);
  EXPECT_EQ(position(Vec3(0, 0, 0), ring).where, Containment::outside);
  EXPECT_EQ(position(Vec3(3, 0, 0.5), ring).where, Containment::inside);
  Body open = block;
  open.faces.clear();
  EXPECT_THROW(position(Vec3(0), open), std::invalid_argument);
}

TEST(PositionInBody, OfRandomPointsByClosedForms) {
  std::mt19937_64 random(21);
  const auto number = [&](double half) { return std::uniform_real_distribution<double>(-half, half)(random); };
  const Body cylinder = cylinder_body(Frame(), 1, 2), ring = torus_body(Frame(), 2, 0.7);
  const int points = tests::tier_count(1000, 40);
  for (int k = 0; k < points; ++k) {
    const Vec3 p(number(1.5), number(1.5), 1 + number(1.5));
    const double radial = std::hypot(p.x, p.y) - 1, axial = std::abs(p.z - 1) - 1;
    const bool inside = radial < 0 && axial < 0;
    const double distance =
        inside ? std::min(-radial, -axial) : std::hypot(std::max(radial, 0.0), std::max(axial, 0.0));
    const BodyPosition found = position(p, cylinder);
    EXPECT_EQ(found.where, inside ? Containment::inside : Containment::outside) << "point " << k;
    EXPECT_NEAR(found.distance, distance, 1e-14);
    const Vec3 q(number(3), number(3), number(1));
    const double from_ring = std::hypot(std::hypot(q.x, q.y) - 2, q.z) - 0.7;
    EXPECT_EQ(position(q, ring).where, from_ring < 0 ? Containment::inside : Containment::outside) << "point " << k;
    EXPECT_NEAR(position(q, ring).distance, std::abs(from_ring), 1e-14);
  }
  tests::report_figure("points", 2 * points);
}

TEST(PositionInShape, OfAHalfSpace) {
  const HalfSpaceShape below({0, 0, 1}, {0, 0, 1});
  EXPECT_TRUE(is_inside({3, 4, 0}, below));
  EXPECT_FALSE(is_inside({3, 4, 2}, below));
}

}  // namespace
}  // namespace lekalo::geometry::position_test
