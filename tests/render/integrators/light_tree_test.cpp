// The tree of lamps: its probabilities are those of its choices, no light is left out, and pictures stay the same.
#include "render/integrators/light_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "render/integrators/path.h"
#include "tests/render/small_scene.h"

namespace lekalo::render::light_tree_test {
namespace {

using geometry::kPi;

class Numbers {
 public:
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  Vec3 place(double side) { return {between(-side, side), between(-side, side), between(0.2, 2)}; }
  Vec3 direction() {
    for (;;) {
      const Vec3 v(between(-1, 1), between(-1, 1), between(-1, 1));
      if (const double length = glm::length(v); length > 0.1 && length < 1) return v / length;
    }
  }

 private:
  std::mt19937_64 engine_{5};
};

// Lamps of all kinds, with and without decay, and things that glow, above a plane.
SmallScene many_lamps(const MaterialPtr& material) {
  SmallScene scene;
  Numbers numbers;
  scene.add(plane({0, 0, 0}, {0, 0, 1}), material);
  for (int i = 0; i < 30; ++i) {
    const Lamp lamp{.color = {1, numbers.between(0.2, 1), 0.5},
                    .intensity = i % 4 == 0 ? 0.1 : numbers.between(0.1, 2),
                    .inverse_square = i % 4 != 0};
    const double angle = numbers.between(0.2, 1.5);
    scene.light(PointLight{.position = numbers.place(6), .lamp = lamp});
    scene.light(SpotLight{.position = numbers.place(6),
                          .direction = numbers.direction(),
                          .angle = angle,
                          .inner_angle = 0.5 * angle,
                          .lamp = lamp});
    scene.light(SphereLight{.center = numbers.place(6), .radius = 0.1, .lamp = lamp});
    RectangleLight rectangle;
    rectangle.frame = geometry::frame_about(numbers.place(6), numbers.direction());
    rectangle.size = {0.3, 0.2};
    rectangle.one_sided = i % 2 == 0;
    rectangle.lamp = lamp;
    scene.light(rectangle);
  }
  scene.light(
      DistantLight{.direction = glm::normalize(Vec3(1, 1, -2)), .angular_diameter = 0.1, .lamp = {.intensity = 0.3}});
  for (int i = 0; i < 3; ++i) scene.add(sphere(numbers.place(3), 0.05), make_material(Emission{.strength = 10}));
  return scene;
}

std::shared_ptr<const World> path_world(const SmallScene& scene) {
  auto finished = std::make_shared<Model>(scene.model);
  finished->integrator = make_path_integrator({.photons = 0});
  return std::make_shared<World>(finished);
}

TEST(LightTree, ProbabilitiesAreThoseOfItsChoices) {
  const auto world = path_world(many_lamps(make_material(Diffuse{})));
  const LightTree tree(*world);
  const size_t count = world->lamps().size() + world->glows().size();
  ASSERT_EQ(count, 124u);
  Numbers numbers;
  for (int place = 0; place < 20; ++place) {
    const Vec3 point = numbers.place(7);
    double sum = 0;
    for (size_t i = 0; i < count; ++i) sum += tree.probability(point, i);
    EXPECT_NEAR(sum, 1, 1e-12);
    constexpr int kDrawn = 1 << 14;
    std::vector<int> found(count, 0);
    for (int i = 0; i < kDrawn; ++i) {
      const auto choice = tree.choose(point, (i + 0.5) / kDrawn);
      ASSERT_TRUE(choice);
      ++found[choice->number];
      if (i % 64 == 0) {
        EXPECT_NEAR(choice->probability, tree.probability(point, choice->number), 1e-12);
      }
    }
    // Each lamp's numbers are one stretch of the unit interval.
    for (size_t i = 0; i < count; ++i) EXPECT_NEAR(found[i], kDrawn * tree.probability(point, i), 1.001) << i;
  }
}

TEST(LightTree, LeavesNoLightOut) {
  const auto world = path_world(many_lamps(make_material(Diffuse{})));
  const LightTree tree(*world);
  Numbers numbers;
  for (int place = 0; place < 500; ++place) {
    const Vec3 point = numbers.place(place % 2 == 0 ? 8 : 80);
    for (size_t i = 0; i < world->lamps().size(); ++i)
      for (const Vec2& square : {Vec2(0.5), Vec2(0.01, 0.01), Vec2(0.99, 0.02), Vec2(0.02, 0.97), Vec2(0.98, 0.99)}) {
        if (world->lamps()[i]->sample_all(point, square).irradiance.is_zero()) continue;
        ASSERT_GT(tree.probability(point, i), 0) << i;
      }
  }
}

TEST(LightTree, LampsAtOnePlaceAreChosenByStrength) {
  SmallScene scene;
  scene.add(plane_part({}, {-1, 1}, {-1, 1}), make_material(Diffuse{}));
  for (int i = 1; i <= 100; ++i)
    scene.light(PointLight{.position = {0, 0, 1}, .lamp = {.intensity = 1.0 * i, .inverse_square = true}});
  const auto world = path_world(scene);
  const LightTree tree(*world);
  // But for the tenth of a choice that goes to the lamps of a leaf alike, 8 at most that follow one another.
  for (size_t i = 0; i < 100; ++i) {
    const double found = tree.probability({0.3, 0, 0}, i), strength = static_cast<double>(i + 1) / 5050;
    EXPECT_GT(found, 0.9 * strength);
    EXPECT_LT(found, strength + 0.1 * 7 / 5050);
  }
}

TEST(LightTree, IsForManyLampsOnly) {
  SmallScene scene;
  scene.add(plane_part({}, {-1, 1}, {-1, 1}), make_material(Diffuse{}));
  for (size_t i = 0; i < kManyLamps; ++i) scene.light(PointLight{.position = {1.0 * i, 0, 1}});
  EXPECT_EQ(make_light_tree(*path_world(scene)), nullptr);
  scene.light(PointLight{.position = {0, 2, 1}});
  EXPECT_NE(make_light_tree(*path_world(scene)), nullptr);
}

struct Estimate {
  double mean, error;
};

// Of the first lane, by independent samples.
Estimate estimate(const World& world, const Integrator& integrator, const Vec3& origin, const Vec3& at, int count) {
  Ray ray;
  ray.origin = origin;
  ray.direction = glm::normalize(at - origin);
  Hit first;
  if (!world.nearest(ray, first)) first.instance = -1;
  double sum = 0, squares = 0;
  for (int i = 0; i < count; ++i) {
    SampleStream random(static_cast<uint32_t>(i), 3, 0, 1, 1);
    const double seen = integrator.trace(world, ray, first, random).radiance[0];
    sum += seen;
    squares += seen * seen;
  }
  const double mean = sum / count;
  return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean) / (count - 1))};
}

