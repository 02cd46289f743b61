// Areas of `ground: fill` against what rays see at random places of the picture, and hatching against areas.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/shapes/csg/body_shape.h"
#include "geometry/shapes/csg/csg.h"
#include "geometry/surfaces/splines/bezier_surface.h"
#include "render/drawing/figure.h"
#include "render/drawing/random_solids.h"
#include "render/scene/build/load.h"
#include "support/tier.h"

namespace lekalo::render::fills_test {
namespace {

using namespace geometry;

constexpr double kNearBorder = 0.05;  // pixels: places so near to another area are not judged

struct Area {
  std::string object;
  std::vector<Path> whole, shade;
  std::vector<std::vector<Path>> gradients;
};

void collect(const std::vector<SheetItem>& items, std::vector<Area>& areas) {
  for (const SheetItem& item : items) {
    const auto* group = std::get_if<SheetGroup>(&item);
    if (!group) continue;
    if (group->kind == "fill") {
      Area area{group->object, {}, {}, {}};
      for (const SheetItem& one : group->items) {
        const auto* path = std::get_if<SheetPath>(&one);
        if (path && path->brush) (area.whole.empty() ? area.whole : area.shade) = path->parts;
        if (path && path->gradient) area.gradients.push_back(path->parts);
      }
      areas.push_back(std::move(area));
    } else {
      collect(group->items, areas);
    }
  }
}

// By the even-odd rule, of paths as fine polygons.
bool contains(const std::vector<Path>& paths, const Vec2& p) {
  constexpr int kChords = 256;
  bool inside = false;
  for (const Path& path : paths) {
    Vec2 from = path.from;
    const auto chord = [&](const Vec2& a, const Vec2& b) {
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
    };
    for (const PathStep& step : path.steps) {
      Vec2 last = from;
      const int chords = step.kind == PathStep::Kind::line ? 1 : kChords;
      for (int k = 1; k <= chords; ++k) {
        const Vec2 next = point_on(from, step, static_cast<double>(k) / chords);
        chord(last, next);
        last = next;
      }
      from = step.to;
    }
    chord(from, path.from);
  }
  return inside;
}

struct Judged {
  int places = 0, wrong = 0, open = 0, views = 0, left = 0;
  int plain = 0;  // places without a gradient, though there are some
};

void judge(SmallScene& scene, Views& random, Judged& found, Fill::Shading shading) {
  scene.model.drawing.ground = Ground::fill;
  scene.model.drawing.fill.shading = shading;
  const bool two_tone = shading == Fill::Shading::two_tone;
  for (size_t k = 0; k < scene.model.objects.size(); ++k) scene.model.objects[k].name = std::to_string(k);
  const auto world = scene.world();
  const Camera& camera = *world->model().camera;
  const Vec3 light = light_of(scene.model.drawing.fill, camera);
  const Figure figure = figure_of(std::make_shared<const Model>(world->model()), {});
  ++found.views;
  if (figure.incomplete > 0) {
    ++found.left;
    return;
  }
  found.open += figure.open_areas;
  std::vector<Area> areas;
  collect(figure.sheet.items, areas);
  const double millimetres = figure.sheet.width / camera.width();
  for (int k = 0; k < 400; ++k) {
    const Vec2 p(random.number(0, camera.width()), random.number(0, camera.height()));
    const auto seen = [&](const Vec2& at) {
      const Ray ray = camera.ray(at.x, at.y);
      Hit hit;
      if (!world->nearest(ray, hit)) return std::pair(-1, false);
      const SurfacePoint point = world->surface_point(ray, hit);
      const double facing = glm::dot(point.geometric_normal, ray.direction) < 0 ? 1 : -1;
      return std::pair(point.object, two_tone && facing * glm::dot(point.geometric_normal, light) < 0);
    };
    const auto here = seen(p);
    bool clear = true;
    for (int i = 0; i < 8 && clear; ++i)
      clear = seen(p + kNearBorder * Vec2(std::cos(kPi / 4 * i), std::sin(kPi / 4 * i))) == here;
    if (!clear) continue;
    ++found.places;
    for (const Area& area : areas) {
      const bool own = area.object == std::to_string(here.first);
      if (contains(area.whole, millimetres * p) != own || contains(area.shade, millimetres * p) != (own && here.second))
        ++found.wrong;
      const auto gradients = std::count_if(area.gradients.begin(), area.gradients.end(),
                                           [&](const auto& one) { return contains(one, millimetres * p); });
      // Areas that are too small for a gradient have none.
      if (gradients > (own ? 1 : 0)) ++found.wrong;
      if (own && gradients == 0 && shading == Fill::Shading::gradient) ++found.plain;
    }
    const bool drawn = std::any_of(areas.begin(), areas.end(),
                                   [&](const Area& area) { return area.object == std::to_string(here.first); });
    if (here.first >= 0 && !drawn) ++found.wrong;
  }
}

void expect_right(const Judged& found, const char* name) {
  EXPECT_EQ(found.wrong, 0) << name;
  EXPECT_EQ(found.open, 0) << name;
  EXPECT_LE(found.plain, found.places / 1000) << name;
  EXPECT_LE(found.left, found.views / 20) << name;
  EXPECT_GT(found.places, 300 * (found.views - found.left)) << name;
  tests::report_figure(std::string(name) + " views", found.views);
  tests::report_figure(std::string(name) + " places", found.places);
}

// Bodies that hide and pierce one another.
TEST(Fills, OfManySolids) {
  for (const Fill::Shading shading : {Fill::Shading::flat, Fill::Shading::two_tone}) {
    Views views(71);
    Judged found;
    for (int k = 0; k < tests::tier_count(500, tests::min_of_slow(12)); ++k) {
      SmallScene scene;
      for (int i = 0; i < 4; ++i) show(scene, std::make_shared<Body>(random_part(views, k + i, 1.5).body), {"sharp"});
      views.look(scene, k % 2);
      judge(scene, views, found, shading);
    }
    expect_right(found, shading == Fill::Shading::flat ? "solids" : "solids in two tones");
  }
}

TEST(Fills, OfCsg) {
  for (const Fill::Shading shading : {Fill::Shading::two_tone, Fill::Shading::gradient}) {
    Views views(73);
    Judged found;
    for (int k = 0; k < tests::tier_count(500, tests::min_of_slow(10)); ++k) {
      SmallScene scene;
      const auto shape = [&](int kind) -> ShapePtr {
        return std::make_shared<BodyShape>(std::make_shared<Body>(random_part(views, kind, 0.5).body));
      };
      try {
        show(scene,
             ShapePtr(
                 std::make_shared<Csg>(Csg::Operation::subtract, std::vector<ShapePtr>{shape(k), shape(k / 3 + 1)})),
             {"sharp"});
      } catch (const std::invalid_argument&) {
        continue;
      }
      views.look(scene, k % 2);
      judge(scene, views, found, shading);
    }
    expect_right(found, shading == Fill::Shading::two_tone ? "csg" : "csg with gradients");
  }
}

// Gradients end at smooth edges and go on where the parts have a surface in common, as seen from all around. From above
// the front all of the areas are seen, so many of each.
TEST(Fills, GradientsOfCsg) {
  const auto shape = [](Body body) -> ShapePtr {
    return std::make_shared<BodyShape>(std::make_shared<Body>(std::move(body)));
  };
  const auto upright = [&](double z, double radius, double height) {
    return shape(cylinder_body(frame_from({0, 0, z}, {0, 0, 1}, {1, 0, 0}), radius, height));
  };
  struct Solid {
    const char* name;
    ShapePtr one, other;
    size_t areas;
  };
  const Solid solids[] = {
      {"a shaft that ends in a ball", upright(-1, 1, 1), shape(ball(Frame(), 1)), 2},
      {"a column of two", upright(-1, 1, 1), upright(0, 1, 1), 2},
      {"a plate with a round end", shape(box(frame_from({-0.8, -2, -0.5}, {0, 0, 1}, {1, 0, 0}), {1.6, 2, 1})),
       upright(-0.5, 0.8, 1), 3},
      {"a step", shape(box(frame_from({-1, -1, -1}, {0, 0, 1}, {1, 0, 0}), {1, 2, 1})),
       shape(box(frame_from({0, -1, -1}, {0, 0, 1}, {1, 0, 0}), {1, 2, 2})), 5}};
  const auto world_of = [](SmallScene& scene, const Solid& solid) {
    show(scene, ShapePtr(std::make_shared<Csg>(Csg::Operation::unite, std::vector<ShapePtr>{solid.one, solid.other})),
         {"sharp"});
  };
  Views views(97);
  Judged found;
  for (const Solid& solid : solids) {
    for (int k = 0; k < tests::min_of_slow(2); ++k) {
      SmallScene scene;
      world_of(scene, solid);
      views.look(scene, k % 2);
      judge(scene, views, found, Fill::Shading::gradient);
    }
    SmallScene scene;
    world_of(scene, solid);
    scene.model.film.width = 600, scene.model.film.height = 500;
    scene.model.camera = make_camera(ParallelView{{-4, 3, 4}, {0, 0, 0}, {0, 0, 1}, 6}, 600, 500);
    scene.model.drawing.ground = Ground::fill;
    scene.model.drawing.fill.shading = Fill::Shading::gradient;
    const Figure figure = figure_of(std::make_shared<const Model>(scene.world()->model()), {});
    EXPECT_EQ(figure.open_areas, 0) << solid.name;
    std::vector<Area> areas;
    collect(figure.sheet.items, areas);
    ASSERT_EQ(areas.size(), 1u);
    EXPECT_EQ(areas[0].gradients.size(), solid.areas) << solid.name;
  }
  expect_right(found, "gradients of csg");
}

TEST(Fills, OfSheetsThatPierceOneAnother) {
  Views views(79);
  Judged found;
  for (int k = 0; k < tests::tier_count(500, tests::min_of_slow(10)); ++k) {
    SmallScene scene;
    for (int n = 0; n < 2; ++n) {
      show(scene, sheet_through_the_middle(views, n == 0), {"boundary"});
    }
    views.look(scene, k % 2);
    judge(scene, views, found, Fill::Shading::two_tone);
  }
  expect_right(found, "sheets");
}

TEST(Fills, OfTheTeapot) {
  const auto loaded =
      load_scene(std::filesystem::path(LEKALO_SOURCE_DIR) / "tools/benchmarks/scenes/teapot_lines.yaml");
  const SurfaceSet teapot = std::get<SurfaceSet>(loaded.model->objects.front().shape);
  Views views(83);
  Judged found;
  for (int k = 0; k < tests::tier_count(100, tests::min_of_slow(2)); ++k) {
    SmallScene scene;
    show(scene, teapot, {"silhouette"});
    views.look(scene, k % 2);
    judge(scene, views, found, Fill::Shading::flat);
  }
  expect_right(found, "teapot");
}

// Boxes that stand on one another: their edges lie on one another in the picture.
TEST(Fills, OfBoxesInPlainViews) {
  Views views(89);
  Judged found;
  const Vec3 kWays[] = {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}, {1, 1, 1}, {1, 1, 0}};
  for (const Vec3& way : kWays) {
    SmallScene scene;
    for (int i = 0; i < 3; ++i)
      show(scene,
           std::make_shared<Body>(
               box(frame_from({0.5 * i, 0, 1.0 * i}, {0, 0, 1}, {1, 0, 0}), {1.0, 1.0 + (i == 1), 1.0})),
           {"sharp"});
    scene.model.film.width = 600, scene.model.film.height = 500;
    scene.model.camera = make_camera(
        ParallelView{
            Vec3(1, 1, 1) + 10.0 * way, {1, 1, 1}, way.z == 1 && way.x == 0 ? Vec3(0, 1, 0) : Vec3(0, 0, 1), 6},
        600, 500);
    judge(scene, views, found, Fill::Shading::flat);
  }
  expect_right(found, "boxes");
}

// The lines are as long as the area is large: length times spacing, to a spacing of its border.
TEST(Fills, Hatching) {
  SmallScene scene;
  show(scene, std::make_shared<Body>(ball(Frame(), 1)), {"silhouette"});
  scene.model.film.width = scene.model.film.height = 500;
  scene.model.camera = make_camera(ParallelView{{0, 0, 10}, {0, 0, 0}, {0, 1, 0}, 4}, 500, 500);
  scene.model.drawing.ground = Ground::fill;
  scene.model.drawing.fill.shading = Fill::Shading::none;
  scene.model.drawing.fill.hatching = Hatching{0.3, 0.2, false, false, Style()};
  const Figure figure = figure_of(std::make_shared<const Model>(scene.world()->model()), {});
  double length = 0;
  int lines = 0;
  const Vec2 along(std::cos(0.3), -std::sin(0.3));
  const auto visit = [&](const auto& self, const std::vector<SheetItem>& items) -> void {
    for (const SheetItem& item : items)
      if (const auto* group = std::get_if<SheetGroup>(&item)) {
        if (group->kind != "hatching") {
          self(self, group->items);
          continue;
        }
        for (const SheetItem& line : group->items) {
          const Path& path = std::get<SheetPath>(line).parts.front();
          const Vec2 chord = path.steps.front().to - path.from;
          EXPECT_NEAR(glm::dot(chord, along), glm::length(chord), 1e-9);
          length += glm::length(chord), ++lines;
        }
      }
  };
  visit(visit, figure.sheet.items);
  const double radius = figure.sheet.width / 4;  // millimetres
  EXPECT_NEAR(lines, 2 * radius / 0.2, 1);
  EXPECT_NEAR(length * 0.2, kPi * radius * radius, 1e-3 * kPi * radius * radius);
}

}  // namespace
}  // namespace lekalo::render::fills_test
