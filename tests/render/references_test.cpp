// Our pictures against POV-Ray 3.7 (references/README.md): an independent program, the same scene.
//
// A pixel counts where the key (objects along the tree of rays, sides, texture cells, shadows) is the same in its 3 x 3
// neighbourhood: elsewhere an edge passes near the pixel's centre and rounding decides. What counts differs by at most
// 0.002 + 0.001 v, v POV-Ray's value, which is a half float (1/2048 of itself); as a mesh of 0.05 pixels of sag 0.01.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "render/film/render.h"
#include "render/image/exr.h"
#include "render/scene/load.h"
#include "render/scene/pov_export.h"

namespace lekalo::render {
namespace {

namespace fs = std::filesystem;

const fs::path kReferences = fs::path(LEKALO_SOURCE_DIR) / "references";
constexpr double kDifference = 0.002, kRelativeDifference = 0.001;
constexpr double kMeshDifference = 0.01, kMeshSagInPixels = 0.05;
constexpr double kMostExcluded = 0.1;

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const auto& entry : fs::directory_iterator(kReferences / "scenes"))
    if (entry.path().extension() == ".yaml") all.push_back(entry.path().stem().string());
  std::sort(all.begin(), all.end());
  return all;
}

bool is_flat(const Channel& key, int width, int height, int x, int y) {
  const uint32_t own = key.ids[static_cast<size_t>(y) * width + x];
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height - 1); ++j)
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width - 1); ++i)
      if (key.ids[static_cast<size_t>(j) * width + i] != own) return false;
  return true;
}

// nurbs_NAME shows the scene NAME with its shape in NURBS form: POV-Ray has no such shape, but the same picture.
std::string picture_of(const std::string& name) { return name.starts_with("nurbs_") ? name.substr(6) : name; }

void compare(const std::string& name, std::shared_ptr<const Model> model, double allowed, double allowed_relative) {
  const World world(std::move(model));
  RenderOptions options;
  options.threads = 1;
  options.key_layer = true;
  const Image ours = render(world, options).image;
  const Image theirs = read_exr(kReferences / (picture_of(name) + ".exr"));
  ASSERT_EQ(ours.width, theirs.width);
  ASSERT_EQ(ours.height, theirs.height);
  const Channel* key = find_channel(ours, "id.key");
  ASSERT_NE(key, nullptr);
  const ColorPlanes a = color_planes(ours), b = color_planes(theirs);

  int excluded = 0, wrong = 0;
  double worst = 0;  // difference as a multiple of what is allowed
  std::ostringstream where;
  for (int y = 0; y < ours.height; ++y)
    for (int x = 0; x < ours.width; ++x) {
      if (!is_flat(*key, ours.width, ours.height, x, y)) {
        ++excluded;
        continue;
      }
      const size_t i = static_cast<size_t>(y) * ours.width + x;
      double here = 0;
      for (const auto& [p, q] : {std::pair{a.r, b.r}, std::pair{a.g, b.g}, std::pair{a.b, b.b}})
        here = std::max(here, std::abs(double{p[i]} - q[i]) / (allowed + allowed_relative * q[i]));
      if (here > 1) ++wrong;
      if (here > worst) {
        worst = here;
        where.str("");
        where << "(" << x << ", " << y << "): ours " << a.r[i] << " " << a.g[i] << " " << a.b[i] << ", POV-Ray's "
              << b.r[i] << " " << b.g[i] << " " << b.b[i];
      }
    }
  const double share = excluded / (1.0 * ours.width * ours.height);
  std::printf("%s: largest difference %.3f of the allowed one, %.2f%% of the pixels excluded\n", name.c_str(), worst,
              100 * share);
  EXPECT_EQ(wrong, 0) << "worst at " << where.str();
  EXPECT_LE(share, kMostExcluded);
}

class Reference : public testing::TestWithParam<std::string> {
 protected:
  fs::path scene() const { return kReferences / "scenes" / (GetParam() + ".yaml"); }
};

TEST_P(Reference, LooksAsInPovRay) { compare(GetParam(), load_scene(scene()).model, kDifference, kRelativeDifference); }

TEST_P(Reference, LooksAsInPovRayAsMesh) {
  auto model = std::make_shared<Model>(*load_scene(scene()).model);
  for (Object& object : model->objects) {
    object.representation = Representation::mesh;
    object.sag_pixels = kMeshSagInPixels;
  }
  compare(GetParam(), model, kMeshDifference, 0);
}

// The committed source is what the exporter writes now, and nothing in it is only nearly the scene.
TEST_P(Reference, SourceIsUpToDate) {
  if (picture_of(GetParam()) != GetParam()) return;
  const PovScene exported = pov_scene(*load_scene(scene()).model);
  std::ifstream file(kReferences / (GetParam() + ".pov"));
  std::ostringstream committed;
  committed << file.rdbuf();
  EXPECT_EQ(exported.text, committed.str()) << "run tools/references " << GetParam();
  for (const std::string& note : exported.notes) ADD_FAILURE() << note;
}

INSTANTIATE_TEST_SUITE_P(PovRay, Reference, testing::ValuesIn(names()),
                         [](const auto& reference) { return reference.param; });

}  // namespace
}  // namespace lekalo::render
