// Lines of drawings against what rays see at 16 times the picture's resolution: every border between faces is on a
// line, every visible line is on a border.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/bodies/primitives/primitives.h"
#include "render/drawing/picture_places.h"
#include "render/drawing/random_views.h"
#include "render/drawing/visibility/hidden_lines.h"
#include "support/tier.h"
#include "support/worst.h"

namespace lekalo::render::register_test {
namespace {

using namespace geometry;

constexpr int kFiner = 16, kWidth = 40, kHeight = 32;  // pixels of the picture
constexpr double kRegister = 1.6;                      // fine pixels

// A convex body about a place; a convex body's faces meet nowhere but along its lines.
Body convex_body(Views& views, int kind, const Vec3& about) {
  Frame frame = frame_from({0, 0, 0}, views.direction(), views.direction());
  const double r = views.number(0.5, 0.9), h = views.number(0.7, 1.4);
  frame.origin = about - frame.direction(Vec3(0, 0, 0.5 * h));
  switch (kind % 4) {
    case 0: {
      frame.origin = about - frame.direction(Vec3(0.5 * r, 0.5 * h, 0.5 * r));
      return box(frame, {r, h, r});
    }
    case 1:
      return frustum(frame, r, r, h);
    case 2:
      return frustum(frame, r, 0.4 * r, h);
    default:
      frame.origin = about;
      return ball(frame, r);
  }
}

TEST(Register, LinesLieOnBordersOfFaces) {
  Views views(61);
  int borders = 0, places = 0;
  double worst_border = 0, worst_place = 0;
  const int count = tests::tier_count(200, tests::min_of_slow(20));
  for (int k = 0; k < count; ++k) {
    SmallScene scene;
    for (int i = 0; i < 3; ++i) {
      const Vec3 about = 1.5 * Vec3(std::cos(2.1 * i), std::sin(2.1 * i), 0.3 * i);
      show(scene, std::make_shared<Body>(convex_body(views, k + i, about)), {"sharp", "silhouette"});
    }
    scene.model.film.width = kWidth, scene.model.film.height = kHeight;
    const Vec3 from = views.number(8, 14) * views.direction();
    scene.model.camera = k % 2 ? make_camera(PerspectiveView{from, {0, 0, 0}, views.direction(), 0.6}, kWidth, kHeight)
                               : make_camera(ParallelView{from, {0, 0, 0}, views.direction(), 6}, kWidth, kHeight);
    const auto world = scene.world();
    const Camera& camera = *world->model().camera;

    constexpr int kColumns = kWidth * kFiner, kRows = kHeight * kFiner;
    std::vector<std::pair<int, int>> faces(static_cast<size_t>(kColumns) * kRows, {-1, -1});
    for (int j = 0; j < kRows; ++j)
      for (int i = 0; i < kColumns; ++i) {
        const Ray ray = camera.ray((i + 0.5) / kFiner, (j + 0.5) / kFiner);
        if (Hit hit; world->nearest(ray, hit)) {
          const SurfacePoint met = world->surface_point(ray, hit);
          faces[static_cast<size_t>(j) * kColumns + i] = {met.object, hit.face};
        }
      }
    Places on_lines, on_borders;
    std::vector<Vec2> between;
    for (int j = 0; j < kRows; ++j)
      for (int i = 0; i < kColumns; ++i) {
        const auto& face = faces[static_cast<size_t>(j) * kColumns + i];
        if (i + 1 < kColumns && face != faces[static_cast<size_t>(j) * kColumns + i + 1])
          between.emplace_back(i + 1, j + 0.5);
        if (j + 1 < kRows && face != faces[static_cast<size_t>(j + 1) * kColumns + i])
          between.emplace_back(i + 0.5, j + 1);
      }
    for (const Vec2& p : between) on_borders.add(p);
    std::vector<Vec2> seen;
    for (const VisibleLine& line : visible_lines(*world, drawing_work(*world)).lines)
      for (const VisiblePiece& piece : line.pieces) {
        if (piece.layers > 0) continue;
        constexpr int kChords = 64;
        double longest = 0;  // of as many parts
        for (int n = 0; n < kChords; ++n)
          longest = std::max(
              longest, kFiner * glm::length(line.curve->place(piece.t.lo + piece.t.width() * (n + 1) / kChords).p -
                                            line.curve->place(piece.t.lo + piece.t.width() * n / kChords).p));
        const int steps = kChords * (2 + static_cast<int>(4 * longest));
        for (int n = 0; n <= steps; ++n) {
          const Vec2 p = static_cast<double>(kFiner) * line.curve->place(piece.t.lo + piece.t.width() * n / steps).p;
          on_lines.add(p);
          if (p.x > 2 && p.y > 2 && p.x < kColumns - 2 && p.y < kRows - 2) seen.push_back(p);
        }
      }
    for (const Vec2& p : between) worst_border = tests::worse(worst_border, on_lines.distance(p));
    for (const Vec2& p : seen) worst_place = tests::worse(worst_place, on_borders.distance(p));
    borders += static_cast<int>(between.size());
    places += static_cast<int>(seen.size());
  }
  EXPECT_GT(borders, 1000 * count);
  EXPECT_LE(worst_border, kRegister);
  EXPECT_LE(worst_place, kRegister);
  tests::report_figure("borders", borders);
  tests::report_figure("places", places);
  tests::report_figure("farthest_border_from_a_line", worst_border);
  tests::report_figure("farthest_line_from_a_border", worst_place);
}

}  // namespace
}  // namespace lekalo::render::register_test
