// Fillets and chamfers against what they are made for: they touch both surfaces, circular sections keep their distance
// from the center, exact tori and cylinders (Golovanov 2016, 4.9, 4.10).
#include <gtest/gtest.h>

#include <random>

#include "geometry/describe.h"
#include "geometry/queries/closest/closest_point.h"
#include "geometry/queries/contours/surface_intersection.h"
#include "geometry/queries/measures/mass_properties.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/surfaces/blends/blend_fields.h"
#include "geometry/surfaces/blends/exact_fillet.h"
#include "geometry/surfaces/splines/nurbs_surface.h"
#include "geometry/surfaces/surface_checks.h"

namespace lekalo::geometry {
namespace {

SurfacePtr floor_at(double z) {
  return std::make_shared<Plane>(Frame{{0, 0, z}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, Rectangle{{-20, 20}, {-20, 20}});
}

SurfacePtr tilted_pipe() {
  const double a = 25 * kPi / 180;
  const Frame frame = frame_from(-4.0 * Vec3(std::sin(a), 0, std::cos(a)), {std::sin(a), 0, std::cos(a)}, {0, 1, 0});
  return std::make_shared<CylinderSurface>(frame, 2, 8);
}

Contacts contacts_of(BlendLaw law) {
  const Contours found = intersect(law.of[0], law.of[1]);
  const Contour& branch = found.branches.front();
  law.guide = branch.curve, law.period = branch.curve->period();
  const double t = branch.curve->domain().middle();
  return Contacts(law, t, {Vec2(branch.images[0]->point(t)), Vec2(branch.images[1]->point(t))});
}

BlendLaw law_of(const SurfacePtr& a, const SurfacePtr& b, BlendKind kind, double first, double second) {
  BlendLaw law;
  law.kind = kind;
  law.of = {a, b};
  law.sizes = {ScalarLaw(first), ScalarLaw(second)};
  return law;
}

struct Fillet {
  BlendCurves curves;
  SurfacePtr surface;
};
Fillet fillet_of(const BlendLaw& law, const SectionShape& shape = {}) {
  const Contacts contacts = contacts_of(law);
  const BlendCurves curves = blend_curves(contacts, shape);
  return {curves, blend_surface(ConicSections{curves, law.of, shape.is_even}, contacts)};
}

double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)); }

// Contact points lie on the surfaces, with their tangent planes.
void check_contacts(const Surface& blend, const std::array<SurfacePtr, 2>& of, int count) {
  const Interval u = blend.domain().u;
  for (int i = 0; i <= count; ++i)
    for (int k = 0; k < 2; ++k) {
      const double t = u.lo + u.width() * i / count;
      const Vec3 p = blend.point(t, k);
      const auto foot = SurfaceProjector(of[k]).foot_points(p).foot_points.front();
      EXPECT_LE(foot.distance, 1e-10);
      const double angle = angle_between(blend.normal(t, k), of[k]->normal(foot.u, foot.v));
      EXPECT_LE(std::min(angle, kPi - angle), 1e-8);
    }
}

TEST(Fillet, TouchesBothSurfacesAndKeepsItsRadius) {
  const std::array<SurfacePtr, 2> of{floor_at(0), tilted_pipe()};
  const Fillet fillet = fillet_of(law_of(of[0], of[1], BlendKind::ball, 0.6, 0.6));
  check_contacts(*fillet.surface, of, 12);
  std::mt19937_64 random(5);
  for (int i = 0; i < 200; ++i) {
    const Vec2 p = checks::random_place(fillet.surface->domain(), random);
    EXPECT_NEAR(glm::length(fillet.surface->point(p.x, p.y) - fillet.curves.center->point(p.x)), 0.6, 1e-12);
  }
}

