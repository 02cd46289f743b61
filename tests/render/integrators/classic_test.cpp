// The classic integrator on scenes with known light: numbers of Golovanov 2016, 8.4 and 8.5, worked out in double
// precision; radiances are floats, so agreement is asked to a few parts in a million.
#include "render/integrators/classic.h"

#include <gtest/gtest.h>

#include "render/materials/optical_constants.h"
#include "render/small_scene.h"
#include "render/spectra/illuminants.h"
#include "render/spectra/observer.h"

namespace lekalo::render::classic_test {
namespace {

using geometry::kPi;

constexpr double kDegree = kPi / 180;
constexpr double kFloat = 2e-6;

Vec3 in_xz(double degrees_from_z) {
  return {std::sin(degrees_from_z * kDegree), 0, std::cos(degrees_from_z * kDegree)};
}

MaterialPtr glossy(double exponent) {
  ClassicLook look;
  look.ambient = 0.2;
  look.diffuse = 0.6;
  look.specular = 0.3;
  look.exponent = exponent;
  return make_material(look);
}

MaterialPtr clear_glass(double index, double absorption = 0) {
  ClassicLook look;
  look.ambient = 0.0;
  look.diffuse = 0.0;
  look.transmission = 1.0;
  look.index = index;
  look.absorption = Vec3(absorption);
  return make_material(look);
}

TEST(ClassicIntegrator, LocalLightAtSixtyDegrees) {
  // theta = 60, alpha = 20 degrees: the viewer stands 20 degrees below the mirror direction.
  SmallScene scene;
  scene.add(plane({0, 0, 0}, {0, 0, 1}), glossy(20));
  scene.light(DistantLight{.direction = -in_xz(-60)}).light(AmbientLight{});
  const Vec3 eye = 15.0 * in_xz(40);
  EXPECT_NEAR(trace(*scene.world(), eye, -eye).radiance[0], 0.5864644500601672, kFloat);
  scene.options.depth_attenuation = 0.1;
  scene.options.reference_depth = 10;
  EXPECT_NEAR(trace(*scene.world(), eye, -eye).radiance[0], 0.5197977833935005, kFloat);
  scene.options.attenuate_lights = true;
  EXPECT_NEAR(trace(*scene.world(), eye, -eye).radiance[0], 0.5864644500601672 / 1.5, kFloat);
}

TEST(ClassicIntegrator, LampBehindShinesThrough) {
  // Golovanov 2016, (8.4.4): I_t = 0.5, k_t = 0.4, n = 20, beta = 10 degrees.
  SmallScene scene;
  ClassicLook look;
  look.diffuse = look.ambient = 0.0;
  look.transmission = 0.4;
  look.transmission_exponent = 20;
  scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(look));
  scene.light(DistantLight{.direction = in_xz(50), .lamp = {.intensity = 0.5}});
  const Vec3 eye = 15.0 * in_xz(40);
  EXPECT_NEAR(trace(*scene.world(), eye, -eye).radiance[0], 0.1472513126949291, kFloat);
  // Something between lamp and surface hides it.
  scene.add(plane({0, 0, -1}, {0, 0, 1}), make_material(Emission{.strength = 0}));
  EXPECT_EQ(trace(*scene.world(), eye, -eye).radiance[0], 0);
}

TEST(ClassicIntegrator, PointLightShowsItsIntensityOnWhiteMattSurfaces) {
  SmallScene scene;
  scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(Diffuse{.color = 1.0}));
  scene.light(PointLight{{0, 0, 2}, {.intensity = 0.75}});
  EXPECT_NEAR(trace(*scene.world(), {1, 0, 3}, {-1, 0, -3}).radiance[1], 0.75, kFloat);
  scene.model.lights = {make_light(PointLight{{0, 0, 2}, {.intensity = 0.75, .inverse_square = true}})};
  EXPECT_NEAR(trace(*scene.world(), {1, 0, 3}, {-1, 0, -3}).radiance[1], 0.75 / 4, kFloat);
}

