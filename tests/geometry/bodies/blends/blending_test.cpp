// Fillets and chamfers of edges. Volumes by the closed forms of Golovanov 2016, 6.9 to 6.11, and by Steiner's formula.
#include "geometry/bodies/blends/blending.h"

#include <random>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/queries/measures/mass_properties.h"
#include "tests/geometry/bodies/blends/blend_checks.h"

namespace lekalo::geometry::blending_test {
namespace {

using blend_checks::expect_smooth_borders;
using blend_checks::violations_of;

BlendRequest fillet(const Body& body, const std::string& a, const std::string& b, double radius) {
  BlendRequest request;
  request.edges = edges_of(body, a, b);
  request.rule.sizes = {ScalarLaw(radius), ScalarLaw(radius)};
  request.rule.role = "fillets.0", request.rule.field = "radius";
  return request;
}

BlendRequest fillet_all(const Body& body, double radius) {
  BlendRequest request = fillet(body, "none", "none", radius);
  for (size_t e = 0; e < body.edges.size(); ++e) request.edges.push_back(static_cast<int>(e));
  return request;
}

TEST(Blending, EachEdgeOfABox) {
  const Body body = box(frame_about({1, -2, 3}, {1, 2, -2}), {3, 2, 1});
  const char* names[]{"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};
  const double lengths[]{3, 2, 1};
  for (int i = 0; i < 6; ++i)
    for (int j = i + 1; j < 6; ++j) {
      if (i / 2 == j / 2) continue;
      const Body result = blended(body, {fillet(body, names[i], names[j], 0.4)});
      EXPECT_EQ(violations_of(result), "");
      EXPECT_EQ(result.faces.size(), 7u);
      EXPECT_EQ(result.euler_characteristic(), 2);
      const double length = lengths[3 - i / 2 - j / 2];
      EXPECT_NEAR(measure(result).volume.value, 6 - 0.16 * (1 - kPi / 4) * length, 1e-13);
      expect_smooth_borders(result);
    }
}

// Steiner's formula for a box of a, b, c within: V + A r + pi (a + b + c) r^2 + 4/3 pi r^3.
TEST(Blending, AllEdgesAndCornersOfABox) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1), size(1, 3);
  for (int trial = 0; trial < 6; ++trial) {
    const double r = 0.05 + 0.4 * std::abs(any(random));
    const Vec3 d(size(random), size(random), size(random)), i = d - Vec3(2 * r);
    const Body body =
        box(frame_about({any(random), any(random), any(random)}, glm::normalize(Vec3(any(random), any(random), 1))), d);
    const Body result = blended(body, {fillet_all(body, r)});
    EXPECT_EQ(result.faces.size(), 26u);
    EXPECT_EQ(violations_of(result), "");
    const double volume = i.x * i.y * i.z + 2 * (i.x * i.y + i.y * i.z + i.z * i.x) * r +
                          kPi * (i.x + i.y + i.z) * r * r + 4.0 / 3 * kPi * r * r * r;
    EXPECT_NEAR(measure(result).volume.value, volume, 1e-12 * volume);
    expect_smooth_borders(result);
  }
}

// A ball in each convex corner of a pyramid: the volume of what the eroded pyramid and a ball of r sweep (Steiner).
TEST(Blending, AllEdgesOfATetrahedron) {
  const double a = 2, r = 0.1;  // edges of a regular one, its inscribed radius a/sqrt(24)
  const Body body = pyramid(Frame{}, {{0, 0}, {a, 0}, {a / 2, a * std::sqrt(0.75)}},
                            {a / 2, a * std::sqrt(1.0 / 12), a * std::sqrt(2.0 / 3)});
  const Body result = blended(body, {fillet_all(body, r)});
  EXPECT_EQ(violations_of(result), "");
  const double inner = a * (1 - r * std::sqrt(24) / a);
  const double angle = kPi - std::acos(1.0 / 3);  // between normals
  const double volume = inner * inner * inner / std::sqrt(72) + std::sqrt(3) * inner * inner * r +
                        6 * inner * angle / 2 * r * r + 4.0 / 3 * kPi * r * r * r;
  EXPECT_NEAR(measure(result).volume.value, volume, 1e-12);
  expect_smooth_borders(result);
}

// A piece of a sphere between six cylinders at the apex (Golovanov 2016, figure 6.9.7).
TEST(Blending, StarOfSixEdges) {
  std::vector<Vec2> base;
  for (int k = 0; k < 6; ++k) base.push_back(2.0 * Vec2(std::cos(k * kPi / 3), std::sin(k * kPi / 3)));
  const Body body = pyramid(Frame{}, base, {0, 0, 1.5});
  BlendRequest request = fillet(body, "side", "side", 0.2);
  EXPECT_EQ(request.edges.size(), 6u);
  const Body result = blended(body, {request});
  EXPECT_EQ(violations_of(result), "");
  EXPECT_EQ(result.faces.size(), 7u + 6 + 1);
  expect_smooth_borders(result);
}

TEST(Blending, RimsOfACylinder) {
  const Body body = cylinder_body(frame_about({1, 0, 2}, {1, 1, 1}), 1, 2);
  const double r = 0.3, area = r * r * (1 - kPi / 4);
  const double centroid = 1 - 0.223367938945752 * r;  // of the spandrel, from the axis (Golovanov 2016, 6.9)
  const Body one = blended(body, {fillet(body, "end", "side", r)});
  EXPECT_NEAR(measure(one).volume.value, kTwoPi - kTwoPi * centroid * area, 1e-13);
  const Body both = blended(body, {fillet_all(body, r)});
  EXPECT_NEAR(measure(both).volume.value, kTwoPi - 2 * kTwoPi * centroid * area, 1e-13);
  for (const Body* result : {&one, &both}) {
    EXPECT_EQ(violations_of(*result), "");
    expect_smooth_borders(*result);
  }
}

TEST(Blending, RefusesWithTheEdge) {
  const Body body = box(Frame{}, {3, 2, 1});
  try {
    blended(body, {fillet(body, "x_max", "z_max", 1.5)});
    FAIL();
  } catch (const BlendError& error) {
    EXPECT_EQ(error.edge, edges_of(body, "x_max", "z_max")[0]);
    EXPECT_TRUE(error.too_large);
  }
  const Body round = cylinder_body(Frame{}, 1, 2);
  EXPECT_THROW(blended(round, {fillet(round, "end", "side", 1.01)}), BlendError);
}

TEST(EntityNames, FamiliesLeaveNumbersOut) {
  EXPECT_TRUE(is_named({"hole.3", "side", -1}, "hole.side"));
  EXPECT_TRUE(is_named({"hole.3", "side", 2}, "hole.3.side"));
  EXPECT_FALSE(is_named({"hole.3", "side", 2}, "hole.2.side"));
  EXPECT_FALSE(is_named({"", "side", 2}, "end"));
  EXPECT_FALSE(is_named({"hole.3", "side", 2}, "side"));
  const Body body = box(Frame{}, {1, 1, 1});
  EXPECT_EQ(faces_named(body, "block.x_min").size(), 1u);
  EXPECT_EQ(edges_between(body, "x_min", "z_max").size(), 1u);
}

}  // namespace
}  // namespace lekalo::geometry::blending_test
