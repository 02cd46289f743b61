#include "geometry/surfaces/splines/patches.h"

#include <fstream>
#include <sstream>

#include "geometry/surfaces/splines/nurbs_surface.h"
#include "geometry/surfaces/surface_checks.h"

namespace lekalo::geometry::patches_test {
namespace {

using checks::distance;

std::string teapot_text() {
  std::ifstream file(LEKALO_SOURCE_DIR "/scenes/data/newell_teapot.txt");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string message_of(std::string_view text) {
  try {
    parse_patches(text);
  } catch (const FieldError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Patches, TeapotHas32PatchesInItsBox) {
  const auto patches = parse_patches(teapot_text());
  ASSERT_EQ(patches.size(), 32u);
  Box3 box;
  for (const SurfacePtr& patch : patches) box.include(bounds(*patch));
  EXPECT_LE(distance(box.lo, {-3, -2, 0}), 0.1);
  EXPECT_NEAR(box.hi.z, 3.15, 0.01);
  for (const SurfacePtr& patch : patches) {
    checks::check_pieces(*patch);
    checks::check_degenerate_edges(*patch);
  }
}

// Patches that meet the knob and the bottom have one edge in a point; normals there are vertical limits, the same for
// all patches, and nothing jumps on the way in.
TEST(Patches, TeapotIsSmoothWhereEdgesShrinkToPoints) {
  int collapsed = 0;
  for (const SurfacePtr& patch : parse_patches(teapot_text())) {
    const DegenerateEdges edges = patch->degenerate_edges();
    collapsed += edges.u_min + edges.u_max + edges.v_min + edges.v_max;
    EXPECT_FALSE(edges.v_min || edges.v_max);
    if (!edges.u_min && !edges.u_max) continue;
    const double u = edges.u_min ? 0 : 1, inward = edges.u_min ? 1 : -1;
    for (double v = 0; v <= 1; v += 0.0625) {
      const Vec3 limit = patch->normal(u, v);
      EXPECT_NEAR(std::abs(limit.z), 1, 1e-12);
      for (double d = 1e-14; d < 1e-3; d *= 10)
        EXPECT_LE(distance(patch->normal(u + inward * d, v), limit), 20 * d + 1e-7) << d;
    }
  }
  EXPECT_EQ(collapsed, 8);
}

TEST(Patches, ReadsDegreesCommentsAndCommas) {
  const auto patches = parse_patches(
      "# two patches\n2\n1 1\n0 0 0\n0,1,0\n1 0 0 # corner\n\n1 1 1\n1 2\n0 0 0\n0 1 0\n0 2 0\r\n1 0 0\n1 1 0\n1 2 "
      "0\n");
  ASSERT_EQ(patches.size(), 2u);
  EXPECT_EQ(patches[0]->point(0.5, 0.5), Vec3(0.5, 0.5, 0.25));
  EXPECT_EQ(patches[0]->point(1, 0), Vec3(1, 0, 0));
  const auto& second = dynamic_cast<const NurbsSurface&>(*patches[1]);
  EXPECT_EQ(second.axis_u().degree(), 1);
  EXPECT_EQ(second.axis_v().degree(), 2);
}

TEST(Patches, ErrorsNameTheLine) {
  EXPECT_EQ(message_of(""), "line 0: expected the number of patches");
  EXPECT_EQ(message_of("# nothing\n"), "line 1: expected the number of patches");
  EXPECT_EQ(message_of("1e9\n"), "line 1: expected the number of patches");
  EXPECT_EQ(message_of("1\n0 0 0\n0 0\n"),
            "line 3: expected the three coordinates of point 1 of patch 0, found 2 numbers");
  EXPECT_EQ(message_of("1\n0 0 0\n\n0 x 0\n"), "line 4: 'x' is not a number");
  EXPECT_EQ(message_of("1\n0 0 nan\n"), "line 2: 'nan' is not a number");
  EXPECT_EQ(message_of("1\n1 1\n0 0 0\n"), "line 3: the file ends in patch 0 of 1, after 1 of 4 points");
  EXPECT_EQ(message_of("1\n1 99\n0 0 0\n"), "line 2: expected two degrees from 1 to 25");
  EXPECT_EQ(message_of("1\n1 1\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n5 5 5\n"), "line 7: more points than those of 1 patches");
}

}  // namespace
}  // namespace lekalo::geometry::patches_test
