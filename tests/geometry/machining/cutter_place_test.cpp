// Places of cutters: they touch, by the distance from the circle of corner centres and from the flank, and are tangent.
#include "geometry/machining/cutter_place.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/ellipse.h"
#include "geometry/machining/deepest_cut.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "tests/geometry/curves/curve_checks.h"

namespace lekalo::geometry {
namespace {

const Rectangle kPart{{0.2, 1.9}, {0.1, 1.0}};
SurfacePtr ring() { return std::make_shared<TorusSurface>(Frame{}, 5.0, 2.0, kPart); }

SurfaceContact contact_on(const SurfacePtr& surface, const ToolAxis& axis, double allowance) {
  SurfaceContact contact;
  contact.line = {surface, IsoDirection::v, 0.7, nullptr};
  contact.cutter = {1.1, 0.4, 3, 0.1};
  contact.axis = axis;
  contact.allowance = allowance;
  return contact;
}

// Distance of a point from the circle on which the middles of the corner lie, and the way there.
Vec3 to_ring(const Cutter& cutter, const CutterPlace<double>& place, const Vec3& point) {
  const Vec3 q = vec(place.axis), middle = vec(place.reference) + cutter.corner_radius * q, off = point - middle;
  return middle + cutter.ring_radius() * glm::normalize(off - glm::dot(off, q) * q) - point;
}

const std::vector<ToolAxis> kAxes{{ToolAxis::Kind::fixed, glm::normalize(Vec3(0.2, -0.1, 1)), ScalarLaw(0.0)},
                                  {ToolAxis::Kind::lead, Vec3(0), ScalarLaw(0.3)},
                                  {ToolAxis::Kind::elevation, Vec3(0), ScalarLaw(1.2)}};

TEST(CutterPlace, CornerTouchesAlongTheNormal) {
  for (const ToolAxis& axis : kAxes)
    for (const double allowance : {0.0, 0.25}) {
      const SurfaceContact contact = contact_on(ring(), axis, allowance);
      for (double t = 0.2; t <= 1.9; t += 0.1) {
        const CutterPlace<double> place = contact.at(t);
        const Vec3 way = to_ring(contact.cutter, place, vec(place.contact));
        EXPECT_NEAR(glm::length(way - (0.4 + allowance) * contact.line.of->normal(t, 0.7)), 0, 1e-13);
        EXPECT_NEAR(glm::length(vec(place.axis)), 1, 1e-14);
      }
    }
}

TEST(CutterPlace, AxesHaveTheirAngles) {
  for (double t = 0.2; t <= 1.9; t += 0.1) {
    const CutterPlace<double> lead = contact_on(ring(), kAxes[1], 0).at(t),
                              raised = contact_on(ring(), kAxes[2], 0).at(t);
    EXPECT_NEAR(dot(lead.axis, lead.normal), std::cos(0.3), 1e-14);
    EXPECT_NEAR(dot(lead.axis, lead.feed), std::sin(0.3), 1e-14);
    EXPECT_NEAR(dot(raised.axis, raised.normal), std::sin(1.2), 1e-14);
    EXPECT_NEAR(dot(raised.axis, raised.feed), 0, 1e-14);
  }
}

TEST(CutterPlace, PathsHaveTheirDerivativesAndEnclosures) {
  for (const ToolAxis& axis : kAxes) {
    const SurfaceContact contact = contact_on(ring(), axis, 0.1);
    CurveProperties properties;
    properties.domain = {0.2, 1.9};
    properties.breaks = {0.2, 1.9};
    properties.max_order = properties.enclosure_order = 3;
    const ComposedCurve<ContactPath<SurfaceContact>> path({contact, PathPoint::reference}, properties);
    checks::check_differences(path, path.domain(), 3, 1e-6);
    checks::check_enclosures(path, path.domain());
  }
}

// How far a point is outside of the flank.
double off_flank(const Cutter& cutter, const CutterPlace<double>& place, const Vec3& point) {
  const Vec3 off = point - vec(place.reference), q = vec(place.axis);
  const double height = glm::dot(off, q), distance = glm::length(off - height * q);
  return (distance - cutter.flank_radius()) * std::cos(cutter.angle) - height * std::sin(cutter.angle);
}

TEST(CutterPlace, FlankTouchesTheCurve) {
  FlankContact contact;
  contact.of = std::make_shared<Ellipse>(Frame{}, 4.0, 3.0, Interval(0, kTwoPi));
  contact.direction = glm::normalize(Vec3(0.1, -0.2, 1));
  contact.cutter = {0.8, 0.2, 4, 0.15};
  contact.allowance = 0.05;
  contact.side = -1;
  contact.height = ScalarLaw(1.3);
  for (double t = 0; t < 6.2; t += 0.3) {
    const CutterPlace<double> place = contact.at(t);
    EXPECT_NEAR(off_flank(contact.cutter, place, vec(place.contact)), 0.05, 1e-13);
    const double step = 1e-4;
    const double before = off_flank(contact.cutter, place, contact.of->point(t - step)),
                 after = off_flank(contact.cutter, place, contact.of->point(t + step));
    EXPECT_NEAR((after - before) / (2 * step), 0, 1e-6);
    EXPECT_GT(std::min(before, after), 0.05);  // the convex curve lies outside
    // h along the generatrix from the height 0, whose direction the axis and l share.
    const double height = glm::dot(vec(place.contact) - vec(place.reference), vec(place.axis));
    EXPECT_NEAR(height, 1.3 * std::cos(0.15) - 0.05 * std::sin(0.15), 1e-13);
  }
}

TEST(CutterPlace, FlankStaysOnThePlane) {
  FlankContact contact;
  contact.of = std::make_shared<Circle>(Frame{}, 4.0);
  contact.direction = glm::normalize(Vec3(0.1, -0.2, 1));
  contact.cutter = {0.8, 0, 4, 0.15};
  contact.side = 1;
  const Vec3 normal = glm::normalize(Vec3(0.1, 0.1, 1)), origin(0.3, 0.2, -1.5);
  contact.plane = {origin, normal};
  for (double t = 0; t < 6.2; t += 0.3) EXPECT_NEAR(glm::dot(vec(contact.at(t).reference) - origin, normal), 0, 1e-13);
}

// The meridian as a polygon: its distance from a point, and whether that is inside.
double depth_by_polygon(const Cutter& cutter, double x, double z) {
  std::vector<Vec2> points;
  for (const MeridianPart& part : meridian(cutter, Frame{}))
    for (int k = 0; k <= 2000; ++k) {
      const Interval d = part.curve->domain();
      const Vec3 p = part.curve->point(d.lo + d.width() * k / 2000);
      points.push_back({p.x, p.z});
    }
  double nearest = kInfinity;
  bool inside = false;
  for (size_t i = 0; i < points.size(); ++i) {
    const Vec2 a = points[i], b = points[(i + 1) % points.size()];
    if ((a.y > z) != (b.y > z) && x < a.x + (z - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
    if (i + 1 == points.size()) continue;  // the axis is no border
    const Vec2 ab = b - a, p(x, z);
    const double square = glm::dot(ab, ab);
    const double s = square > 0 ? std::clamp(glm::dot(p - a, ab) / square, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, glm::length(p - a - s * ab));
  }
  return inside ? nearest : 0;
}

TEST(CutterPlace, DepthInsideIsTheDistanceFromTheMeridian) {
  const std::vector<Cutter> cutters{{1, 0, 3, 0},       {1, 1, 3, 0},      {1, 2, 3, 0},
                                    {1, -1.5, 3, 0},    {1.2, 0, 2, -0.3}, {1.3, 0.4, 0.8, -kPi / 2},
                                    {1.3, 0.4, 3, 0.2}, {1, 0.5, 3, -0.15}};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> x(0.01, 2.2), z(-0.3, 3.2);
  for (const Cutter& cutter : cutters)
    for (int k = 0; k < 200; ++k) {
      const double distance = x(random), height = z(random);
      const double found = std::max(depth_inside(cutter, distance, height), 0.0);
      EXPECT_NEAR(found, depth_by_polygon(cutter, distance, height), 2e-6)
          << cutter.radius << " " << cutter.corner_radius << " " << cutter.angle << " at " << distance << " " << height;
    }
}

}  // namespace
}  // namespace lekalo::geometry
