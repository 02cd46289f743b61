// The lines that a drawing shows of every type of surface, by the example of its declaration, against the halving
// oracle over its patches: a parallel view and a central one.
#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/transformed.h"
#include "render/drawing/line_truth.h"
#include "render/every_surface/examples.h"
#include "support/interpolated_patches.h"

namespace lekalo::render::every_surface_truth_test {
namespace {

// In the middle of the picture, which is eight units high.
SurfacePtr in_the_middle(const SurfacePtr& surface) {
  const Box3 box = bounds(*surface);
  const double scale = 6 / box.diameter();
  return transformed(surface, Affine::scaling(Vec3(scale)) * Affine::translation(-box.center()));
}

// Outlines are polynomials that agree with the solved ones to some 1e-10: on a sheet that hardly bends along the line
// of sight the two crossings of the one contact are as far apart as this. Patches of what has none of its own are 1e-11
// of the size off it, by so much more along a line that grazes them.
constexpr double kContactOfFits = 1e-3, kOwnOfFits = 1e-5;

class EverySurfaceTruth : public testing::TestWithParam<std::string> {};

TEST_P(EverySurfaceTruth, LinesAreSeenAndHidden) {
  const SurfacePtr surface = in_the_middle(every_surface::short_example(GetParam()));
  const std::vector<SurfacePtr> patches = tests::patches_of(surface);
  const Sheets sheets =
      patches.front() == surface ? sheets_of_patches(patches) : sheets_of_patches(patches, kOwnOfFits, 10 * kOwnOfFits);
  Views views(51);
  Found found;
  for (int k = 0; k < tests::tier_count(20, 2); ++k) {
    SmallScene scene;
    show(scene, SurfaceSet{surface}, {"boundary", "silhouette", "sharp", "parameter"}, 3);
    views.look(scene, k % 2);
    Truth(*scene.world(), sheets, views, found, 3, kBisected, kContactOfFits);
  }
  expect_nothing_wrong(found);
  // Of one type there are few lines, and the seams and poles of some are most of them.
  EXPECT_LE(found.unclear, (found.places + found.transitions) / 4);
  // These are right within the hundredth of a pixel that drawings promise, but not to rounding: outlines of what has no
  // patches are fitted so. They are not to be the rule.
  EXPECT_LE(found.near, std::max(3, found.transitions / 8));
}

INSTANTIATE_TEST_SUITE_P(Types, EverySurfaceTruth, testing::ValuesIn(every_surface::surface_type_names()),
                         [](const auto& type) { return type.param; });

}  // namespace
}  // namespace lekalo::render::every_surface_truth_test
