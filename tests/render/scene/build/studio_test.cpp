// The shipped studios: they load, and light a scene as their comments say.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "render/scene/build/load.h"
#include "render/small_scene.h"

namespace lekalo::render::studio_test {
namespace {

namespace fs = std::filesystem;

// A scene of `text` that includes the named studios.
std::shared_ptr<const Model> load(const std::string& text, const std::vector<std::string>& studios) {
  const fs::path file = fs::temp_directory_path() / ("lekalo_studio_" + std::to_string(getpid()) + ".yaml");
  std::ofstream(file) << "lekalo: 1\n" << text;
  LoadOptions options;
  for (const std::string& studio : studios)
    options.includes.push_back(fs::path(LEKALO_SOURCE_DIR) / "scenes/studio" / (studio + ".yaml"));
  const LoadedScene scene = load_scene(file, options);
  fs::remove(file);
  return scene.model;
}

const std::string kWhiteBall =
    "geometry: { orb: { type: sphere_surface, center: [0, 0, 1], radius: 1 } }\n"
    "materials: { white: { type: diffuse, color: 1 } }\n"
    "objects: [{ shape: orb, material: white }]\n";

// The largest radiance on the white ball, seen from a viewer's direction.
float brightest(const World& world, const Vec3& viewer) {
  float most = 0;
  const geometry::Frame frame = geometry::frame_about({0, 0, 1}, viewer);
  for (int i = -9; i <= 9; ++i)
    for (int j = -9; j <= 9; ++j) {
      const RaySample sample = trace(world, frame.point({0.1 * i, 0.1 * j, 5}), -frame.z);
      if (sample.point) most = std::max(most, sample.radiance[1]);
    }
  return most;
}

TEST(Studio, SoftboxLightsAWhiteBallToNearlyWhite) {
  const World world(load(kWhiteBall, {"softbox"}));
  EXPECT_EQ(world.model().lights.size(), 4u);
  // key_power (1 + cos 12.5 deg)/2 + room_power where the key light is faced: its disc has a mean cosine; the rim light
  // does not reach there.
  EXPECT_NEAR(brightest(world, glm::normalize(Vec3(0.5, -0.8, 0.45))), 0.85, 0.03);
}

TEST(Studio, PowersAreParametersOfTheScene) {
  const World world(load("parameters: { key_power: 1.4 }\n" + kWhiteBall, {"softbox"}));
  EXPECT_NEAR(brightest(world, glm::normalize(Vec3(0.5, -0.8, 0.45))), 1.44, 0.03);
}

TEST(Studio, TechnicalLightThrowsNoShadows) {
  const World world(load(kWhiteBall, {"technical"}));
  const RaySample sample = trace(world, {0, -5, 1}, {0, 1, 0});
  EXPECT_EQ(sample.shadow_rays, 0u);
  EXPECT_GT(sample.radiance[0], 0.5f);
  EXPECT_LT(brightest(world, {0, -1, 0}), 1.0f);
}

TEST(Studio, PaperShowsOnlyShadows) {
  const World world(load(kWhiteBall, {"softbox", "paper"}));
  EXPECT_EQ(trace(world, {50, 50, 5}, {0, 0, -1}).radiance, Spectrum(1, 1, 1));
  EXPECT_LT(trace(world, {0.9, 0.9, 0.1}, {0, 0, -1}).radiance[0], 0.9f);
  EXPECT_FALSE(trace(world, {50, 50, -5}, {0, 0, 1}).point);
}

}  // namespace
}  // namespace lekalo::render::studio_test