TEST(ClassicIntegrator, SphereSeenFromInfinity) {
  const auto radiance = [](const Vec3& light, double x) {
    SmallScene scene;
    scene.add(sphere({0, 0, 0}, 1), glossy(10));
    scene.light(DistantLight{.direction = -light}).light(AmbientLight{});
    return trace(*scene.world(), {x, 0, 5}, {0, 0, -1}).radiance[0];
  };
  EXPECT_NEAR(radiance({0, 0, 1}, 0.6), 0.6800008885903, kFloat);
  EXPECT_NEAR(radiance({0.6, 0, 0.8}, 0), 0.71221225472, kFloat);
  EXPECT_NEAR(radiance({0.6, 0, 0.8}, 0.6), 0.83221225472, kFloat);
  EXPECT_NEAR(radiance({0.6, 0, 0.8}, 0.316227766016838), 1.06920997883083, kFloat);
}

TEST(ClassicIntegrator, LightsAdd) {
  SmallScene both, first, second, none;
  for (SmallScene* scene : {&both, &first, &second, &none})
    scene->add(sphere({0, 0, 0}, 1), glossy(7)).light(AmbientLight{.intensity = 0.5});
  const DistantLight a{.direction = glm::normalize(Vec3(-1, 0, -1))}, b{.direction = glm::normalize(Vec3(1, 2, -3))};
  both.light(a).light(b);
  first.light(a);
  second.light(b);
  const auto at = [](const SmallScene& scene) { return trace(*scene.world(), {0.3, 0.1, 5}, {0, 0, -1}).radiance[0]; };
  EXPECT_NEAR(at(both), at(first) + at(second) - at(none), kFloat);
}

TEST(ClassicIntegrator, ParallelMirrorsGiveAGeometricSeries) {
  ClassicLook mirror;
  mirror.ambient = 1.0;
  mirror.diffuse = 0.0;
  mirror.mirror = 0.5;
  SmallScene scene;
  scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(mirror));
  scene.add(plane({0, 0, 1}, {0, 0, -1}), make_material(mirror));
  scene.light(AmbientLight{});
  for (const int depth : {0, 1, 5, 12}) {
    scene.options.max_depth = depth;
    scene.options.weight_cutoff = 0;
    const RaySample sample = trace(*scene.world(), {0, 0, 0.5}, {1, 0, -2});
    EXPECT_NEAR(sample.radiance[0], 2 - std::pow(0.5, depth), kFloat) << depth;
    EXPECT_EQ(sample.other_rays, static_cast<uint32_t>(depth));
  }
}

TEST(ClassicIntegrator, SlabShiftsARayAndKeepsItsDirection) {
  SmallScene scene;
  scene.add(slab(0, 1), clear_glass(1.5));
  scene.add(plane({0, 0, -5}, {0, 0, 1}), coordinate_screen({1, 0, 0}));
  // Without the slab the ray from (-6, 0, 1 + 6) at 45 degrees meets z = -5 at x = 6.
  const double x = trace(*scene.world(), {-6, 0, 7}, {1, 0, -1}).radiance[0];
  EXPECT_NEAR((6 - x) / std::sqrt(2.0), 0.3291423081773203, kFloat);
}

TEST(ClassicIntegrator, BallLensCrossesTheAxisWhereOpticsSays) {
  struct Case {
    double height, crossing, path;
  };
  for (const Case& c :
       {Case{0.1, 1.4958270630560686, 1.9955506062794353}, Case{0.5, 1.3915729488893103, 1.8856180831641267},
        Case{0.8, 1.2002814469451297, 1.6918103387266024}}) {
    SmallScene scene;
    scene.add(sphere({0, 0, 0}, 1), clear_glass(1.5));
    scene.add(plane({c.crossing, 0, 0}, {-1, 0, 0}), coordinate_screen({0, 0, 1}));
    EXPECT_NEAR(trace(*scene.world(), {-5, 0, c.height}, {1, 0, 0}).radiance[0], 0, 1e-6) << c.height;

    SmallScene dark;
    dark.model.background = Spectrum(1.0f);
    dark.add(sphere({0, 0, 0}, 1), clear_glass(1.5, 0.8));
    EXPECT_NEAR(trace(*dark.world(), {-5, 0, c.height}, {1, 0, 0}).radiance[0], std::exp(-0.8 * c.path), kFloat);
  }
}

TEST(ClassicIntegrator, EqualIndicesLeaveTheBackgroundUnchanged) {
  SmallScene scene;
  scene.model.background = {0.25f, 0.5f, 0.75f};
  scene.add(sphere({0, 0, 0}, 1), clear_glass(1));
  const RaySample sample = trace(*scene.world(), {0.7, 0.2, 5}, {0, 0, -1});
  EXPECT_EQ(sample.radiance, scene.model.background);
  EXPECT_EQ(sample.alpha, 1);
}

