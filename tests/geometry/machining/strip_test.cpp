// Curvatures of cutters at their contacts against sections of the implicit torus of the corner; strips; bands.
#include "geometry/machining/strip.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/queries/differential/curvature.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"

namespace lekalo::geometry {
namespace {

SurfaceContact contact_on(const SurfacePtr& surface, const Cutter& cutter, const ToolAxis& axis) {
  SurfaceContact contact;
  contact.line = {surface, IsoDirection::v, 0.6, nullptr};
  contact.cutter = cutter;
  contact.axis = axis;
  return contact;
}

// The second derivative of the height along n at which the corner is met over a tangent direction: by bisection in the
// implicit equation (|off - (off q) q| - (R - rho))^2 + (off q)^2 = rho^2 about the middle of the corner.
double bend_by_equation(const Cutter& cutter, const CutterPlace<double>& place, const Vec3& direction) {
  const Vec3 q = vec(place.axis), n = vec(place.normal);
  const Vec3 middle = vec(place.reference) + cutter.corner_radius * q;
  const auto value = [&](const Vec3& p) {
    const Vec3 off = p - middle;
    const double height = glm::dot(off, q), distance = glm::length(off - height * q);
    return std::hypot(distance - cutter.ring_radius(), height) - cutter.corner_radius;
  };
  const auto height_at = [&](double x) {
    double lo = -0.1 * cutter.corner_radius, hi = 0.5 * cutter.corner_radius;  // outside, inside
    for (int k = 0; k < 200; ++k) {
      const double mid = 0.5 * (lo + hi);
      (value(vec(place.contact) + x * direction + mid * n) > 0 ? lo : hi) = mid;
    }
    return 0.5 * (lo + hi);
  };
  const double step = 2e-3 * cutter.corner_radius;
  return (height_at(step) + height_at(-step) - 2 * height_at(0)) / (step * step);
}

const ToolAxis kTilted{ToolAxis::Kind::fixed, glm::normalize(Vec3(0.25, -0.15, 1)), ScalarLaw(0.0)};

TEST(Strip, CurvatureAcrossIsThatOfTheTorus) {
  const SurfacePtr table = std::make_shared<Plane>(Frame{}, Rectangle{{-2, 2}, {-2, 2}});
  for (const Cutter& cutter : {Cutter{10, 3, 20, 0}, Cutter{1, 2, 5, 0}, Cutter{2, 0.5, 5, 0.1}}) {
    const SurfaceContact contact = contact_on(
        table, cutter,
        cutter.corner_radius > cutter.radius ? ToolAxis{ToolAxis::Kind::lead, Vec3(0), ScalarLaw(1.2)} : kTilted);
    const CutterPlace<double> place = contact.at(0.3);
    const Vec3 across = glm::cross(vec(place.normal), vec(place.feed));
    const double k = contact_bend(contact, 0.3).cutter_across;
    EXPECT_NEAR(bend_by_equation(cutter, place, across), k, 1e-5 * std::max(k, 1.0));
  }
}

TEST(Strip, LeastDifferenceIsThatOfAllDirections) {
  const SurfacePtr saddle = std::make_shared<TorusSurface>(Frame{}, 5.0, 2.0, Rectangle{{0.2, 1.9}, {2.3, 3.4}});
  SurfaceContact contact = contact_on(saddle, {0.8, 0.3, 3, 0}, {ToolAxis::Kind::lead, Vec3(0), ScalarLaw(0.4)});
  contact.line.at = 2.9;
  const CutterPlace<double> place = contact.at(1.0);
  const auto shape = shape_operator(*saddle, 1, 1.0, 2.9);
  ASSERT_TRUE(shape);
  double least = kInfinity;
  const Vec3 x = vec(place.feed), y = glm::cross(vec(place.normal), x);
  for (int k = 0; k < 720; ++k) {
    const double angle = kPi * k / 720;
    const Vec3 d = std::cos(angle) * x + std::sin(angle) * y;
    least = std::min(least, bend_by_equation(contact.cutter, place, d) - glm::dot(d, *shape * d));
  }
  EXPECT_NEAR(contact_bend(contact, 1.0).min_difference, least, 2e-4);
}

// Of an offset the curvatures are k/(1 - d k).
TEST(Strip, AllowanceIsThatOfTheOffset) {
  const SurfacePtr ball = std::make_shared<SphereSurface>(Frame{}, 4.0, Rectangle{{0, 1}, {0.2, 1.0}}),
                   larger = std::make_shared<SphereSurface>(Frame{}, 4.5, Rectangle{{0, 1}, {0.2, 1.0}});
  SurfaceContact contact = contact_on(ball, {1, 1, 3, 0}, kTilted),
                 on_offset = contact_on(larger, {1, 1, 3, 0}, kTilted);
  contact.allowance = 0.5;
  const ContactBend a = contact_bend(contact, 0.4), b = contact_bend(on_offset, 0.4);
  EXPECT_NEAR(a.part_across, -1 / 4.5, 1e-14);
  EXPECT_NEAR(a.min_difference, b.min_difference, 1e-13);
  EXPECT_NEAR(glm::length(a.across - b.across), 0, 1e-14);
}

// Two balls on a larger ball, and the cusp between them: its height over the part by the intersection of circles.
TEST(Strip, CuspsHaveTheirHeight) {
  const double part = 4, tool = 1, width = 0.05;
  const SurfacePtr ball = std::make_shared<SphereSurface>(Frame{}, part, Rectangle{{0, 1}, {0.2, 1.0}});
  const ContactBend bend = contact_bend(contact_on(ball, {tool, tool, 3, 0}, kTilted), 0.4);
  const double half = 0.5 * width / part,
               middle = part + tool;  // the angle between their middles, seen from the centre
  const double cusp =
      middle * std::cos(half) - std::sqrt(tool * tool - middle * middle * std::sin(half) * std::sin(half));
  EXPECT_NEAR(bend.height(width), cusp - part, 2e-3 * (cusp - part));
  EXPECT_NEAR(bend.width(bend.height(width)), width, 1e-15);
}

TEST(Strip, SharpCornersBendAlongTheirRimAlone) {
  const SurfacePtr table = std::make_shared<Plane>(Frame{}, Rectangle{{-2, 2}, {-2, 2}});
  const ToolAxis lead{ToolAxis::Kind::lead, Vec3(0), ScalarLaw(0.2)};
  const ContactBend bend = contact_bend(contact_on(table, {2, 0, 5, 0}, lead), 0.3);
  EXPECT_NEAR(bend.cutter_across, std::sin(0.2) / 2, 1e-14);
  EXPECT_NEAR(bend.min_difference, std::sin(0.2) / 2, 1e-14);
  EXPECT_TRUE(std::isinf(contact_bend(contact_on(table, {2, 0, 5, 0}, kTilted), 0.3).cutter_across));
}

}  // namespace
}  // namespace lekalo::geometry
