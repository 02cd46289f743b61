// What scene files mean: every expected value follows from the scene's own text by elementary geometry.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "render/scene/build/load.h"
#include "render/scene/scene_text.h"

namespace lekalo::render::builder_test {
namespace {

using geometry::Curve;
using geometry::CurvePtr;
using geometry::kPi;
using geometry::Surface;
using geometry::SurfacePtr;

// Builds a text without errors.
BuiltText built(const std::string& text) {
  BuiltText result = build_text(text);
  EXPECT_EQ(result.said, "") << text;
  return result;
}

Model model(const std::string& text) { return built(text).model; }

const Curve& curve(const Model& model, const std::string& name) { return *std::get<CurvePtr>(model.geometry.at(name)); }
const Surface& surface(const Model& model, const std::string& name) {
  return *std::get<SurfacePtr>(model.geometry.at(name));
}
Vec3 point(const Model& model, const std::string& name) { return std::get<Vec3>(model.geometry.at(name)); }

void expect_near(const Vec3& found, const Vec3& expected, double tolerance = 1e-15) {
  EXPECT_LE(glm::length(found - expected), tolerance) << found.x << " " << found.y << " " << found.z << " is not "
                                                      << expected.x << " " << expected.y << " " << expected.z;
}

TEST(Builder, TheSmallestSceneTakesAllDefaults) {
  const BuiltText scene =
      built("geometry:\n  tube: { type: torus_surface, major_radius: 2, minor_radius: 0.7 }\nlights: {}\n");
  const Model& m = scene.model;
  ASSERT_EQ(m.objects.size(), 1u);
  EXPECT_EQ(m.objects[0].name, "tube");
  EXPECT_NE(m.objects[0].material, nullptr);
  EXPECT_NE(m.camera, nullptr);
  EXPECT_NE(m.integrator, nullptr);
  EXPECT_EQ(m.film.width, 960);
  EXPECT_EQ(m.film.height, 720);
  EXPECT_EQ(m.film.samples, 16);
  EXPECT_TRUE(m.lights.empty());
  EXPECT_TRUE(m.outputs.empty());
  EXPECT_EQ(scene.defaults,
            (std::vector<std::string>{"every entity is shown in a neutral material", "three-quarter view"}));
}

TEST(Builder, AFlatSceneIsSeenFromAbove) {
  const BuiltText scene = built("geometry: { c: { type: circle, radius: 1 } }\nlights: {}\n");
  EXPECT_EQ(scene.defaults.back(), "plan view");
  // Interaction from above, the middle of the picture is the middle of the circle and up is y.
  const PicturePoint middle = scene.model.camera->project({0, 0, 0}), top = scene.model.camera->project({0, 1, 0});
  EXPECT_NEAR(middle.x, top.x, 1e-9);
  EXPECT_LT(top.y, middle.y);
}

TEST(Builder, WithoutLightsTheShippedStudioIsTaken) {
  const auto folder = std::filesystem::temp_directory_path() / "lekalo_builder_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "smallest.yaml")
      << "lekalo: 1\ngeometry:\n  tube: { type: torus_surface, major_radius: 2, minor_radius: 0.7 }\n";
  const LoadedScene scene = load_scene(folder / "smallest.yaml");
  EXPECT_EQ(scene.model->lights.size(), 4u);
  EXPECT_EQ(scene.defaults_taken.size(), 3u);
  std::filesystem::remove_all(folder);
}

TEST(Builder, TheNurbsSurfaceOfTheGuide) {
  const Model m = model(R"(
parameters: { w: 4 }
geometry:
  patch:
    type: nurbs_surface
    degree: 3
    knots: clamped
    points:
      - [[0, 0, 0.0], [0, 1, 0.6], [0, 2, 0.6], [0, 3, 0.0]]
      - [[1, 0, 0.5], [1, 1, 1.4], [1, 2, 1.4], [1, 3, 0.5]]
      - [[2, 0, 0.3], [2, 1, 1.2], [2, 2, 2.4], [2, 3, 0.3]]
      - [[3, 0, 0.5], [3, 1, 1.0], [3, 2, 1.0], [3, 3, 0.5]]
      - [[4, 0, 0.0], [4, 1, 0.3], [4, 2, 0.3], [4, 3, 0.0]]
    weights: [[1, 1, 1, 1], [1, 1, 1, 1], [1, 1, w, 1], [1, 1, 1, 1], [1, 1, 1, 1]]
styles: { net: { like: construction, width: 0.35 pt, color: firebrick } }
objects:
  - shape: patch
    lines: { boundary: thick, parameter: { at_u: 9, at_v: 7, style: thin }, hidden: drop }
    show: { control_net: { style: net } }
camera: { type: perspective, from: [8.5, -6, 6], at: [2, 1.5, 0.6], field_of_view: 28 }
drawing: { ground: shaded }
image: { size: [120 mm, auto], dpi: 400 }
lights: {}
)");
  const Surface& patch = surface(m, "patch");
  // Clamped: the corners are control points, points[i][j] with i along u. Five points of degree 3: u in 0..2.
  EXPECT_EQ(patch.domain().u.hi, 2);
  EXPECT_EQ(patch.domain().v.hi, 1);
  expect_near(patch.point(0, 0), {0, 0, 0});
  expect_near(patch.point(2, 0), {4, 0, 0});
  expect_near(patch.point(0, 1), {0, 3, 0});
  EXPECT_EQ(m.film.width, 1890);  // 120 mm / 25.4 mm * 400
}

TEST(Builder, ParametersMayStandInAnyOrder) {
  const Model m = model("parameters: { a: 2*b, b: c + 1, c: 3, right: 90 deg }\ngeometry: { p: [a, b, sin(right)] }\n");
  expect_near(point(m, "p"), {8, 4, 1});
  EXPECT_EQ(m.parameters.at("a"), 8);
}

TEST(Builder, AngleFieldsTakeDegrees) {
  const Model m = model(
      "parameters: { q: 45 }\ngeometry:\n  a: { type: circle, radius: 2, arc: [0, 2*q] }\n"
      "  b: { type: circle, radius: 2, arc: [0 deg, (pi/2) rad] }\n");
  EXPECT_DOUBLE_EQ(curve(m, "a").domain().hi, kPi / 2);
  EXPECT_DOUBLE_EQ(curve(m, "b").domain().hi, kPi / 2);
}

TEST(Builder, TransformStepsHappenInTheOrderWritten) {
  const Model m = model(R"(
geometry:
  moved_then_turned: { type: segment, from: [1, 0], to: [2, 0], transform: [{ translate: [0, 1, 0] }, { rotate: 90, axis: z }] }
  turned_then_moved: { type: segment, from: [1, 0], to: [2, 0], transform: [{ rotate: 90, axis: z }, { translate: [0, 1, 0] }] }
  about_a_point:     { type: segment, from: [1, 0], to: [2, 0], transform: { rotate: 90, axis: z, about: [1, 0] } }
  about_an_axis:     { type: segment, from: [1, 0], to: [2, 0], transform: { rotate: 90, axis: { through: [2, 0], along: -z } } }
  mirrored:          { type: segment, from: [1, 0], to: [2, 0], transform: { mirror: x, about: [3, 0] } }
  scaled:            { type: segment, from: [1, 1], to: [2, 1], transform: { scale: [2, 3, 4] } }
  by_matrix:         { type: segment, from: [1, 1], to: [2, 1], transform: { matrix: [[0, -1, 0, 5], [1, 0, 0, 6], [0, 0, 1, 7]] } }
)");
  const auto start = [&](const std::string& name) { return curve(m, name).point(curve(m, name).domain().lo); };
  expect_near(start("moved_then_turned"), {-1, 1, 0});
  expect_near(start("turned_then_moved"), {0, 2, 0});
  expect_near(start("about_a_point"), {1, 0, 0});
  expect_near(start("about_an_axis"), {2, 1, 0});
  expect_near(start("mirrored"), {5, 0, 0});
  expect_near(start("scaled"), {2, 3, 0});
  expect_near(start("by_matrix"), {4, 7, 7});
}

TEST(Builder, RepeatsMakeFamilies) {
  const BuiltText scene = built(R"(
geometry:
  row:  { repeat: { i: 0..2 }, type: ball, center: [i, 0, 0], radius: 0.2 }
  net:  { repeat: { i: 1..2, k: [0.5, 1.5, 2*i] }, type: segment, from: [i, k], to: [0, 0, i] }
  path: { type: polyline, points: [[0, 0], { repeat: { a: 1..3 }, point: [a, a^2] }, [9, 9]] }
objects:
  - { shape: row }
  - { shape: net.1 }
  - { repeat: { i: 0..1 }, shape: path, transform: { translate: [0, 0, i] } }
lights: {}
)");
  const Model& m = scene.model;
  EXPECT_EQ(m.geometry.count("row.0"), 1u);
  EXPECT_EQ(m.geometry.count("row.2"), 1u);
  EXPECT_EQ(m.geometry.count("row.3"), 0u);
  expect_near(curve(m, "net.0.1").point(0), {1, 1.5, 0});
  expect_near(curve(m, "net.1.2").point(0), {2, 4, 0});
  const Curve& path = curve(m, "path");
  expect_near(path.point(3), {3, 9, 0});
  expect_near(path.point(path.domain().hi), {9, 9, 0});
  // A family stands for its members; net.1 for the three of the second row.
  ASSERT_EQ(m.objects.size(), 3u + 3u + 2u);
  expect_near(m.objects[7].transform.point({0, 0, 0}), {0, 0, 1});
}

TEST(Builder, AnEmptyRepeatIsAnEmptyFamily) {
  const Model m = model(
      "parameters: { n: 0 }\ngeometry: { f: { repeat: { i: 0..n-1 }, type: ball, radius: 1 } }\n"
      "objects: [{ shape: f }]\nlights: {}\n");
  EXPECT_TRUE(m.geometry.empty());
  EXPECT_TRUE(m.objects.empty());
}

TEST(Builder, LikeCopiesAndOverrides) {
  const Model m = model(R"(
geometry:
  c: { like: b, to: [0, 0, 9] }
  b: { like: a, from: [5, 5] }
  a: { type: segment, from: [1, 0], to: [2, 0] }
)");
  expect_near(curve(m, "c").point(0), {5, 5, 0});
  expect_near(curve(m, "c").point(1), {0, 0, 9});
  expect_near(curve(m, "b").point(1), {2, 0, 0});
}

TEST(Builder, ShortFormsOfFrames) {
  const Model m = model(R"(
geometry:
  plain:  { type: circle, radius: 1 }
  placed: { type: circle, radius: 1, center: [1, 2, 3], normal: y }
  along:  { type: circle, radius: 1, normal: x }
  full:   { type: circle, radius: 1, frame: { origin: [0, 0, 5], z: z, x: [1, 1, 0] } }
  axis:   { type: cylinder_surface, radius: 2, height: 3, axis: { through: [1, 0, 0], along: x } }
)");
  expect_near(curve(m, "plain").point(0), {1, 0, 0});
  // x of the frame is the global x projected, the global y where x is the normal itself.
  expect_near(curve(m, "placed").point(0), {2, 2, 3});
  expect_near(curve(m, "placed").point(kPi / 2), {1, 2, 2});
  expect_near(curve(m, "along").point(0), {0, 1, 0});
  expect_near(curve(m, "full").point(0), {std::sqrt(0.5), std::sqrt(0.5), 5});
  expect_near(surface(m, "axis").point(0, 0), {1, 2, 0});
}

TEST(Builder, PlacesOnCurvesAndSurfaces) {
  const Model m = model(R"(
geometry:
  p: [3, 4]
  l: { type: segment, from: p, to: [5, 4, 2] }
  s: { type: sphere_surface, radius: 2 }
  a: { type: segment, from: { of: l, t: 0.5 }, to: { of: s, u: 90 deg, v: 0 } }
  b: { type: circle, radius: 1, center: { of: l, t: 1 }, normal: { of: l, t: 0, vector: tangent } }
  c: { type: segment, from: { of: { type: segment, from: [0, 0], to: [8, 0] }, t: 0.25 }, to: p }
)");
  expect_near(curve(m, "a").point(0), {4, 4, 1});
  expect_near(curve(m, "a").point(1), {0, 2, 0}, 4e-16);
  expect_near(curve(m, "c").point(0), {2, 0, 0});
  // The circle's plane stands across the segment's direction (1, 0, 1).
  for (const double t : {0.0, 1.0, 2.0})
    EXPECT_NEAR(glm::dot(curve(m, "b").point(t) - Vec3(5, 4, 2), Vec3(1, 0, 1)), 0, 1e-15);
}

TEST(Builder, ReversedSurfacesAndTheirParts) {
  const Model m = model(R"(
geometry:
  out: { type: sphere_surface, radius: 1 }
  in:  { type: sphere_surface, radius: 1, reversed: true }
  low: { type: sphere_surface, radius: 1, reversed: true, transform: { mirror: z } }
)");
  expect_near(surface(m, "out").normal(0, 0), {1, 0, 0});
  expect_near(surface(m, "in").normal(0, 0), {-1, 0, 0});
  expect_near(surface(m, "in").point(0, 0), {1, 0, 0});
}

// sRGB's transfer function: IEC 61966-2-1.
TEST(Builder, ColorsByNameHexAndNumber) {
  const auto background = [](const std::string& color) {
    return model("image: { background: " + color + " }\nlights: {}\n").background;
  };
  const auto expect_color = [&](const std::string& color, double r, double g, double b) {
    const Spectrum c = background(color);
    EXPECT_NEAR(c[0], r, 1e-6) << color;
    EXPECT_NEAR(c[1], g, 1e-6) << color;
    EXPECT_NEAR(c[2], b, 1e-6) << color;
  };
  const auto linear = [](double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); };
  expect_color("white", 1, 1, 1);
  expect_color("steelblue", linear(70 / 255.0), linear(130 / 255.0), linear(180 / 255.0));
  expect_color("'#abc'", linear(170 / 255.0), linear(187 / 255.0), linear(204 / 255.0));
  expect_color("[0.25, 0.5, 2]", 0.25, 0.5, 2);
  expect_color("0.5", 0.5, 0.5, 0.5);
  expect_color("{ srgb: [0.5, 0, 1] }", linear(0.5), 0, 1);
}

TEST(Builder, OutputsAndTheirKinds) {
  const Model m = model(
      "outputs: [a.exr, { file: b.png, exposure: 0.5, tone: filmic }, c.svg, { file: d.png, kind: drawing }]\n"
      "lights: {}\n");
  ASSERT_EQ(m.outputs.size(), 4u);
  EXPECT_EQ(m.outputs[0].kind, "render");
  EXPECT_EQ(m.outputs[1].display.exposure, 0.5);
  EXPECT_EQ(m.outputs[1].display.curve, ToneCurve::filmic);
  EXPECT_EQ(m.outputs[2].kind, "drawing");
  EXPECT_EQ(m.outputs[3].kind, "drawing");
}

}  // namespace
}  // namespace lekalo::render::builder_test