TEST(ClassicIntegrator, FresnelSharesAddUpToAllLight) {
  // In a uniformly bright room a clear body without absorption is invisible, whatever its reflections.
  SmallScene scene;
  scene.model.background = Spectrum(1, 1, 1);
  scene.add(sphere({0, 0, 0}, 1), make_material(Dielectric{.glass = "SF10"}));
  scene.options.weight_cutoff = 0;
  scene.options.max_depth = 14;
  EXPECT_NEAR(trace(*scene.world(), {0.9, 0, 5}, {0, 0, -1}).radiance[0], 1, 1e-5);
}

TEST(ClassicIntegrator, TotalReflectionGoesToTheMirrorRay) {
  // Inside the slab at 45 degrees, beyond the critical angle of 41.8: the light of the bottom screen is seen by the way
  // of the top face.
  SmallScene scene;
  scene.add(slab(0, 1), clear_glass(1.5));
  scene.add(plane({0, 0, 0.25}, {0, 0, 1}), coordinate_screen({1, 0, 0}));
  EXPECT_NEAR(trace(*scene.world(), {0, 0, 0.5}, {1, 0, 1}).radiance[0], 1.25, kFloat);
}

TEST(ClassicIntegrator, BodiesOfLowerPriorityInsideAnotherAreNotSeen) {
  ClassicLook water, glass;
  for (ClassicLook* look : {&water, &glass}) {
    look->ambient = look->diffuse = 0.0;
    look->transmission = 1.0;
  }
  water.index = 1.33;
  glass.index = 1.5;
  glass.priority = 1;
  SmallScene with, without;
  for (SmallScene* scene : {&with, &without}) {
    scene->add(sphere({0, 0, 0}, 1), make_material(glass));
    scene->add(plane({3, 0, 0}, {-1, 0, 0}), coordinate_screen({0, 0, 1}));
  }
  with.add(sphere({0.1, 0, 0}, 0.8), make_material(water));
  const auto height = [](const SmallScene& scene) {
    return trace(*scene.world(), {-5, 0, 0.4}, {1, 0, 0}).radiance[0];
  };
  EXPECT_NEAR(height(with), height(without), kFloat);
  EXPECT_LT(height(without), -0.1);
}

TEST(ClassicIntegrator, ShadowOfABallHasTheRadiusOfItsCone) {
  SmallScene scene;
  scene.add(sphere({0, 0, 3}, 1), make_material(Diffuse{}));
  scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(Diffuse{}));
  scene.light(PointLight{{0, 0, 10}, {}});
  const auto world = scene.world();
  const auto lit = [&](double x) { return trace(*world, {x, 0, 0.5}, {0, 0, -1}).radiance[0] > 0; };
  EXPECT_FALSE(lit(1.4433756729740645 - 1e-7));
  EXPECT_TRUE(lit(1.4433756729740645 + 1e-7));
}

TEST(ClassicIntegrator, SphericalLightHasUmbraAndPenumbra) {
  SmallScene scene;
  scene.add(sphere({0, 0, 3}, 1), make_material(Diffuse{.color = 1.0}));
  scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(Diffuse{.color = 1.0}));
  SmallScene open = scene;
  SphereLight light{.center = {0, 0, 10}, .radius = 0.5, .sampling = {24, true}};
  scene.light(light);
  light.lamp.shadows = false;
  open.light(light);
  const auto world = scene.world(), open_world = open.world();
  const auto visible = [&](double x) {
    return trace(*world, {x, 0, 0.5}, {0, 0, -1}).radiance[0] / trace(*open_world, {x, 0, 0.5}, {0, 0, -1}).radiance[0];
  };
  EXPECT_EQ(visible(1.2173952858670358 - 1e-3), 0);
  EXPECT_GT(visible(1.2173952858670358 + 0.02), 0);
  EXPECT_LT(visible(1.6819265754924004 - 0.02), 0.9999);
  EXPECT_NEAR(visible(1.6819265754924004 + 1e-3), 1, 1e-6);
}

