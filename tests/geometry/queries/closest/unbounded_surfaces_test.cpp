// Unbounded surfaces: against distances to axes and planes at places of a grid, which share no code with what is
// tested.
#include "geometry/queries/closest/unbounded_surfaces.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/curves/analytic/segment.h"
#include "geometry/queries/closest/closest_point.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"

namespace lekalo::geometry::unbounded_surfaces_test {
namespace {

Vec3 random_vector(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> unit(-size, size);
  return {unit(random), unit(random), unit(random)};
}
Frame random_frame(std::mt19937& random) {
  return frame_about(random_vector(random, 4), glm::normalize(random_vector(random, 1)));
}
CylinderSurface cylinder(const Frame& frame, double radius) {
  return CylinderSurface(frame, radius, 1, CylinderSurface::kUnbounded);
}

double to_plane(const Frame& plane, const Vec3& p) { return std::abs(glm::dot(p - plane.origin, plane.z)); }
double to_cylinder(const Frame& axis, double radius, const Vec3& p) {
  const Vec3 way = p - axis.origin;
  return std::abs(glm::length(way - glm::dot(way, axis.z) * axis.z) - radius);
}

// Over a grid on the first cylinder, 60 long.
template <class ToOther>
double least(const Frame& axis, double radius, ToOther&& to_other) {
  double least = kInfinity;
  for (int i = 0; i < 240; ++i)
    for (int j = -600; j <= 600; ++j) {
      const double u = kTwoPi * i / 240;
      const Vec3 p = axis.origin + radius * (std::cos(u) * axis.x + std::sin(u) * axis.y) + 0.05 * j * axis.z;
      least = std::min(least, to_other(p));
    }
  return least;
}

TEST(UnboundedSurfaces, WithOneEndHaveItsBorder) {
  const auto up = std::make_shared<CylinderSurface>(Frame(), 1, 1, Rectangle{{0, kTwoPi}, {0, kInfinity}});
  EXPECT_NEAR(SurfaceProjector(up).foot_points({3, 0, 5}).foot_points[0].distance, 2, 1e-14);
  EXPECT_NEAR(SurfaceProjector(up).foot_points({3, 0, -10}).foot_points[0].distance, std::hypot(2, 10), 1e-14);
  const auto quarter = std::make_shared<Plane>(Frame(), Rectangle{{0, kInfinity}, {0, kInfinity}});
  EXPECT_NEAR(SurfaceProjector(quarter).foot_points({-3, -4, 12}).foot_points[0].distance, 13, 1e-14);
}

TEST(UnboundedSurfaces, CoaxialCylindersAreAsNearAllAround) {
  Frame far;
  far.origin = {1e-13, 0, 1000};
  const auto found = unbounded_distance(cylinder(Frame(), 1), cylinder(far, 3));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->minima[0].distance, 2, 1e-14);
  EXPECT_EQ(found->minima[0].range_a[0].width(), kTwoPi);
}

TEST(UnboundedSurfaces, PlanesAreApartOnlyWhereTheyAreParallel) {
  const Frame frame = frame_about({1, 2, 3}, glm::normalize(Vec3(1, 2, 2)));
  Frame other = frame;
  other.origin += 5.0 * frame.z + 7.0 * frame.x;
  const Plane a(frame), b(other), across(frame_about({0, 0, 9}, {1, 0, 0}));
  const Distance found = distance(&a, &b);
  EXPECT_NEAR(found.distance, 5, 1e-14);
  EXPECT_LE(found.bound, 5);
  ASSERT_EQ(found.minima.size(), 1u);
  EXPECT_FALSE(found.minima[0].isolated);
  const Distance meeting = distance(&a, &across);
  EXPECT_TRUE(meeting.meet);
  EXPECT_LE(to_plane(frame, meeting.minima[0].a.point), 1e-14);
  EXPECT_LE(std::abs(meeting.minima[0].a.point.x), 1e-14);
}

TEST(UnboundedSurfaces, CylindersAndPlanesAtRandom) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> some_radius(0.2, 3);
  int apart = 0;
  for (int k = 0; k < 60; ++k) {
    const Frame a = random_frame(random);
    Frame b = random_frame(random);
    if (k % 3 == 0) b = {b.origin, a.x, a.y, a.z};     // parallel
    if (k % 12 == 0) b.origin = a.origin + 3.0 * a.z;  // coaxial
    const double radius_a = some_radius(random), radius_b = some_radius(random);
    // Axes at small angles meet far off.
    if (k % 3 != 0 && glm::length(glm::cross(a.z, b.z)) < 0.3) continue;
    const CylinderSurface first = cylinder(a, radius_a), second = cylinder(b, radius_b);
    const Distance found = distance(&first, &second);
    const double seen = least(a, radius_a, [&](const Vec3& p) { return to_cylinder(b, radius_b, p); });
    EXPECT_NEAR(found.distance, seen, found.meet ? 0.1 : 5e-3);
    EXPECT_LE(found.distance, seen + 1e-12);
    const DistanceMinimum& one = found.minima.at(0);
    EXPECT_NEAR(glm::length(one.a.point - one.b.point), found.distance, 1e-12);
    EXPECT_LE(to_cylinder(a, radius_a, one.a.point), 1e-12);
    EXPECT_LE(to_cylinder(b, radius_b, one.b.point), 1e-12);
    apart += !found.meet;

    const Frame lying = k % 2 ? b : Frame{b.origin, a.y, a.z, a.x};  // or at an angle
    if (k % 2 && std::abs(glm::dot(lying.z, a.z)) < 0.3) continue;
    const Plane plane(lying);
    const Distance from_plane = distance(&plane, &first);
    const double seen_plane = least(a, radius_a, [&](const Vec3& p) { return to_plane(lying, p); });
    EXPECT_NEAR(from_plane.distance, seen_plane, from_plane.meet ? 0.1 : 5e-3);
    const DistanceMinimum& place = from_plane.minima.at(0);
    EXPECT_NEAR(glm::length(place.a.point - place.b.point), from_plane.distance, 1e-12);
    EXPECT_LE(to_plane(lying, place.a.point), 1e-12);
    EXPECT_LE(to_cylinder(a, radius_a, place.b.point), 1e-12);
  }
  EXPECT_GE(apart, 10);
}

