// Fillets and chamfers of edges. Volumes by the closed forms of Golovanov 2016, 6.9 to 6.11, and by Steiner's formula.
#include "geometry/bodies/blends/blending.h"

#include <random>

#include "geometry/bodies/booleans/boolean.h"
#include "geometry/bodies/primitives/construct.h"
#include "geometry/bodies/primitives/primitives.h"
#include "geometry/bodies/topology/selection.h"
#include "geometry/queries/measures/mass_properties.h"
#include "tests/geometry/bodies/blends/blend_checks.h"

namespace lekalo::geometry::blending_test {
namespace {

using blend_checks::expect_smooth_borders;
using blend_checks::violations_of;

std::vector<int> edges_of(const Body& body, const std::string& a, const std::string& b) {
  Selector between;
  between.between = {a, b};
  return select(body, Element::edge, between);
}

BlendRequest ball_of(double radius) {
  BlendRequest request;
  request.rule.sizes = {ScalarLaw(radius), ScalarLaw(radius)};
  request.rule.role = "fillets.0", request.rule.field = "radius";
  return request;
}

BlendRequest fillet(const Body& body, const std::string& a, const std::string& b, double radius) {
  BlendRequest request = ball_of(radius);
  request.edges = edges_of(body, a, b);
  return request;
}

BlendRequest fillet_all(const Body& body, double radius) {
  BlendRequest request = ball_of(radius);
  for (size_t e = 0; e < body.edges.size(); ++e)
    if (body.edges[e].kind == EdgeKind::regular) request.edges.push_back(static_cast<int>(e));
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

BlendRequest chamfer(const Body& body, const std::string& a, const std::string& b, double length) {
  BlendRequest request = fillet(body, a, b, length);
  request.rule.kind = BlendKind::chamfer;
  return request;
}

// The prisms that are cut off have d^3/3 in common by twos and d^3/4 by threes.
TEST(Blending, ChamfersMeetInEdges) {
  const Body body = box(Frame{}, {3, 2, 1.5});
  const double d = 0.4, cube = d * d * d;
  const BlendRequest x = chamfer(body, "y_min", "z_max", d), y = chamfer(body, "x_max", "z_max", d),
                     z = chamfer(body, "x_max", "y_min", d);
  const Body two = blended(body, {x, y}), three = blended(body, {x, y, z});
  EXPECT_NEAR(measure(two).volume.value, 9 - d * d / 2 * 5 + cube / 3, 1e-13);
  EXPECT_NEAR(measure(three).volume.value, 9 - d * d / 2 * 6.5 + cube - cube / 4, 1e-13);
}

// The spandrels of two fillets r have the integral of (r - sqrt(r^2 - (r - x)^2))^2 in common, (5/3 - pi/2) r^3.
TEST(Blending, FilletsMeetInEdges) {
  const Body body = box(Frame{}, {3, 2, 1.5});
  const double r = 0.4, area = r * r * (1 - kPi / 4), common = (5.0 / 3 - kPi / 2) * r * r * r;
  BlendRequest top = ball_of(r);
  for (const char* side : {"x_min", "x_max", "y_min", "y_max"}) top.edges.push_back(edges_of(body, side, "z_max")[0]);
  const Body result = blended(body, {top});
  EXPECT_NEAR(measure(result).volume.value, 9 - 10 * area + 4 * common, 1e-13);
  expect_smooth_borders(result);
}

// Where one reaches farther it cuts the third face. The common part of the spandrels by Simpson's rule.
TEST(Blending, FilletsOfTwoRadiiMeet) {
  const Body body = box(Frame{}, {3, 2, 1.5});
  const auto depth = [](double r, double x) { return x < r ? r - std::sqrt(r * r - (r - x) * (r - x)) : 0; };
  for (const bool swap : {false, true}) {
    const double a = swap ? 0.6 : 0.4, b = swap ? 0.4 : 0.6;  // along x, along y
    const double least = std::min(a, b);
    double common = 0;
    constexpr int kSteps = 2000;
    for (int k = 0; k <= kSteps; ++k) {
      const double angle = 0.5 * kPi * k / kSteps, x = least - least * std::sin(angle);
      const double weight = k == 0 || k == kSteps ? 1 : k % 2 ? 4 : 2;
      common += weight * depth(a, x) * depth(b, x) * least * std::cos(angle);
    }
    common *= 0.5 * kPi / kSteps / 3;
    const Body result = blended(body, {fillet(body, "y_min", "z_max", a), fillet(body, "x_max", "z_max", b)});
    EXPECT_NEAR(measure(result).volume.value, 9 - (1 - kPi / 4) * (3 * a * a + 2 * b * b) + common, 1e-11);
    expect_smooth_borders(result);
  }
}

// One after the other: tori about the arcs in which the larger ones end, or blends that lead from radius to radius.
TEST(Blending, CornersOfDifferentRadii) {
  const Body body = box(frame_about({1, 2, 3}, {1, -1, 2}), {3, 2, 1.5});
  const BlendRequest x = fillet(body, "y_min", "z_max", 0.3), y = fillet(body, "x_max", "z_max", 0.5);
  for (const double third : {0.3, 0.2}) {
    const Body result = blended(body, {x, y, fillet(body, "x_max", "y_min", third)});
    EXPECT_EQ(violations_of(result), "");
    EXPECT_EQ(result.faces.size(), 10u);
    expect_smooth_borders(result);
  }
}

TEST(Blending, ConvexAndConcaveEdgesTogether) {
  const Body body = prism(Frame{}, {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}}, 2);
  const Body result = blended(body, {fillet_all(body, 0.3)});
  EXPECT_EQ(violations_of(result), "");
  EXPECT_EQ(result.euler_characteristic(), 2);
  expect_smooth_borders(result);
}

// Holes that leave a face aslant, and cylinders that meet: the seam of a wall leaves the rim obliquely. Whatever its
// place, the fillet is the same.
TEST(Blending, TheSeamMayBeAnywhere) {
  const Body block = box(Frame{}, {3, 3, 2});
  const Vec3 through(1.5, 1.5, 1), along = glm::normalize(Vec3(0.5, 0.2, 1));
  for (const bool is_branch : {false, true}) {
    double first = 0;
    for (int k = 0; k < 5; ++k) {
      const Frame about = frame_about(through, along);
      const Vec3 x = std::cos(1.3 * k) * about.x + std::sin(1.3 * k) * about.y;
      const Body rod = cylinder_body(frame_from(is_branch ? through : through - 3.0 * along, along, x), 0.4, 6);
      const Body whole =
          is_branch ? boolean(BooleanOperation::unite, block, rod) : boolean(BooleanOperation::subtract, block, rod);
      BlendRequest request = ball_of(0.1);
      for (size_t e = 0; e < whole.edges.size(); ++e) {
        const Vec3 p = whole.edges[e].curve->point(whole.edges[e].curve->domain().middle());
        const Vec3 off = p - through - glm::dot(p - through, along) * along;
        if (whole.edges[e].kind == EdgeKind::regular && std::abs(p.z - 2) < 1e-9 && glm::length(off) < 0.4 + 1e-9)
          request.edges.push_back(static_cast<int>(e));
      }
      ASSERT_FALSE(request.edges.empty());
      const Body result = blended(whole, {request});
      EXPECT_EQ(violations_of(result), "");
      expect_smooth_borders(result);
      const double volume = measure(result).volume.value;
      if (k == 0) first = volume;
      EXPECT_NEAR(volume, first, 1e-10 * first) << k;
      EXPECT_EQ(volume > measure(whole).volume.value, is_branch);
    }
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

}  // namespace
}  // namespace lekalo::geometry::blending_test
