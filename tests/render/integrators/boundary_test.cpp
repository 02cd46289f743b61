// Substances that touch, and eyes inside of them, against Snell's and Fresnel's laws worked out here for flat layers.
#include "render/integrators/boundary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/shapes/csg/body_shape.h"
#include "geometry/shapes/csg/csg.h"
#include "render/small_scene.h"

namespace lekalo::render::boundary_test {
namespace {

using namespace geometry;

constexpr double kFloat = 3e-6;

struct Layer {
  double index, thickness;
  int priority = 0;
};

MaterialPtr clear(double index, int priority = 0, double absorption = 0) {
  return make_material(Dielectric{.index = index, .absorption = Vec3(absorption), .priority = priority});
}
MaterialPtr bent(double index, int priority = 0) {  // without reflection
  ClassicLook look;
  look.ambient = look.diffuse = 0.0;
  look.transmission = 1.0;
  look.index = index;
  look.priority = priority;
  return make_material(look);
}

BodyPtr block(double z0, double z1) {
  Frame frame;
  frame.origin = {-50, -50, z0};
  return std::make_shared<Body>(box(frame, {100, 100, z1 - z0}));
}

// Share of unpolarised light that a boundary throws back (Fresnel), by the sines of both sides.
double thrown_back(double n0, double n1, double invariant) {
  const double s0 = invariant / n0, s1 = invariant / n1, c0 = std::sqrt(1 - s0 * s0);
  if (s1 >= 1) return 1;
  const double c1 = std::sqrt(1 - s1 * s1);
  const double s = (n0 * c0 - n1 * c1) / (n0 * c0 + n1 * c1), p = (n1 * c0 - n0 * c1) / (n1 * c0 + n0 * c1);
  return 0.5 * (s * s + p * p);
}

// What a stack of layers, the first on top, above a black ground throws back of a white sky: all reflections to and fro
// add up to r + (1 - r)^2 R / (1 - r R), R that of what lies below.
double thrown_back_by(const std::vector<Layer>& layers, double sine) {
  double below = 0, index_below = 1;
  for (size_t i = layers.size(); i-- > 0;) {
    const double r = thrown_back(layers[i].index, index_below, sine);
    below = r + (1 - r) * (1 - r) * below / (1 - r * below);
    index_below = layers[i].index;
  }
  const double r = thrown_back(1, layers.front().index, sine);
  return r + (1 - r) * (1 - r) * below / (1 - r * below);
}

MaterialPtr black() { return make_material(ClassicLook{.ambient = 0.0, .diffuse = 0.0}); }

// Layers that lie on one another, whichever object comes first, as blocks and as meshes of them.
TEST(Boundary, LayersThrowBackWhatFresnelSays) {
  const std::vector<std::vector<Layer>> stacks = {{{1.6, 1}, {2.5, 1, 1}},
                                                  {{1.6, 1, 1}, {2.5, 1}},
                                                  {{1.5, 0.3}, {1.33, 0.7, 2}, {2, 0.1, 1}},
                                                  {{1.5, 1}, {1.5, 1}},
                                                  {{1.3, 0.1}, {1.8, 0.1}, {1.8, 0.1}, {1.2, 0.1}}};
  for (const auto& stack : stacks)
    for (const bool turned : {false, true})
      for (const Representation form : {Representation::direct, Representation::mesh})
        for (const double sine : {0.0, 0.4, 0.9}) {
          SmallScene scene;
          scene.model.background = Spectrum(1, 1, 1);
          scene.options.weight_cutoff = 1e-9;
          scene.options.max_depth = 22;
          double z = 0.7;  // no place of double arithmetic
          for (const Layer& layer : stack) {
            scene.add(block(z - layer.thickness, z), clear(layer.index, layer.priority));
            scene.model.objects.back().representation = form;
            z -= layer.thickness;
          }
          if (turned) std::reverse(scene.model.objects.begin(), scene.model.objects.end());
          scene.add(plane({0, 0, z - 1}, {0, 0, 1}), black());
          const Vec3 down(sine, 0, -std::sqrt(1 - sine * sine));
          const double light = trace(*scene.world(), Vec3(0.31, 0.17, 0.7) - 2.0 * down, down).radiance[0];
          EXPECT_NEAR(light, thrown_back_by(stack, sine), 1e-5)
              << stack.size() << " " << turned << " " << (form == Representation::mesh) << " " << sine;
        }
}

// A block that lies on a table: the table is seen through it, at the place that Snell's law says, listed first or last.
TEST(Boundary, ATableIsSeenThroughTheBlockOnIt) {
  for (const bool table_first : {false, true})
    for (const double z : {0.0, 0.3}) {
      SmallScene scene;
      const auto add_table = [&] { scene.add(plane({0, 0, z}, {0, 0, 1}), coordinate_screen({1, 0, 0})); };
      if (table_first) add_table();
      scene.add(block(z, z + 1), bent(1.5));
      if (!table_first) add_table();
      const double sine = std::sqrt(0.5), inner = sine / 1.5;
      const double x = 0.2 + inner / std::sqrt(1 - inner * inner);
      EXPECT_NEAR(trace(*scene.world(), {0.2 - 3, 0, z + 4}, {1, 0, -1}).radiance[0], x, kFloat) << table_first << z;
    }
}

// The eye inside of one layer or of one in another; the sines times the indices stay the same from layer to layer.
TEST(Boundary, EyesInsideOfSubstancesKnowThem) {
  const double invariant = 0.9, up_in_glass = std::sqrt(1.5 * 1.5 - invariant * invariant);
  const auto run = [&](double index) { return invariant / std::sqrt(index * index - invariant * invariant); };
  for (const bool turned : {false, true}) {
    SmallScene scene;
    scene.add(block(0, 1), bent(1.5));
    scene.add(block(-1, 2), bent(1.33));
    if (turned) std::swap(scene.model.objects[0], scene.model.objects[1]);
    scene.add(plane({0, 0, 5}, {0, 0, -1}), coordinate_screen({1, 0, 0}));
    const double x = 0.5 * run(1.5) + run(1.33) + 3 * run(1);
    EXPECT_NEAR(trace(*scene.world(), {0, 0, 0.5}, {invariant, 0, up_in_glass}).radiance[0], x, kFloat) << turned;
  }
  // Under water, before a block of glass.
  SmallScene scene;
  scene.add(block(-3, 3), bent(1.33));
  scene.add(block(0, 1), bent(1.5, 1));
  scene.add(plane({0, 0, -2}, {0, 0, 1}), coordinate_screen({1, 0, 0}));
  const double down = std::sqrt(1.33 * 1.33 - invariant * invariant);
  EXPECT_NEAR(trace(*scene.world(), {0, 0, 2}, {invariant, 0, -down}).radiance[0], run(1.33) + run(1.5) + 2 * run(1.33),
              kFloat);
}

// A drink up to the wall of a bowl that is a CSG solid: the same as one that reaches into the glass, where the wall is
// no place at which two surfaces meet. Rays in all directions, with reflections and absorption.
TEST(Boundary, DrinksFillTheirBowls) {
  const auto ball = [](double radius) {
    return std::make_shared<BodyShape>(std::make_shared<Body>(geometry::ball(Frame{{0.1, 0.2, 0.3}}, radius)));
  };
  const ShapePtr bowl = std::make_shared<Csg>(Csg::Operation::subtract, std::vector<ShapePtr>{ball(1), ball(0.8)});
  const auto scene_with = [&](double radius, bool drink_first) {
    SmallScene scene;
    scene.options.weight_cutoff = 1e-4;
    scene.options.max_depth = 8;
    scene.add(ball(radius), clear(1.33, 0, 0.5)).add(bowl, clear(1.5, 1, 0.1));
    if (!drink_first) std::swap(scene.model.objects[0], scene.model.objects[1]);
    scene.add(plane({0, 0, -2}, {0, 0, 1}), coordinate_screen({0.1, 0.2, 0}));
    scene.light(PointLight{.position = {3, 2, 5}});
    return scene.world();
  };
  const auto truth = scene_with(0.9, true);
  for (const bool drink_first : {false, true}) {
    const auto world = scene_with(0.8, drink_first);
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> even(-1, 1);
    int other = 0;
    for (int i = 0; i < 4000; ++i) {
      const Vec3 from =
          Vec3(0.1, 0.2, 0.3) + 3.0 * glm::normalize(Vec3(normal(random), normal(random), normal(random)));
      const Vec3 to = Vec3(0.1, 0.2, 0.3) + 0.7 * Vec3(even(random), even(random), even(random));
      const float a = trace(*truth, from, to - from).radiance[0], b = trace(*world, from, to - from).radiance[0];
      other += !(std::abs(a - b) <= 1e-5 * std::max(1.0f, std::abs(a)));
    }
    EXPECT_EQ(other, 0) << drink_first;
  }
}

// Shadows through layers that touch are tinted by all of them.
TEST(Boundary, ShadowsAreTintedByBothOfTwoThatTouch) {
  for (const bool turned : {false, true}) {
    SmallScene scene;
    const auto tinted = [](double absorption, int priority) {
      ClassicLook look;
      look.ambient = look.diffuse = 0.0;
      look.transmission = 1.0;
      look.absorption = Vec3(absorption);
      look.priority = priority;
      return make_material(look);
    };
    scene.add(block(1, 2), tinted(0.7, 0)).add(block(2, 2.5), tinted(0.4, 1));
    if (turned) std::swap(scene.model.objects[0], scene.model.objects[1]);
    ClassicLook matt;
    matt.ambient = 0.0;
    matt.diffuse = 1.0;
    scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(matt));
    scene.light(DistantLight{.direction = {0, 0, -1}});
    const double light = trace(*scene.world(), {0, 0, 0.5}, {0, 0, -1}).radiance[0];
    EXPECT_NEAR(light, std::exp(-0.7 - 0.2), kFloat) << turned;
  }
}

// Rays that only touch a silhouette edge of a body are in it nowhere, from wherever they come: they see the white sky
// behind it, and light goes past it. The two faces of the edge are met at the same place, in the order that rounding
// says.
TEST(Boundary, EdgesThatAreOnlyTouchedAreNoWayIn) {
  ClassicLook matt, grey;
  matt.ambient = grey.ambient = grey.diffuse = 0.0;
  matt.diffuse = grey.transmission = 1.0;
  grey.absorption = Vec3(0.5);
  for (const int sides : {6, 8, 12}) {
    std::vector<Vec2> corners;
    for (int i = 0; i < sides; ++i) corners.push_back({std::cos(2 * kPi * i / sides), std::sin(2 * kPi * i / sides)});
    SmallScene scene;
    scene.model.background = Spectrum(1, 1, 1);
    scene.add(std::make_shared<Body>(prism(Frame{{0, 0, -1}}, corners, 2)), make_material(grey));
    const auto world = scene.world();
    scene.add(plane({0, 90, 0}, {0, -1, 0}), make_material(matt));
    scene.light(DistantLight{.direction = {0, 1, 0}});
    const auto lit = scene.world();
    // Along the tangents of the circle through all edges.
    for (int i = 0; i < sides; ++i)
      for (const double way : {1.0, 5.0, 500.0})
        for (const double z : {-0.3, 0.0, 0.7}) {
          const Vec3 tangent(-corners[i].y, corners[i].x, 0), edge(corners[i], z);
          EXPECT_NEAR(trace(*world, edge - way * tangent, tangent).radiance[0], 1, kFloat)
              << sides << " " << i << " " << way << " " << z;
        }
    for (const double x : {-1.0, 1.0})
      EXPECT_NEAR(trace(*lit, {x, 89, 0.2}, {0, 1, 0}).radiance[0], 1, kFloat) << sides << " " << x;
  }
}

}  // namespace
}  // namespace lekalo::render::boundary_test