TEST(UnboundedSurfaces, BoundedThingsHaveDistancesFromCylindersAndCones) {
  std::mt19937 random(11);
  for (int k = 0; k < 20; ++k) {
    const Frame axis = random_frame(random);
    const CylinderSurface of = cylinder(axis, 0.5);
    const Vec3 p = random_vector(random, 9), q = random_vector(random, 9);
    EXPECT_NEAR(project(p, of).foot_points.at(0).distance, to_cylinder(axis, 0.5, p), 1e-13);
    const SphereSurface ball({p, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 0.25);
    if (to_cylinder(axis, 0.5, p) > 0.3) {
      EXPECT_NEAR(distance(&ball, &of).distance, to_cylinder(axis, 0.5, p) - 0.25, 1e-12);
    }
    const Segment segment(p, q);
    double seen = kInfinity;
    for (int i = 0; i <= 4000; ++i) seen = std::min(seen, to_cylinder(axis, 0.5, segment.point(i / 4000.0)));
    const Distance found = distance(&segment, &of);
    EXPECT_LE(found.distance, seen + 1e-12);
    EXPECT_GE(found.distance, seen - 0.01);

    // Two generators of the cone lie in the plane of the axis and the point.
    const double slope = 0.7;
    const ConeSurface cone(axis, 0, slope, 1, CylinderSurface::kUnbounded);
    const Vec3 local = axis.to_local_point(p);
    const double rho = std::hypot(local.x, local.y), along = std::hypot(1, slope);
    const double expected = std::min(std::abs(rho - slope * local.z), std::abs(rho + slope * local.z)) / along;
    EXPECT_NEAR(project(p, cone).foot_points.at(0).distance, expected, 1e-13);
  }
}

// On axes of surfaces of revolution all places of a parallel are foot points.
TEST(UnboundedSurfaces, AlongLinesOfFootPointsNoDigitIsLost) {
  const ConeSurface cone(Frame{}, 1, 0, 2);
  for (const double z : {0.0, 0.3, 1.0})
    EXPECT_NEAR(project({0, 0, z}, cone).foot_points.at(0).distance, (2 - z) / std::sqrt(5.0), 4e-16);
  const CylinderSurface of = cylinder(Frame{}, 1);
  EXPECT_NEAR(project({0, 0, 17}, of).foot_points.at(0).distance, 1, 4e-16);
}

}  // namespace
}  // namespace lekalo::geometry::unbounded_surfaces_test
