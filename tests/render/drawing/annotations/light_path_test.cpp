// Ways of light against Snell's law by hand (Golovanov 2016, 8.4).
#include "render/drawing/annotations/light_path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/bodies/primitives/primitives.h"
#include "render/small_scene.h"

namespace lekalo::render::light_path_test {
namespace {

using namespace geometry;

MaterialPtr glass(double index) {
  Dielectric look;
  look.index = index;
  return make_material(look);
}

std::shared_ptr<const World> world_of(const Body& body, MaterialPtr material) {
  SmallScene scene;
  scene.add(std::make_shared<Body>(body), std::move(material));
  scene.model.camera = make_camera(ParallelView{{0, 0, 9}, {0, 0, 0}, {0, 1, 0}, 4}, 64, 64);
  return scene.world();
}

// A slab moves a ray aside by T sin(a) (1 - cos(a) / sqrt(n^2 - sin(a)^2)): 0.32914... for T = 1, 45 degrees, n = 1.5.
TEST(LightPath, SlabMovesItAside) {
  Frame frame;
  frame.origin = {-10, -10, 0};
  const auto world = world_of(box(frame, {20, 20, 1}), glass(1.5));
  LightPath path;
  path.from = {-2, 0, 3}, path.direction = glm::normalize(Vec3(1, 0, -1)), path.length = 5;
  const std::vector<Vec3> corners = light_path(*world, path);
  ASSERT_EQ(corners.size(), 4u);
  EXPECT_LT(glm::length(corners[1] - Vec3(0, 0, 1)), 1e-12);
  const Vec3 out = glm::normalize(corners[3] - corners[2]);
  EXPECT_LT(glm::length(out - path.direction), 1e-7);  // indices are floats
  EXPECT_NEAR(glm::length(corners[3] - corners[2]), 5, 1e-12);
  EXPECT_NEAR(glm::length(glm::cross(corners[2] - path.from, path.direction)), 0.3291423081773203, 1e-7);
}

TEST(LightPath, IsReflectedTotallyAndFollowsTheMirrorRayIfAsked) {
  Frame frame;
  frame.origin = {-1, -1, -1};
  const auto world = world_of(box(frame, {2, 2, 2}), glass(1.5));
  LightPath path;
  path.from = {-2, 0, 0.2}, path.direction = glm::normalize(Vec3(1, 0, 0.5));
  // Within the box 17 degrees above its way: the top is met at 73 degrees from its normal, beyond 41.8, and mirrors it.
  const std::vector<Vec3> inside = light_path(*world, path);
  ASSERT_EQ(inside.size(), 5u);
  EXPECT_NEAR(inside[1].x, -1, 1e-12);
  EXPECT_NEAR(inside[2].z, 1, 1e-12);
  EXPECT_NEAR(inside[3].x, 1, 1e-12);
  EXPECT_LT(glm::length(glm::normalize(inside[4] - inside[3]) - glm::normalize(Vec3(1, 0, -0.5))), 1e-7);
  path.reflection = true;
  const std::vector<Vec3> mirrored = light_path(*world, path);
  ASSERT_EQ(mirrored.size(), 3u);
  EXPECT_LT(glm::length(glm::normalize(mirrored[2] - mirrored[1]) - glm::normalize(Vec3(-1, 0, 0.5))), 1e-12);
  path.bounces = 0;
  EXPECT_EQ(light_path(*world, path).size(), 2u);
}

// Blocks that touch: from one straight into the other, the sines times the indices being the same.
TEST(LightPath, GoesFromOneBlockIntoTheNext) {
  SmallScene scene;
  for (const double z : {0.0, 1.0}) {
    Frame frame;
    frame.origin = {-10, -10, z};
    scene.add(std::make_shared<Body>(box(frame, {20, 20, 1})), glass(z == 0 ? 1.9 : 1.4));
  }
  scene.model.camera = make_camera(ParallelView{{0, 0, 9}, {0, 0, 0}, {0, 1, 0}, 4}, 64, 64);
  LightPath path;
  path.from = {-1, 0, 3}, path.direction = glm::normalize(Vec3(1, 0, -1));
  const std::vector<Vec3> corners = light_path(*scene.world(), path);
  ASSERT_EQ(corners.size(), 5u);
  const double sine = std::sqrt(0.5);
  const auto run = [&](double index) { return sine / std::sqrt(index * index - sine * sine); };
  EXPECT_NEAR(corners[2].x, run(1.4), 1e-7);
  EXPECT_NEAR(corners[3].x, run(1.4) + run(1.9), 1e-7);
  EXPECT_LT(glm::length(glm::normalize(corners[4] - corners[3]) - path.direction), 1e-7);
}

TEST(LightPath, EndsOnWhatIsMatt) {
  const auto world = world_of(ball(Frame(), 1), make_material(ClassicLook()));
  LightPath path;
  path.from = {0, 0, 3}, path.direction = {0, 0, -1};
  const std::vector<Vec3> corners = light_path(*world, path);
  ASSERT_EQ(corners.size(), 2u);
  EXPECT_LT(glm::length(corners[1] - Vec3(0, 0, 1)), 1e-12);
  path.direction = {0, 0, 1};
  EXPECT_EQ(light_path(*world, path).size(), 2u);  // meets nothing
}

}  // namespace
}  // namespace lekalo::render::light_path_test