TEST(LightTree, TwoHundredLampsAreTheSumOfEach) {
  // White matt ground under points of light: sum of I cos / d^2, and no shadows.
  SmallScene scene;
  scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(Diffuse{.color = 1.0}));
  Numbers numbers;
  std::vector<PointLight> lamps;
  for (int i = 0; i < 200; ++i) {
    PointLight lamp{.position = numbers.place(10),
                    .lamp = {.intensity = numbers.between(0.1, 1), .inverse_square = true}};
    lamps.push_back(lamp);
    scene.light(lamp);
  }
  const auto world = path_world(scene);
  const IntegratorPtr by_tree = world->model().integrator->prepared(*world);
  ASSERT_NE(by_tree, nullptr);
  for (const Vec3& at : {Vec3(0, 0, 0), Vec3(5, -3, 0), Vec3(-9, 9, 0), Vec3(30, 0, 0)}) {
    double truth = 0;
    for (const PointLight& lamp : lamps) {
      const Vec3 to = lamp.position - at;
      const double square = glm::dot(to, to);
      truth += lamp.lamp.intensity * to.z / std::sqrt(square) / square;
    }
    const Estimate tree = estimate(*world, *by_tree, at + Vec3(0, -3, 20), at, 40000);
    EXPECT_NEAR(tree.mean, truth, 3.5 * tree.error) << at.x;
    EXPECT_LT(tree.error, 0.02 * truth) << at.x;
  }
}

TEST(LightTree, HundredBallsThatGlowAreTheSumOfEach) {
  // White matt ground under balls: sum of L r^2 cos / d^2. Drawn directions alone would hardly find them.
  SmallScene scene;
  scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(Diffuse{.color = 1.0}));
  constexpr double kRadius = 0.02, kStrength = 100;
  const Vec3 at(0.3, 0.2, 0);
  double truth = 0;
  for (int i = 0; i < 100; ++i) {
    const Vec3 center(i % 10 - 4.5, i / 10 - 4.5, 1);
    scene.add(sphere(center, kRadius), make_material(Emission{.strength = kStrength}));
    const double square = glm::dot(center - at, center - at);
    truth += kStrength * kRadius * kRadius * center.z / std::sqrt(square) / square;
  }
  const auto world = path_world(scene);
  EXPECT_EQ(world->glows().size(), 100u);
  const IntegratorPtr by_tree = world->model().integrator->prepared(*world);
  ASSERT_NE(by_tree, nullptr);
  const Estimate tree = estimate(*world, *by_tree, at + Vec3(0, -0.2, 0.5), at, 10000);
  EXPECT_NEAR(tree.mean, truth, 3.5 * tree.error);
  EXPECT_LT(tree.error, 0.03 * truth);
}

TEST(LightTree, LampsOfAllKindsGiveWhatTheyGiveOneByOne) {
  // Both estimators bring the light of lamps that have a size; rough metal takes it from everywhere.
  for (const MaterialPtr& material :
       {make_material(Diffuse{.color = 0.8}), make_material(Conductor{.metal = "Cu", .roughness = 0.4})}) {
    const auto world = path_world(many_lamps(material));
    const Integrator& plain = *world->model().integrator;
    const IntegratorPtr by_tree = plain.prepared(*world);
    ASSERT_NE(by_tree, nullptr);
    for (const Vec3& at : {Vec3(0.5, 0.3, 0), Vec3(-3, 2, 0)}) {
      const Estimate one = estimate(*world, plain, at + Vec3(0, -4, 12), at, 20000);
      const Estimate tree = estimate(*world, *by_tree, at + Vec3(0, -4, 12), at, 20000);
      EXPECT_NEAR(tree.mean, one.mean, 3.5 * std::hypot(one.error, tree.error)) << at.x;
      RecordProperty("variance_" + std::to_string(at.x), std::to_string(std::pow(tree.error / one.error, 2)));
    }
  }
}

}  // namespace
}  // namespace lekalo::render::light_tree_test