// Neither in full shadow nor in full light is there any noise, whether the light stands high or the horizon cuts it.
TEST(ClassicIntegrator, SoftLightsAreWithoutNoiseButInPenumbras) {
  for (const double slant : {10.0, 60.0, 85.0, 95.0})
    for (const bool hidden : {false, true}) {
      SmallScene scene;
      ClassicLook look;
      look.ambient = look.specular = 0.0;
      look.diffuse = 1.0;
      scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(look));
      if (hidden)
        scene.add(sphere({0, 0, 0}, 4), make_material(look));
      else
        scene.add(sphere({0, 0, -9}, 4), make_material(look));  // something that may stand in the way
      const DistantLight sun{-in_xz(slant), 30 * kDegree, {.n = 1}};
      scene.light(sun);
      const auto world = scene.world();
      const ConeLight cone = *make_light(sun)->cone(Vec3(0));
      const double mean = cone.mean_cosine(std::cos(slant * kDegree)) / cone.mean_cosine(1);
      for (uint32_t i = 0; i < 100; ++i) {
        Ray ray;
        ray.origin = {0.01 * i, 0.3, 1}, ray.direction = {0, 0, -1};
        SampleStream random(i, 0, 0, 1, 0);
        Hit first;
        ASSERT_TRUE(world->nearest(ray, first));
        const double light = world->model().integrator->trace(*world, ray, first, random).radiance[0];
        EXPECT_NEAR(light, hidden ? 0 : mean, hidden ? 0 : kFloat) << slant;
      }
    }
}

TEST(ClassicIntegrator, PenumbraOfAnEdgeIsAsWideAsTheLightSeenThroughIt) {
  // Light of size 0.2 at height 6, edge of a half-plane at height 1, receiver at 0: width 0.2 * 1 / 5 = 0.04.
  SmallScene scene;
  scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(Diffuse{.color = 1.0}));
  geometry::Frame half;
  half.origin = {0, 0, 1};
  scene.add(plane_part(half, {-20, 0}, {-20, 20}), make_material(Diffuse{}));
  RectangleLight light;
  light.frame.origin = {0, 0, 6};
  light.size = {0.2, 0.2};
  light.sampling = {21, true};
  scene.light(light);
  const auto world = scene.world();
  const auto visible = [&](double x) { return trace(*world, {x, 0, 0.5}, {0, 0, -1}).radiance[0]; };
  EXPECT_EQ(visible(-0.0201), 0);
  EXPECT_GT(visible(-0.0199), 0);
  EXPECT_NEAR(visible(0.0201), 1, 0.01);
  EXPECT_LT(visible(0.0199), visible(0.0201) - 0.04);
  EXPECT_NEAR(visible(0.0005), 11.0 / 21, 0.002);  // places of the light at x <= 0 are seen past the edge
}

TEST(ClassicIntegrator, ClearBodiesTintTheirShadows) {
  SmallScene scene;
  ClassicLook look;
  look.ambient = look.diffuse = 0.0;
  look.transmission = Vec3(0.9, 0.8, 0.7);
  look.absorption = {0.1, 0.2, 0.3};
  look.index = 1.5;
  scene.add(sphere({0, 0, 3}, 1), make_material(look));
  scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(Diffuse{.color = 1.0}));
  scene.light(PointLight{{0, 0, 10}, {}});
  const auto at = [&] { return trace(*scene.world(), {0, 0.01, 1}, {0, -0.01, -1}).radiance; };
  for (int i = 0; i < 3; ++i) {
    const double k_t = 0.9 - 0.1 * i, mu = 0.1 + 0.1 * i;
    EXPECT_NEAR(at()[i], k_t * k_t * std::exp(-2 * mu), kFloat);
  }
  scene.options.shadows = ShadowMode::opaque;
  EXPECT_TRUE(at().is_zero());
  scene.options.shadows = ShadowMode::none;
  EXPECT_NEAR(at()[0], 1, kFloat);
}

// A ball of radius 1 below a lamp 7 above its middle: the cone that touches it leaves a disc of 10 tan(asin(1/7)) dark.
TEST(ClassicIntegrator, ShadowEndsWhereTheConeTouches) {
  SmallScene scene;
  scene.add(sphere({0, 0, 3}, 1), make_material(Diffuse{}));
  scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(Diffuse{.color = 1.0}));
  scene.light(PointLight{{0, 0, 10}, {}});
  const double radius = 10 / std::sqrt(48.0);
  for (const double turn : {0.0, 1.0, 4.0}) {
    const auto lit = [&](double distance) {
      const Vec3 at(distance * std::cos(turn), distance * std::sin(turn), 0), eye = 3.0 * at + Vec3(0, 0, 1);
      return trace(*scene.world(), eye, at - eye).radiance[0];
    };
    EXPECT_EQ(lit(radius - 1e-6), 0) << turn;
    EXPECT_GT(lit(radius + 1e-6), 0.9) << turn;
  }
  scene.model.lights = {make_light(PointLight{{0, 0, 10}, {.shadows = false}})};
  EXPECT_GT(trace(*scene.world(), {3, 0, 1}, {-3, 0, -1}).radiance[0], 0.9);
}

