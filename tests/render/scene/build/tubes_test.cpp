// Tubes and balls in scenes: what they are built from, what is said about wrong ones, and what a World finds of them.
#include <gtest/gtest.h>

#include <random>

#include "geometry/shape.h"
#include "render/scene/scene_text.h"
#include "render/trace/world.h"

namespace lekalo::render::tubes_test {
namespace {

std::string said_about(const std::string& map) {
  const BuiltText text = build_text("geometry:\n  c: { type: circle, radius: 1 }\n  a: " + map + "\n");
  return text.said + text.hints;
}

TEST(Tubes, WrongOnesAreExplained) {
  EXPECT_EQ(said_about("{ type: tube, of: c, radius: 0.1 }"), "");
  EXPECT_EQ(said_about("{ type: tube, of: c, radius: 0 }"), "4:35 the radius must be greater than 0, found 0\n\n");
  EXPECT_EQ(said_about("{ type: tube, of: c, radius: 0.5 - s }"),
            "4:35 the radius must be greater than 0, and at s = 0.5 it is 0\ns runs from 0 to 1 along the curve\n");
  EXPECT_EQ(said_about("{ type: tube, of: c, radius: log(s - 0.5) }"),
            "4:35 the formula has no value at s = 0\ns runs from 0 to 1 along the curve\n");
  EXPECT_EQ(said_about("{ type: tube, of: c, radius: 0.1*t }"),
            "4:39 unknown name 't'\nthis formula is one of 's'; other names are defined under 'parameters'\n");
  EXPECT_EQ(said_about("{ type: tube, of: { type: ball, radius: 1 }, radius: 0.1 }").substr(0, 52),
            "4:32 'ball' makes a body, but a curve is wanted here");
  EXPECT_EQ(said_about("{ type: tube, of: c, radius: 0.1, caps: square }"),
            "4:46 unknown word 'square'\none of round, flat, none\n");
  EXPECT_EQ(said_about("{ type: balls, at: [[0, 0], [1, 1]], radius: [1, 2, 3] }"),
            "4:51 3 radii for 2 points\none for each point, or one for all\n");
  EXPECT_EQ(said_about("{ type: balls, at: [[0, 0], [1, 1]], radius: [1, 0] }"),
            "4:55 expected a value greater than 0, found 0\n\n");
}

// A pole or 0/0 that lies between the places where the formulas are tried.
TEST(Tubes, PlacesWithoutBoundsAreNamed) {
  const auto said = [](const std::string& y, const std::string& domain) {
    return said_about("{ type: tube, of: { type: formula_curve, y: " + y + ", domain: " + domain + " }, radius: 0.1 }");
  };
  const std::string hint = "\na pole, or a place such as 0/0: end the domain before it\n";
  const std::string near = "4:24 the curve has no bounds or no value near its parameter ";
  EXPECT_EQ(said("tan(x)", "[-1, 2]"), near + "1.5708" + hint);
  EXPECT_EQ(said("1/(x - 0.3)", "[-1, 1.31]"), near + "0.3" + hint);
  EXPECT_EQ(said("sin(x - 0.3)/(x - 0.3)", "[-1, 1.31]"), near + "0.3" + hint);
}

TEST(Tubes, TakeParametersAndPlacesAndRepeat) {
  const BuiltText text = build_text(R"(
parameters: { r: 0.2 }
geometry:
  p: [3, 4]
  c: { type: tube, of: { type: segment, from: [0, 0], to: p }, radius: 2*r }
  b: { type: balls, at: [{ repeat: { i: 0..4 }, point: [i, 0, 0] }], radius: r }
lights: {}
)");
  EXPECT_EQ(text.said, "");
  const geometry::Box3 tube = bounds(text.model.geometry.at("c"));
  EXPECT_LE(glm::length(tube.lo - Vec3(-0.4)) + glm::length(tube.hi - Vec3(3.4, 4.4, 0.4)), 1e-12);
  const geometry::Box3 balls = bounds(text.model.geometry.at("b"));
  EXPECT_LE(glm::length(balls.lo - Vec3(-0.2)) + glm::length(balls.hi - Vec3(4.2, 0.2, 0.2)), 1e-12);
}

// A tube under a transform, in a World: hits lie on the mapped tube, in and out by turns, and rays that leave it
// outward to where nothing is meet nothing at their start.
TEST(Tubes, AWorldFindsThemWhereverTheyStand) {
  const BuiltText text = build_text(R"(
geometry:
  c: { type: formula_curve, point: [sin(t) + 2*sin(2*t), cos(t) - 2*cos(2*t), -sin(3*t)], domain: [0, 2*pi], closed: true }
  k: { type: tube, of: c, radius: 0.3 + 0.1*cos(4*pi*s) }
materials: { m: { type: diffuse } }
objects:
  - { shape: k, material: m, transform: [{ scale: [1, 2, 0.5] }, { rotate: 30, axis: x }, { translate: [100, 0, 50] }] }
lights: {}
)");
  ASSERT_EQ(text.said, "");
  const World world(std::make_shared<Model>(text.model));
  const auto shape = std::get<geometry::ShapePtr>(text.model.geometry.at("k"));
  const geometry::Affine& map = text.model.objects[0].transform;
  std::mt19937_64 random(9);
  std::normal_distribution<double> normal;
  int met = 0, leaving = 0;
  for (int i = 0; i < 4000; ++i) {
    Ray ray;
    ray.direction = glm::normalize(Vec3(normal(random), normal(random), normal(random)));
    const Vec3 aim(2 * normal(random), 2 * normal(random), 0.5 * normal(random));
    ray.origin = map.point(aim) - (i % 2 ? 30.0 : 3000.0) * ray.direction;
    const std::vector<Hit> all = world.all_hits(ray);
    std::vector<geometry::SurfaceHit> expected;
    const geometry::Affine back = map.inverse();
    shape->all_hits({back.point(ray.origin), back.direction(ray.direction)}, {0, geometry::kInfinity}, expected);
    ASSERT_EQ(all.size(), expected.size());
    ASSERT_EQ(all.size() % 2, 0u);
    Hit nearest;
    ASSERT_EQ(world.nearest(ray, nearest), !all.empty());
    if (all.empty()) continue;
    EXPECT_EQ(nearest.t, all[0].t);
    ++met;
    for (size_t k = 0; k < all.size(); ++k) {
      EXPECT_LE(std::abs(all[k].t - expected[k].t), 1e-9);
      const SurfacePoint at = world.surface_point(ray, all[k]);
      EXPECT_LE(glm::length(at.position - ray.at(all[k].t)), 1e-7);
      EXPECT_EQ(glm::dot(at.geometric_normal, ray.direction) < 0, k % 2 == 0);
      // Straight off the wall: the next hit, if there is one, is another wall.
      Ray off;
      world.leave(at, at.geometric_normal, off);
      off.direction = at.geometric_normal;
      Hit next;
      EXPECT_TRUE(!world.nearest(off, next) || next.t > 1e-3);
      ++leaving;
    }
  }
  EXPECT_GT(met, 500);
  EXPECT_GT(leaving, 1000);
}

}  // namespace
}  // namespace lekalo::render::tubes_test
