// Our pictures against POV-Ray 3.7 (references/README.md): an independent program, the same scene.
//
// A pixel counts where the key (objects along the tree of rays, sides, texture cells, shadows) is the same in its 3 x 3
// neighbourhood: elsewhere an edge passes near the pixel's centre and rounding decides. What counts differs by at most
// 0.002 + 0.001 v, v POV-Ray's value, which is a half float (1/2048 of itself); as a mesh of 0.05 pixels of sag 0.01. A
// mesh's own edges and those of the exact shape, which POV-Ray shows, lie up to the sag apart (much further seen
// through glass): there both keys must be the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "render/film/render.h"
#include "render/image/exr.h"
#include "render/pov/pov_export.h"
#include "render/scene/build/load.h"
#include "support/worst.h"

namespace lekalo::render::references_test {
namespace {

namespace fs = std::filesystem;

const fs::path kReferences = fs::path(LEKALO_SOURCE_DIR) / "references";
constexpr double kDifference = 0.002, kRelativeDifference = 0.001;
constexpr double kMeshDifference = 0.01, kMeshSagInPixels = 0.05;
constexpr double kMaxExcluded = 0.1;

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

Image picture_with_key(const std::shared_ptr<const Model>& model) {
  const World world(model);
  RenderOptions options;
  options.threads = 1;
  options.key_layer = true;
  return render(world, options).image;
}

// `exact`: our picture of the exact shapes.
void compare(const std::string& name, const Image& ours, const Image& exact, double allowed, double allowed_relative) {
  const Image theirs = read_exr(kReferences / (picture_of(name) + ".exr"));
  ASSERT_EQ(ours.width, theirs.width);
  ASSERT_EQ(ours.height, theirs.height);
  const Channel *key = find_channel(ours, "id.key"), *exact_key = find_channel(exact, "id.key");
  ASSERT_TRUE(key && exact_key);
  const ColorPlanes a = color_planes(ours), b = color_planes(theirs);

  int excluded = 0, wrong = 0;
  double worst = 0;  // difference as a multiple of what is allowed
  std::ostringstream where;
  for (int y = 0; y < ours.height; ++y)
    for (int x = 0; x < ours.width; ++x) {
      const size_t i = static_cast<size_t>(y) * ours.width + x;
      if (key->ids[i] != exact_key->ids[i] || !is_flat(*key, ours.width, ours.height, x, y) ||
          !is_flat(*exact_key, ours.width, ours.height, x, y)) {
        ++excluded;
        continue;
      }
      double here = 0;
      for (const auto& [p, q] : {std::pair{a.r, b.r}, std::pair{a.g, b.g}, std::pair{a.b, b.b}})
        here = tests::worse(here, std::abs(double{p[i]} - q[i]) / (allowed + allowed_relative * q[i]));
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
  EXPECT_LE(share, kMaxExcluded);
}

TEST(Worst, NoNumberIsWorseThanAnyNumber) {
  const double nan = std::nan("");
  EXPECT_EQ(tests::worse(1, 2), 2);
  EXPECT_EQ(tests::worse(2, 1), 2);
  EXPECT_GT(tests::worse(2, nan), 1e300);
  EXPECT_GT(tests::worse(tests::worse(2, nan), 1), 1e300);
}

class Reference : public testing::TestWithParam<std::string> {
 protected:
  fs::path scene() const { return kReferences / "scenes" / (GetParam() + ".yaml"); }
};

TEST_P(Reference, LooksAsInPovRay) {
  const Image ours = picture_with_key(load_scene(scene()).model);
  compare(GetParam(), ours, ours, kDifference, kRelativeDifference);
}

TEST_P(Reference, LooksAsInPovRayAsMesh) {
  const std::shared_ptr<const Model> exact = load_scene(scene()).model;
  auto model = std::make_shared<Model>(*exact);
  for (Object& object : model->objects) {
    object.representation = Representation::mesh;
    object.sag_pixels = kMeshSagInPixels;
  }
  compare(GetParam(), picture_with_key(model), picture_with_key(exact), kMeshDifference, 0);
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
}  // namespace lekalo::render::references_test