TEST(Fillet, HasDerivativesAndEnclosures) {
  const Fillet fillet = fillet_of(law_of(floor_at(0), tilted_pipe(), BlendKind::ball, 0.6, 0.6));
  checks::check_differences(*fillet.surface, fillet.surface->domain(), 3, 1e-6);
  checks::check_enclosures(*fillet.surface, fillet.surface->domain());
  checks::check_nurbs(*fillet.surface);
  checks::check_pieces(*fillet.surface);
  checks::check_normals(*fillet.surface, fillet.surface->domain());
  const Fillet even = fillet_of(law_of(floor_at(0), tilted_pipe(), BlendKind::ball, 0.6, 0.6), {0, true});
  checks::check_differences(*even.surface, even.surface->domain(), 3, 1e-6);
}

TEST(Fillet, RunsEvenlyThroughTheArc) {
  const Fillet even = fillet_of(law_of(floor_at(0), tilted_pipe(), BlendKind::ball, 0.6, 0.6), {0, true});
  for (const double t : {0.3, 2.0, 5.5}) {
    const double first = glm::length(even.surface->evaluate(t, 0, 1).dv());
    for (const double v : {0.2, 0.5, 0.9, 1.0})
      EXPECT_NEAR(glm::length(even.surface->evaluate(t, v, 1).dv()), first, 1e-11);
  }
}

TEST(Fillet, OfSphereAndPlaneIsATorus) {
  const SurfacePtr sphere = std::make_shared<SphereSurface>(Frame{}, 5);
  const Fillet fillet = fillet_of(law_of(floor_at(3), sphere, BlendKind::ball, 1, 1));
  std::mt19937_64 random(6);
  for (int i = 0; i < 200; ++i) {
    const Vec2 at = checks::random_place(fillet.surface->domain(), random);
    const Vec3 p = fillet.surface->point(at.x, at.y);
    EXPECT_NEAR(std::hypot(std::hypot(p.x, p.y) - std::sqrt(20.0), p.z - 4), 1, 1e-12);
  }
}

// From the tube's surface or the cylinder's, by their equations.
double distance_from(const Surface& exact, const Vec3& p) {
  if (const auto* torus = dynamic_cast<const TorusSurface*>(&exact)) {
    const Vec3 q = torus->frame().to_local_point(p);
    return std::abs(std::hypot(std::hypot(q.x, q.y) - torus->major_radius(), q.z) - torus->minor_radius());
  }
  const auto& cylinder = dynamic_cast<const CylinderSurface&>(exact);
  const Vec3 q = cylinder.frame().to_local_point(p);
  return std::abs(std::hypot(q.x, q.y) - cylinder.radius());
}

// The points of the sections lie on the analytic form, borders on borders.
void check_exact(const SurfacePtr& a, const SurfacePtr& b, double radius) {
  const BlendLaw law = law_of(a, b, BlendKind::ball, radius, radius);
  const auto exact = exact_fillet(contacts_of(law));
  ASSERT_TRUE(exact);
  const Fillet fillet = fillet_of(law);
  const Interval u = fillet.surface->domain().u;
  for (int i = 0; i <= 8; ++i)
    for (int j = 0; j <= 4; ++j)
      EXPECT_LE(distance_from(*exact, fillet.surface->point(u.lo + u.width() * i / 8, 0.25 * j)), 1e-12);
  const double area = measure(*exact).area.value;
  EXPECT_NEAR(measure(*fillet.surface).area.value, area, 1e-9 * area);
}

TEST(Fillet, IsATorusOrACylinder) {
  const SurfacePtr upright = std::make_shared<CylinderSurface>(Frame{}, 2, 3);
  check_exact(floor_at(1), std::make_shared<SphereSurface>(Frame{}, 5), 0.7);
  check_exact(floor_at(0), upright, 0.5);
  check_exact(upright, floor_at(0), 0.5);
  check_exact(std::make_shared<ConeSurface>(Frame{}, 2, 1, 3), floor_at(0), 0.5);
  const Vec3 z(std::sin(1.0), 0, -std::cos(1.0));
  check_exact(floor_at(0), std::make_shared<Plane>(frame_from(Vec3(0), z, {0, 1, 0}), Rectangle{{-20, 20}, {-20, 20}}),
              1.5);
  EXPECT_FALSE(exact_fillet(contacts_of(law_of(floor_at(0), tilted_pipe(), BlendKind::ball, 0.5, 0.5))));
}