TEST(ClassicIntegrator, ShadowCatcherShowsTheBackgroundLessItsShadows) {
  SmallScene scene;
  scene.model.background = {0.5f, 0.6f, 0.7f};
  scene.add(sphere({0, 0, 3}, 1), make_material(Diffuse{}));
  scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(ShadowCatcher{.strength = 0.5}));
  scene.light(PointLight{{0, 0, 10}, {}}).light(AmbientLight{.intensity = 0.25});
  const auto world = scene.world();
  const RaySample open = trace(*world, {4, 0, 1}, {0, 0, -1});
  EXPECT_EQ(open.radiance, scene.model.background);
  EXPECT_EQ(open.alpha, 0);
  const RaySample shadow = trace(*world, {0, 0, 1}, {0, 0, -1});
  EXPECT_NEAR(shadow.alpha, 0.5 * 1 / 1.25,
              kFloat);  // half of what the lamp would have brought beside the ambient light
  EXPECT_NEAR(shadow.radiance[2], 0.7 * 0.6, kFloat);
  EXPECT_EQ(trace(*world, {4, 0, -1}, {0, 0, 1}).point.has_value(), false);  // from below
}

TEST(ClassicIntegrator, BackOfAOneSidedSurfaceShowsOnlyAmbientLight) {
  ClassicLook look;
  look.two_sided = false;
  SmallScene scene;
  scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(look));
  scene.light(AmbientLight{}).light(PointLight{{0, 0, -3}, {}}).light(PointLight{{0, 0, 3}, {}});
  EXPECT_NEAR(trace(*scene.world(), {0, 0, -1}, {0, 0, 1}).radiance[0], 0.2, kFloat);
  EXPECT_NEAR(trace(*scene.world(), {0, 0, 1}, {0, 0, -1}).radiance[0], 1.0, kFloat);
}

TEST(ClassicIntegrator, MetalReflectsItsOwnColour) {
  // A polished mirror at right angles shows the background times ((n-1)^2 + k^2) / ((n+1)^2 + k^2), which the eye sees
  // under D65: the sum over the tables' wavelengths, cut to 1.
  Vec3 seen(0), white(0);
  for (int i = 0; i < kSpectrumEntries; ++i) {
    const auto l = static_cast<float>(entry_nanometres(i));
    const ComplexIndex at = metal_index("Cu", {{l, l, l, l}});
    const double n = at.n[0], k = at.k[0], r = ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k);
    const Vec3 light = illuminant_power("D65", l) * rec709(observer()[static_cast<size_t>(i)]);
    seen += r * light;
    white += light;
  }
  SmallScene scene;
  scene.model.background = Spectrum(1, 1, 1);
  scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(Conductor{.metal = "Cu", .roughness = 0}));
  const Spectrum r = trace(*scene.world(), {0, 0, 1}, {0, 0, -1}).radiance;
  for (int lane = 0; lane < 3; ++lane) EXPECT_NEAR(r[lane], std::min(1.0, seen[lane] / white[lane]), 1e-5);
  EXPECT_GT(r[0], r[1] + 0.2);
  EXPECT_GT(r[1], r[2]);
}

TEST(ClassicIntegrator, KeyTellsObjectsAndShadowsApart) {
  SmallScene scene;
  scene.add(sphere({0, 0, 3}, 1), make_material(Diffuse{}));
  scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(Diffuse{}));
  scene.light(PointLight{{0, 0, 10}, {}});
  const auto world = scene.world();
  const auto key = [&](const Vec3& from) { return trace(*world, from, {0, 0, -1}).key; };
  EXPECT_EQ(key({0, 0, 1}), key({0.3, 0, 1}));
  EXPECT_EQ(key({3, 0, 1}), key({4, 0, 1}));
  EXPECT_NE(key({0, 0, 1}), key({3, 0, 1}));
  EXPECT_NE(key({0, 0, 9}), key({3, 0, 1}));
}

}  // namespace
}  // namespace lekalo::render::classic_test
