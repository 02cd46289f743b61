// Implicit surfaces of scene files: what is said about wrong ones, and their rays through the World against the body of
// the same shape.
#include <gtest/gtest.h>

#include <random>

#include "render/scene/scene_text.h"
#include "render/trace/world.h"
#include "support/tier.h"

namespace lekalo::render::implicit_test {
namespace {

BuiltText built(const std::string& fields) {
  return build_text("geometry:\n  a: { type: implicit, " + fields + " }\n");
}
std::string said(const std::string& fields) { return built(fields).said; }

TEST(Implicit, WrongOnesAreExplained) {
  const std::string cube = ", box: { min: [-1, -1, -1], max: [1, 1, 1] }";
  EXPECT_EQ(said("formula: x + y" + cube), "");
  EXPECT_EQ(said("formula: x + y, ball: { radius: 1 }"), "");
  EXPECT_EQ(said("formula: x + u" + cube), "3:37 unknown name 'u'\n");
  EXPECT_EQ(built("formula: x + u" + cube).hints,
            "this formula is one of 'x', 'y', 'z'; other names are defined under 'parameters'\n");
  EXPECT_EQ(said("formula: x + y"), "3:6 an implicit surface needs a region\n");
  EXPECT_EQ(built("formula: x + y").hints,
            "write box: { min: [-1, -1, -1], max: [1, 1, 1] }, or ball: { radius: 1 }\n");
  EXPECT_EQ(said("formula: x, ball: { radius: 1 }" + cube), "3:42 both 'box' and 'ball' are given\n");
  EXPECT_EQ(said("formula: x, box: { min: [1, 1, 1], max: [1, 2, 3] }"), "3:41 the region is empty\n");
  EXPECT_EQ(said("formula: log(x)" + cube), "3:33 the formula has no value at x = -1, y = -1, z = -1\n");
  EXPECT_EQ(said("formula: 1 + 2" + cube), "3:33 the formula is constant: it names none of x, y, z\n");
  EXPECT_EQ(said("formula: x^2 + 1" + cube),
            "3:47 the surface does not meet the region: the formula is larger than the level there\n");
  EXPECT_EQ(built("formula: x^2 + 1" + cube).hints, "choose another level or region\n");
  EXPECT_EQ(said("box: { min: [0, 0, 0], max: [1, 1, 1] }"), "3:6 missing field 'formula' of 'implicit'\n");
}

TEST(Implicit, NamesOfParametersHaveTheirValues) {
  const BuiltText scene = build_text(
      "parameters: { r: 2 }\n"
      "geometry: { a: { type: implicit, formula: x^2 + y^2 + z^2 - r^2, ball: { radius: r + 1 } } }\n");
  ASSERT_EQ(scene.said, "");
  const geometry::Box3 box = bounds(scene.model.geometry.at("a"));
  EXPECT_TRUE(box.contains({2, 0, 0}) && box.hi.x < 2.3);
}

// The same rays meet an implicit ball and the body, shown directly, moved and stretched.
TEST(Implicit, RaysSeeTheBallThatTheBodyIs) {
  for (const std::string place :
       {"", ", transform: [{ scale: [1, 2, 3] }, { rotate: 30, axis: x }, { translate: [5, 6, 7] }]"})
    for (const std::string way : {"", " + 0*sin(x)"}) {
      const auto world_of = [&](const std::string& shape) {
        BuiltText scene = build_text("geometry:\n  a: " + shape + "\nobjects: [{ shape: a" + place + " }]\n");
        EXPECT_EQ(scene.said, "");
        return std::make_shared<World>(std::make_shared<const Model>(std::move(scene.model)));
      };
      const auto implicit = world_of("{ type: implicit, formula: x^2 + y^2 + z^2 - 1" + way +
                                     ", box: { min: [-1.5, -1.5, -1.5], max: [1.5, 1.5, 1.5] }, closed: true }");
      const auto body = world_of("{ type: ball, radius: 1 }");
      std::mt19937_64 random(9);
      std::normal_distribution<double> normal;
      const auto vector = [&] {
        const double x = normal(random), y = normal(random);
        return Vec3(x, y, normal(random));
      };
      int hits = 0;
      for (int i = 0; i < tests::tier_count(100000); ++i) {
        Ray ray;
        ray.direction = glm::normalize(vector());
        ray.origin = body->center() + body->radius() * (0.4 * vector() - 4.0 * ray.direction);
        Hit a, b;
        const bool met = implicit->nearest(ray, a);
        ASSERT_EQ(met, body->nearest(ray, b)) << "ray " << i;
        ASSERT_EQ(implicit->occluded(ray), met);
        ASSERT_EQ(implicit->all_hits(ray).size(), body->all_hits(ray).size());
        if (!met) continue;
        ++hits;
        const SurfacePoint p = implicit->surface_point(ray, a), q = body->surface_point(ray, b);
        const double steep = std::abs(glm::dot(q.normal, ray.direction));
        if (steep < 1e-3) continue;
        ASSERT_LE(glm::length(p.position - q.position), 1e-12 * body->radius() / steep);
        ASSERT_LE(glm::length(p.normal - q.normal), 1e-11 / steep);
        // A ray that leaves does not meet the place again.
        Ray left;
        left.direction = glm::reflect(ray.direction, p.normal);
        implicit->leave(p, left.direction, left);
        ASSERT_FALSE(implicit->nearest(left, a)) << "ray " << i;
      }
      EXPECT_GT(hits, 10);
    }
}

}  // namespace
}  // namespace lekalo::render::implicit_test