TEST(Fillet, KeepsTheChord) {
  const std::array<SurfacePtr, 2> of{floor_at(0), tilted_pipe()};
  const Fillet fillet = fillet_of(law_of(of[0], of[1], BlendKind::chord, 0.8, 0.8));
  check_contacts(*fillet.surface, of, 12);
  for (double t = 0; t < 6.2; t += 0.3)
    EXPECT_NEAR(glm::length(fillet.surface->point(t, 1) - fillet.surface->point(t, 0)), 0.8, 1e-12);
}

TEST(Fillet, WithOtherSectionsTouchesBothSurfacesToo) {
  const std::array<SurfacePtr, 2> of{floor_at(0), tilted_pipe()};
  check_contacts(*fillet_of(law_of(of[0], of[1], BlendKind::ball, 1, 0.5)).surface, of, 9);
  for (const double weight : {0.4, 1.0, 2.5})
    check_contacts(*fillet_of(law_of(of[0], of[1], BlendKind::ball, 0.6, 0.6), {weight, false}).surface, of, 9);
}

// The contacts have corners where they pass over knots of a surface of class C1.
TEST(Fillet, OfASplineOfTheSecondDegree) {
  std::vector<Vec3> net;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j) net.emplace_back(2 * i - 4, 2 * j - 4, 0.5 * std::sin(3.0 * i + 2.0 * j * j));
  const Knots clamped{"clamped", {}};
  const auto axis = [&] { return make_axis(2, clamped, false, 5, std::vector<double>(4, 1.0)); };
  const SurfacePtr hills = std::make_shared<NurbsSurface>(axis(), axis(), net, std::vector<double>());
  const Frame tilted = frame_from({0.2, 0, 0}, {1, 0.2, 0}, {0, 1, 0});
  const std::array<SurfacePtr, 2> of{hills, std::make_shared<Plane>(tilted, Rectangle{{-20, 20}, {-20, 20}})};
  const Contacts contacts = contacts_of(law_of(of[0], of[1], BlendKind::ball, 0.3, 0.3));
  EXPECT_GE(contacts.breaks().size(), 2u);
  check_contacts(*fillet_of(law_of(of[0], of[1], BlendKind::ball, 0.3, 0.3)).surface, of, 15);
}

TEST(Fillet, TellsWhereTheBallDoesNotFit) {
  BlendLaw law = law_of(floor_at(0), tilted_pipe(), BlendKind::ball, 2.5, 2.5);
  law.sides[1] = -1;  // inside of the pipe of radius 2
  try {
    fillet_of(law);
    FAIL();
  } catch (const FieldError& error) {
    EXPECT_EQ(error.field, "radius");
  }
}

TEST(Chamfer, HasItsLegsInTheTangentPlanes) {
  const std::array<SurfacePtr, 2> of{floor_at(0), tilted_pipe()};
  const BlendLaw law = law_of(of[0], of[1], BlendKind::chamfer, 0.6, 0.4);
  const Contacts contacts = contacts_of(law);
  const BlendCurves curves = blend_curves(contacts, {});
  const SurfacePtr chamfer = blend_surface(StraightSections{curves, law.of}, contacts);
  for (double t = 0; t < 6.2; t += 0.3) {
    const Contact at = contacts.at(t);
    EXPECT_NEAR(glm::length(at.points[0] - at.center), 0.6, 1e-12);
    EXPECT_NEAR(glm::length(at.points[1] - at.center), 0.4, 1e-12);
    for (int k = 0; k < 2; ++k) {
      EXPECT_NEAR(glm::dot(at.points[k] - at.center, at.normals[k]), 0, 1e-12);
      EXPECT_LE(glm::length(chamfer->point(t, k) - at.points[k]), 1e-12);
      EXPECT_LE(SurfaceProjector(of[k]).foot_points(at.points[k]).foot_points.front().distance, 1e-10);
    }
  }
  checks::check_enclosures(*chamfer, chamfer->domain());
}

}  // namespace
}  // namespace lekalo::geometry
