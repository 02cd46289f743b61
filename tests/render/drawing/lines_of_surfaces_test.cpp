// Lines that drawings show of surfaces and what is cut from them, against the same shapes put together of others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/curves/nurbs_curve.h"
#include "geometry/curves/polyline.h"
#include "geometry/surfaces/revolution.h"
#include "render/drawing/random_views.h"
#include "render/drawing/visible_lines.h"
#include "support/tier.h"

namespace lekalo::render {
namespace {

using namespace geometry;

SurfacePtr turned(const std::vector<Vec3>& points) {
  return std::make_shared<RevolutionSurface>(std::make_shared<NurbsCurve>(polyline(points, false)),
                                             Axis{{0, 0, 0}, {0, 0, 1}}, kTwoPi);
}

int layers_at(const VisibleLine& line, double t) {
  for (const VisiblePiece& piece : line.pieces)
    if (piece.t.contains(t)) return piece.layers;
  return -1;
}

// A turned polyline is a stack of cones: its rings at the corners are the cones' borders, and hide as those do.
TEST(LinesOfSurfaces, CreasesAreBordersOfTheirPieces) {
  Views views(17);
  int compared = 0, hidden = 0;
  for (int k = 0; k < tests::tier_count(100, tests::least_of_slow(10)); ++k) {
    std::vector<Vec3> points;
    SurfaceSet parts;
    for (int i = 0; i < 5; ++i) points.push_back({views.number(0.5, 2), 0, views.number(i - 2.4, i - 1.6)});
    for (int i = 0; i < 4; ++i) parts.push_back(turned({points[i], points[i + 1]}));
    SmallScene whole, stack;
    show(whole, turned(points), {"sharp", "silhouette"});
    show(stack, parts, {"boundary", "silhouette"});
    Views same(100 + k);
    same.look(whole, k % 2);
    stack.model.film = whole.model.film, stack.model.camera = whole.model.camera;
    const auto world = whole.world(), world_of_stack = stack.world();
    const VisibleLines found = visible_lines(*world, drawing_work(*world)),
                       expected = visible_lines(*world_of_stack, drawing_work(*world_of_stack));
    EXPECT_EQ(found.incomplete, 0);
    const auto count = [](const VisibleLines& lines, const std::string& kind) {
      return std::count_if(lines.lines.begin(), lines.lines.end(),
                           [&](const VisibleLine& line) { return line.stroke.kind == kind; });
    };
    EXPECT_EQ(count(found, "sharp"), 3);
    EXPECT_EQ(count(found, "silhouette"), count(expected, "silhouette"));
    for (const VisibleLine& line : found.lines)
      for (const VisibleLine& other : expected.lines) {
        const Interval t = line.stroke.curve->domain(), t_other = other.stroke.curve->domain();
        const auto meets = [&](double share) {
          return glm::length(line.stroke.curve->point(t.lo + share * t.width()) -
                             other.stroke.curve->point(t_other.lo + share * t_other.width())) < 1e-9;
        };
        if (!meets(0) || !meets(0.3) || !meets(0.8)) continue;
        for (int i = 0; i < 50; ++i) {
          const double share = views.number(0, 1);
          const int layers = layers_at(line, t.lo + share * t.width());
          EXPECT_EQ(layers, layers_at(other, t_other.lo + share * t_other.width())) << k << " " << share;
          ++compared, hidden += layers > 0;
        }
      }
  }
  EXPECT_GT(hidden, compared / 10);
  EXPECT_GT(compared, 3000);
}

}  // namespace
}  // namespace lekalo::render
