// What a scene file may say about the analytic surfaces: each choice of fields builds the surface that it describes,
// and wrong values are refused at the field that holds them.
#include <gtest/gtest.h>

#include "geometry/describe.h"

namespace lekalo::geometry {

TypeDeclaration plane_type();
TypeDeclaration sphere_surface_type();
TypeDeclaration cylinder_surface_type();
TypeDeclaration cone_surface_type();
TypeDeclaration torus_surface_type();
TypeDeclaration hyperboloid_one_sheet_type();
TypeDeclaration hyperboloid_two_sheets_type();
TypeDeclaration elliptic_paraboloid_type();

}  // namespace lekalo::geometry

namespace lekalo::geometry::declarations_test {

namespace {

using Values = std::vector<std::pair<std::string, std::any>>;

// Fields with the given values and the world's frame.
SurfacePtr built(const TypeDeclaration& type, const Values& values) {
  Fields fields;
  fields.set("frame", Frame());
  for (const auto& [name, value] : values) fields.set(name, value);
  return std::any_cast<SurfacePtr>(type.build(fields));
}

std::string refused_field(const TypeDeclaration& type, const Values& values) {
  try {
    built(type, values);
  } catch (const FieldError& error) {
    return error.field;
  }
  return "none";
}

double distance(const Vec3& a, const Vec3& b) { return glm::length(a - b); }

TEST(PlaneDeclaration, SizeIsARectangleAboutTheOrigin) {
  const SurfacePtr plane = built(plane_type(), {{"origin", Vec3(1, 2, 3)}, {"size", std::vector<double>{4, 2}}});
  EXPECT_EQ(plane->domain().u, Interval(-2, 2));
  EXPECT_EQ(plane->domain().v, Interval(-1, 1));
  EXPECT_EQ(plane->point(-2, 1), Vec3(-1, 3, 3));
  EXPECT_FALSE(built(plane_type(), {})->bounded());
  EXPECT_EQ(refused_field(plane_type(), {{"size", std::vector<double>{4, 0}}}), "size");
  EXPECT_EQ(refused_field(plane_type(), {{"size", std::vector<double>{4, 1}}, {"domain", Rectangle{{0, 1}, {0, 1}}}}),
            "size");
}

TEST(SphereDeclaration, RefusesDomainsBeyondThePoles) {
  EXPECT_EQ(refused_field(sphere_surface_type(), {{"radius", 1.0}, {"domain", Rectangle{{0, 1}, {0, 2}}}}), "domain");
  EXPECT_EQ(refused_field(sphere_surface_type(), {{"radius", 1.0}, {"domain", Rectangle{{0, 360}, {0, 1}}}}), "domain");
  EXPECT_EQ(refused_field(sphere_surface_type(), {{"radius", 1.0}, {"domain", Rectangle{{0, 1}, {0, 1}}}}), "none");
}

TEST(ConeDeclaration, TakesTwoRadiiOrAHalfAngle) {
  const SurfacePtr full = built(cone_surface_type(), {{"radius", 2.0}, {"height", 3.0}});
  EXPECT_TRUE(full->degenerate_edges().v_max);
  EXPECT_LE(distance(full->point(1, 1), {0, 0, 3}), 1e-15);
  const SurfacePtr frustum = built(cone_surface_type(), {{"radius", 2.0}, {"height", 3.0}, {"top_radius", 0.5}});
  EXPECT_LE(distance(frustum->point(0, 1), {0.5, 0, 3}), 1e-15);
  const SurfacePtr tilted = built(cone_surface_type(), {{"radius", 2.0}, {"height", 3.0}, {"half_angle", kPi / 4}});
  EXPECT_LE(distance(tilted->point(0, 1), {5, 0, 3}), 1e-14);
  const SurfacePtr unbounded = built(cone_surface_type(), {{"radius", 0.0}, {"half_angle", kPi / 4}});
  EXPECT_FALSE(unbounded->bounded());
  EXPECT_LE(distance(unbounded->point(0, -7), {-7, 0, -7}), 1e-14);
  EXPECT_EQ(refused_field(cone_surface_type(), {{"radius", 2.0}}), "height");
  EXPECT_EQ(refused_field(cone_surface_type(), {{"radius", 0.0}, {"height", 1.0}}), "radius");
  EXPECT_EQ(
      refused_field(cone_surface_type(), {{"radius", 2.0}, {"height", 1.0}, {"half_angle", 0.1}, {"top_radius", 1.0}}),
      "half_angle");
}

TEST(CylinderDeclaration, WithoutAHeightIsUnbounded) {
  EXPECT_TRUE(built(cylinder_surface_type(), {{"radius", 2.0}, {"height", 3.0}})->bounded());
  const SurfacePtr unbounded = built(cylinder_surface_type(), {{"radius", 2.0}});
  EXPECT_FALSE(unbounded->bounded());
  EXPECT_LE(distance(unbounded->point(0, 7), {2, 0, 7}), 1e-15);
}

TEST(TorusDeclaration, ChecksTheSheet) {
  EXPECT_EQ(refused_field(torus_surface_type(), {{"major_radius", -2.0}, {"minor_radius", 1.0}}), "major_radius");
  const SurfacePtr apple = built(torus_surface_type(), {{"major_radius", 1.0}, {"minor_radius", 2.0}});
  EXPECT_NEAR(apple->domain().v.hi, 2 * kPi / 3, 1e-15);
  EXPECT_EQ(refused_field(torus_surface_type(),
                          {{"major_radius", 1.0}, {"minor_radius", 2.0}, {"domain", Rectangle{{0, 1}, {0, 3}}}}),
            "domain");
}

TEST(QuadricDeclarations, CutByHeights) {
  const std::any three = std::vector<double>{2, 1, 1.5}, two = std::vector<double>{2, 1};
  const SurfacePtr one_sheet =
      built(hyperboloid_one_sheet_type(), {{"semi_axes", three}, {"heights", Interval(-3, 1)}});
  EXPECT_NEAR(one_sheet->point(0, one_sheet->domain().v.lo).z, -3, 1e-14);
  EXPECT_NEAR(one_sheet->point(0, one_sheet->domain().v.hi).z, 1, 1e-14);
  const SurfacePtr lower =
      built(hyperboloid_two_sheets_type(),
            {{"semi_axes", three}, {"sheet", std::string("lower")}, {"heights", Interval(1.5, 4)}});
  EXPECT_NEAR(lower->point(0, 0).z, -1.5, 1e-15);
  EXPECT_NEAR(lower->point(0, lower->domain().v.hi).z, -4, 1e-14);
  EXPECT_EQ(refused_field(hyperboloid_two_sheets_type(),
                          {{"semi_axes", three}, {"sheet", std::string("upper")}, {"heights", Interval(1, 4)}}),
            "heights");
  const SurfacePtr bowl = built(elliptic_paraboloid_type(), {{"semi_axes", two}, {"heights", Interval(0, 4)}});
  EXPECT_EQ(bowl->domain().v, Interval(0, 2));
  EXPECT_TRUE(bowl->degenerate_edges().v_min);
  EXPECT_FALSE(built(elliptic_paraboloid_type(), {{"semi_axes", two}})->bounded());
}

}  // namespace
}  // namespace lekalo::geometry::declarations_test
