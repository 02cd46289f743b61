// Groups in groups that place more copies than anyone could visit: what does not have to be drawn for each of them
// takes no time. Every expected value follows from the scene's own text.
#include <gtest/gtest.h>

#include <cmath>

#include "render/film/render.h"
#include "render/lines/strokes.h"
#include "render/model/placed_objects.h"
#include "render/scene/scene_text.h"
#include "render/trace/world.h"

namespace lekalo::render::placed_objects_test {
namespace {

// A ball of radius 0.25, and `beside` it, in `levels` groups in groups of ten: level k puts them 10^k apart along x.
Model nested(int levels, const std::string& beside = "", const std::string& rest = "") {
  std::string text =
      "lights: {}\nmaterials: { red: { type: emission, color: red }, glass: { type: dielectric } }\ngeometry:\n"
      "  ball: { type: ball, radius: 0.25 }\n"
      "  g0: { type: group, of: [{ shape: ball, material: red }" +
      beside + "] }\n";
  for (int k = 1; k <= levels; ++k)
    text += "  g" + std::to_string(k) + ": { type: group, of: { repeat: { i: 0..9 }, shape: g" + std::to_string(k - 1) +
            ", transform: { translate: [" + std::to_string(std::llround(std::pow(10, k - 1))) + "*i, 0, 0] } } }\n";
  BuiltText built = build_text(text + "objects: [{ shape: g" + std::to_string(levels) +
                               " }]\nimage: { size: [32, 16], samples: 1 }\n" + rest);
  EXPECT_EQ(built.said, "");
  return std::move(built.model);
}

bool is_curve(const Object& object) { return std::holds_alternative<geometry::CurvePtr>(object.shape); }

const std::string kCurve = ", { shape: { type: polyline, points: [[0, 0, 0], [0.1, 0, 0]] } }";

const std::string kCamera = "camera: { type: parallel, from: [0, -5, 0], at: [0, 0, 0], height: 4 }\n";

TEST(PlacedObjects, AreCountedAndVisitedInTheirOrder) {
  const Model model = nested(2, kCurve);
  EXPECT_EQ(PlacedObjects(model.objects).count(), 200);
  const PlacedObjects curves(model.objects, is_curve);
  EXPECT_EQ(curves.count(), 100);
  int visited = 0;
  curves.visit([&](const Object& object, const geometry::Affine& to_world, int placement) {
    EXPECT_TRUE(is_curve(object));
    EXPECT_EQ(placement, visited);
    EXPECT_EQ(to_world.point(Vec3(0)), Vec3(visited, 0, 0));
    ++visited;
  });
  EXPECT_EQ(visited, 100);
}

TEST(PlacedObjects, AreVisitedUntilStopped) {
  const Model model = nested(16, kCurve);
  EXPECT_EQ(PlacedObjects(model.objects).count(), 2e16);
  std::atomic<bool> stop = false;
  int visited = 0;
  PlacedObjects(model.objects, is_curve)
      .visit([&](const Object&, const geometry::Affine&, int) { stop = ++visited == 1000; }, &stop);
  EXPECT_EQ(visited, 1000);
}

TEST(PlacedObjects, OfOneGroupAreOneObject) {
  const Model model = nested(16, kCurve);
  int objects = 0;
  each_object(model.objects, [&](const Object&) { ++objects; });
  EXPECT_EQ(objects, 1 + 16 * 10 + 2);
}

TEST(DeepGroups, MakeAPictureAtOnce) {
  for (const std::string beside : {"", ", { shape: ball, material: glass, transform: { translate: [0, 0.4, 0] } }",
                                   ", { shape: ball, lines: { silhouette: thin }, material: red }"}) {
    const auto model = std::make_shared<const Model>(nested(16, beside, kCamera));
    EXPECT_EQ(left_to_drawings(model->objects).size(), beside.find("lines") != beside.npos ? 1u : 0u);
    const World world(model);
    const RenderResult result = render(world, {.threads = 1});
    EXPECT_TRUE(result.complete);
    EXPECT_EQ(result.camera_rays, 32u * 16);
  }
}

// Copies have numbers beyond 32 bits, and all of them are found.
TEST(DeepGroups, KeepTheirCopiesApart) {
  const World world(std::make_shared<const Model>(nested(11)));
  std::vector<int64_t> instances;
  for (const double x : {0.0, 7.0, 4294967296.0, 4294967303.0, 12345678901.0, 99999999999.0}) {
    const Ray ray{{Vec3(x, 0, 5), Vec3(0, 0, -1)}};
    Hit hit;
    ASSERT_TRUE(world.nearest(ray, hit)) << x;
    EXPECT_EQ(hit.instance, std::llround(x));
    EXPECT_NEAR(hit.t, 4.75, 1e-4);
    const SurfacePoint point = world.surface_point(ray, hit);
    EXPECT_NEAR(point.position.x, x, 1e-4);
    EXPECT_EQ(world.object(point).name, "ball");
    EXPECT_EQ(world.all_hits(ray).size(), 2u);
  }
}

TEST(DeepGroups, OfMoreCopiesThanCanBeNumberedAreRefused) {
  EXPECT_THROW(World(std::make_shared<const Model>(nested(19, "", kCamera))), std::invalid_argument);
}

TEST(DeepGroups, AreFramedAtOnce) {
  const std::string camera = "camera: { type: parallel, view: top, margin: 0, frame: ball }\n";
  const Model model = nested(16, kCurve, camera),
              wide = nested(16, "", "camera: { type: parallel, view: top, margin: 0 }\n");
  for (const Model* one : {&model, &wide}) {
    EXPECT_NEAR(one->camera->project({-0.25, 0, 0}).x, 0, 1e-6);
    EXPECT_NEAR(one->camera->project({1e16 - 0.75, 0, 0}).x, 32, 1e-6);
  }
}

}  // namespace
}  // namespace lekalo::render::placed_objects_test
