// Path tracing against closed forms, within three standard errors of the mean.
#include "render/integrators/path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "render/integrators/dispersion.h"
#include "render/lobes/bsdf.h"
#include "render/lobes/fresnel.h"
#include "render/materials/optical_constants.h"
#include "tests/render/small_scene.h"

namespace lekalo::render::path_test {

namespace {

using geometry::kPi;

struct Estimate {
  double mean, error;
};

// Of the first lane, seen along a ray by `count` samples.
Estimate estimate(const World& world, const Vec3& origin, const Vec3& direction, int count) {
  Ray ray;
  ray.origin = origin;
  ray.direction = glm::normalize(direction);
  Hit first;
  if (!world.nearest(ray, first)) first.instance = -1;
  // Blocks of samples that are even in themselves, so that the error of their mean can be told.
  constexpr int kBlocks = 32;
  double sum = 0, squares = 0;
  for (int block = 0; block < kBlocks; ++block) {
    double of_block = 0;
    for (int i = 0; i < count / kBlocks; ++i) {
      SampleStream random(block, 0, i, count / kBlocks, 1);
      of_block += world.model().integrator->trace(world, ray, first, random).radiance[0];
    }
    of_block /= count / kBlocks;
    sum += of_block;
    squares += of_block * of_block;
  }
  const double mean = sum / kBlocks;
  return {mean, std::sqrt(std::max(0.0, squares / kBlocks - mean * mean) / (kBlocks - 1))};
}

std::shared_ptr<const World> world(const SmallScene& scene, const PathOptions& options = {}) {
  auto finished = std::make_shared<Model>(scene.model);
  finished->integrator = make_path_integrator(options);
  return std::make_shared<World>(finished);
}

void expect_mean(const Estimate& found, double truth, const char* what, double max_error) {
  EXPECT_NEAR(found.mean, truth, 3 * found.error + 1e-6 * truth) << what;
  EXPECT_LT(found.error, max_error * truth) << what;
}

TEST(Path, SphereLightOverAPlane) {
  // A ball of radiance L = I / sin(a)^2 (light.h: E = pi I on a surface that faces its middle) whose middle stands at
  // the angle b from the normal and that is all above the horizon gives E = pi L sin(a)^2 cos(b).
  SmallScene scene;
  scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(Diffuse{.color = 0.5}));
  scene.light(SphereLight{.center = {0.6, 0, 0.8}, .radius = 0.3, .lamp = {.intensity = 2}});
  const auto w = world(scene);
  const double facing = 2 * 0.8 * 0.5;
  expect_mean(estimate(*w, {0, -3, 3}, {0, 3, -3}, 4096), facing, "sphere", 1e-3);
}

TEST(Path, GlossySphereLightIsTheSameByBothEstimators) {
  // A mirror finds the lamp by the drawn direction alone; a very rough metal mostly by the lamp.
  SmallScene scene;
  scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(Conductor{.metal = "", .roughness = 0, .color = 0.5}));
  scene.light(SphereLight{.center = {0, 3, 3}, .radius = 0.5, .lamp = {.intensity = 2}});
  const double sine = 0.5 / std::sqrt(18.0), height = 1 - std::sqrt(1 - sine * sine);
  // Radiance of the ball seen from the plane: irradiance over the solid angle, weighted to the mean cosine.
  const double radiance = 2 * kPi / (1 - 0.5 * height) / (2 * kPi * height);
  const double f = 0.5 + 0.5 * std::pow(1 - std::sqrt(0.5), 5);
  expect_mean(estimate(*world(scene), {0, -3, 3}, {0, 3, -3}, 64), f * radiance, "mirror", 1e-6);
}

TEST(Path, RoughMetalUnderASphereLight) {
  // Both estimators find the lamp; the truth is the integral of f cos over its cone.
  for (const double roughness : {0.15, 0.4, 0.9}) {
    SmallScene scene;
    const MaterialPtr metal = make_material(Conductor{.metal = "Cu", .roughness = roughness});
    scene.add(plane({0, 0, 0}, {0, 0, 1}), metal);
    const SphereLight light{.center = {0.3, 2, 2}, .radius = 0.7, .lamp = {.intensity = 2}};
    scene.light(light);
    const Vec3 out = glm::normalize(Vec3(0, -3, 3));
    const Scattering scattering = metal->scattering({}, {});
    const Bsdf bsdf(scattering, {0, 0, 1}, {0, 0, 1}, {1, 0, 0}, out, {});
    const double distance = glm::length(light.center), sine = light.radius / distance;
    const double height = 1 - std::sqrt(1 - sine * sine);
    const geometry::Frame cone = geometry::frame_about({0, 0, 0}, light.center / distance);
    constexpr int kN = 400;
    double truth = 0;
    for (int i = 0; i < kN; ++i)
      for (int j = 0; j < kN; ++j) {
        const double h = height * (i + 0.5) / kN, angle = 2 * kPi * (j + 0.5) / kN, s = std::sqrt(h * (2 - h));
        truth += bsdf.evaluate(cone.direction({s * std::cos(angle), s * std::sin(angle), 1 - h}))[0];
      }
    // Radiance times the solid angle is the irradiance at right angles.
    truth *= 2 * kPi / (1 - 0.5 * height) / (kN * kN);
    expect_mean(estimate(*world(scene), 4.0 * out, -out, 4096), truth, "metal", 1e-2);
  }
}

// The error of a picture as the difference of two: mean square, and the part of it in waves no shorter than an eighth
// of the side.
struct PictureError {
  double mean_square = 0, low = 0;
};

PictureError error_of_soft_shadow(const World& world, uint32_t samples, bool in_picture) {
  constexpr int kSide = 64, kWaves = 8;
  std::vector<double> error(kSide * kSide);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      Ray ray;
      ray.origin = {0, 0, 0.5};
      ray.direction = glm::normalize(Vec3((x + 0.5) / kSide - 0.5, (y + 0.5) / kSide - 0.5, -0.5));
      Hit first;
      if (!world.nearest(ray, first)) first.instance = -1;
      for (const uint32_t seed : {1u, 2u})
        for (uint32_t i = 0; i < samples; ++i) {
          SampleStream random =
              in_picture ? SampleStream::in_picture(x, y, i, samples, seed) : SampleStream(x, y, i, samples, seed);
          error[y * kSide + x] += (seed == 1 ? 1.0 : -1.0) / samples *
                                  world.model().integrator->trace(world, ray, first, random).radiance[0];
        }
    }
  PictureError found;
  for (const double e : error) found.mean_square += e * e / (kSide * kSide);
  for (int v = -kWaves; v <= kWaves; ++v)
    for (int u = -kWaves; u <= kWaves; ++u) {
      if (u * u + v * v > kWaves * kWaves) continue;
      std::complex<double> wave = 0;
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
          wave += error[y * kSide + x] * std::polar(1.0, 2 * kPi * (u * x + v * y) / kSide);
      found.low += std::norm(wave) / std::pow(kSide, 4);
    }
  return found;
}

TEST(Path, ErrorOfSoftShadowsIsBlue) {
  // A screen between a square lamp and the ground, its edge over the middle.
  SmallScene scene;
  scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(Diffuse{.color = 1.0}));
  geometry::Frame screen;
  screen.origin = {0, 0, 1};
  scene.add(plane_part(screen, {0, 4}, {-4, 4}), make_material(Diffuse{.color = 0.0}));
  RectangleLight light;
  light.frame = geometry::frame_about({0, 0, 2}, {0, 0, -1});
  light.size = {1, 1};
  scene.light(light);
  const auto w = world(scene);
  for (const uint32_t samples : {1u, 4u, 16u}) {
    const PictureError apart = error_of_soft_shadow(*w, samples, false),
                       together = error_of_soft_shadow(*w, samples, true);
    EXPECT_GT(apart.low, 0);
    EXPECT_LT(together.low, 0.5 * apart.low) << samples;
    // Over so many pixels of a penumbra it is known to a few percent.
    EXPECT_LT(together.mean_square, 1.08 * apart.mean_square) << samples;
    RecordProperty("low_" + std::to_string(samples), std::to_string(together.low / apart.low));
    RecordProperty("all_" + std::to_string(samples), std::to_string(together.mean_square / apart.mean_square));
  }
}

TEST(Path, RectangleLightFormFactor) {
  // A matt emitter of radiance pi I / A, one-sided, parallel over the place: form factor of a corner (Howell's B-3),
  // four times, F = (2 / pi) (a / sqrt(1 + a^2)) atan(a / sqrt(1 + a^2)) for a square of half side a at distance 1.
  SmallScene scene;
  scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(Diffuse{.color = 1.0}));
  RectangleLight light;
  light.frame = geometry::frame_about({0, 0, 1}, {0, 0, -1});
  light.size = {2, 2};
  light.one_sided = true;
  light.lamp.inverse_square = true;
  light.lamp.intensity = 1;
  scene.light(light);
  const double root = std::sqrt(2.0);
  const double form = 4 / (kPi * 1.0) * (1 / root) * std::atan(1 / root);
  expect_mean(estimate(*world(scene), {0, -3, 0.5}, {0, 3, -0.5}, 8192), form * kPi / 4, "rectangle", 2e-3);
}

TEST(Path, MattBallInsideAGlowingOne) {
  // In a closed hall of emission e and albedo r the radiance is e / (1 - r) everywhere.
  SmallScene scene;
  ClassicLook look;
  look.color = 1.0;
  look.diffuse = 0.6;
  look.emission = 0.4;
  scene.add(sphere({0, 0, 0}, 2), make_material(look));
  const Estimate found = estimate(*world(scene), {0, 0, 0}, {1, 0.3, 0.2}, 2048);
  expect_mean(found, 1, "enclosure", 5e-3);
}

TEST(Path, GlowingBallLightsAPlane) {
  // Radiance e, radius r, its middle at the distance 1 and b from the normal: irradiance pi e r^2 cos(b).
  SmallScene scene;
  scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(Diffuse{.color = 0.5}));
  scene.add(sphere({0.6, 0, 0.8}, 0.1), make_material(Emission{.strength = 20}));
  const Estimate found = estimate(*world(scene, {.max_depth = 0}), {0, -3, 3}, {0, 3, -3}, 4096);
  expect_mean(found, 0.5 * 20 * 0.01 * 0.8, "ball", 2e-2);
}

TEST(Path, GlowingBallIsALampOfItsRadiance) {
  SmallScene glow, lamp;
  for (SmallScene* scene : {&glow, &lamp})
    scene->add(plane({0, 0, 0}, {0, 0, 1}), make_material(Conductor{.metal = "Cu", .roughness = 0.3}));
  glow.add(sphere({0, 1.2, 1.2}, 0.3), make_material(Emission{.strength = 2}));
  const double sine = 0.3 / (1.2 * std::sqrt(2.0)), height = 1 - std::sqrt(1 - sine * sine);
  lamp.light(
      SphereLight{.center = {0, 1.2, 1.2}, .radius = 0.3, .lamp = {.intensity = 2 * 2 * height * (1 - 0.5 * height)}});
  const Estimate by_glow = estimate(*world(glow, {.max_depth = 0}), {0, -3, 3}, {0, 3, -3}, 8192);
  const Estimate by_lamp = estimate(*world(lamp, {.max_depth = 0}), {0, -3, 3}, {0, 3, -3}, 8192);
  EXPECT_NEAR(by_glow.mean, by_lamp.mean, 3 * std::hypot(by_glow.error, by_lamp.error));
  EXPECT_LT(by_glow.error, 0.02 * by_glow.mean);
}

TEST(Path, WhiteFurnace) {
  // Whatever stands in light that is the same from everywhere and takes nothing looks like that light.
  for (const bool clear : {false, true}) {
    SmallScene scene;
    scene.light(AmbientLight{.intensity = 1});
    scene.model.background = Spectrum(1, 1, 1);
    scene.add(sphere({0, 0, 0}, 1),
              clear ? make_material(Dielectric{.index = 1.5}) : make_material(Diffuse{.color = 1.0}));
    for (const double x : {0.0, 0.5, 0.9})
      expect_mean(estimate(*world(scene), {x, 0, 4}, {0, 0, -1}, 2048), 1, clear ? "glass" : "white", 2e-3);
  }
}

TEST(Path, MilkThatTakesNothingIsWhiteInAFurnace) {
  for (const double index : {1.0, 1.4}) {
    SmallScene scene;
    scene.light(AmbientLight{.intensity = 1});
    scene.model.background = Spectrum(1, 1, 1);
    Dielectric milk{.index = index};
    milk.scattering = Vec3(2, 3, 4);
    milk.forward = 0.5;
    scene.add(sphere({0, 0, 0}, 1), make_material(milk));
    for (const double x : {0.0, 0.8})
      expect_mean(estimate(*world(scene), {x, 0, 4}, {0, 0, -1}, 8192), 1, "milk", 1e-2);
  }
}

// So little of the light is scattered that twice scattered light is lost in the tolerance: with the light going along
// -z and the ray along y through the middle of a ball of radius 1,
//   L = integral of mu_s p(90 degrees) E exp(-mu (1 + y) - mu sqrt(1 - y^2)) dy over [-1, 1].
TEST(Path, LightScatteredOnceIsTheIntegralOverTheRay) {
  const double loss = 0.9, scattered = 1e-3, g = 0.4, power = 2;
  SmallScene scene;
  scene.light(DistantLight{.direction = {0, 0, -1}, .lamp = {.intensity = power}});
  Dielectric smoke{.index = 1};
  smoke.scattering = Vec3(scattered);
  smoke.absorption = Vec3(loss - scattered);
  smoke.forward = g;
  scene.add(sphere({0, 0, 0}, 1), make_material(smoke));
  const double phase = (1 - g * g) / (4 * kPi * std::pow(1 + g * g, 1.5));
  double truth = 0;
  constexpr int kParts = 20000;
  for (int i = 0; i < kParts; ++i) {
    const double y = -1 + 2 * (i + 0.5) / kParts;
    truth += 2.0 / kParts * scattered * phase * kPi * power * std::exp(-loss * (1 + y + std::sqrt(1 - y * y)));
  }
  const Estimate found = estimate(*world(scene), {0, -4, 0}, {0, 1, 0}, 32768);
  EXPECT_NEAR(found.mean, truth, 3 * found.error + 2e-3 * truth);
  EXPECT_LT(found.error, 1e-2 * truth);
}

// Thin smoke scatters mu_s / (4 pi) of the light of a glowing ball of radiance L over the solid angle of its cone.
TEST(Path, SmokeShowsTheLightOfWhatGlows) {
  const double scattered = 5e-3, radius = 2.5, off = 4, radiance = 2;
  SmallScene scene;
  Dielectric smoke{.index = 1};
  smoke.scattering = Vec3(scattered);
  scene.add(sphere({0, 0, 0}, 1), make_material(smoke));
  scene.add(sphere({off, 0, 0}, radius), make_material(Emission{.strength = radiance}));
  double truth = 0;
  constexpr int kParts = 2000;
  for (int i = 0; i < kParts; ++i) {
    const double y = -1 + 2 * (i + 0.5) / kParts, sine = radius / std::hypot(off, y);
    truth += 2.0 / kParts * scattered / (4 * kPi) * radiance * 2 * kPi * (1 - std::sqrt(1 - sine * sine));
  }
  const Estimate found = estimate(*world(scene), {0, -4, 0}, {0, 1, 0}, 1 << 18);
  EXPECT_NEAR(found.mean, truth, 3 * found.error + 1e-2 * truth);
  EXPECT_LT(found.error, 0.1 * truth);
}

TEST(Path, OverlappingGlassesInAFurnaceAreWhite) {
  SmallScene scene;
  scene.light(AmbientLight{.intensity = 1});
  scene.model.background = Spectrum(1, 1, 1);
  Dielectric water{.index = 1.33};
  scene.add(sphere({0, 0, 0}, 1), make_material(water));
  scene.add(sphere({0.8, 0, 0}, 0.7), make_material(Dielectric{.index = 1.6, .priority = 1}));
  scene.add(sphere({-0.4, 0, 0}, 0.3), make_material(Dielectric{.index = 1.5, .roughness = 0.1, .priority = 2}));
  expect_mean(estimate(*world(scene), {0.35, 0.2, 4}, {0, 0, -1}, 4096), 1, "glass and water", 1e-2);
}

TEST(Path, SlabReflectsAndAbsorbs) {
  // Incoherent plane slab, R of one face, T = exp(-mu d): reflectance R (1 + (1 - R)^2 T^2 / (1 - R^2 T^2)),
  // transmittance (1 - R)^2 T / (1 - R^2 T^2), at right angles.
  SmallScene scene;
  scene.light(AmbientLight{.intensity = 0});
  scene.model.background = Spectrum(1, 1, 1);
  Dielectric glass{.index = 1.5};
  glass.absorption = Vec3(0.7);
  scene.add(slab(0, 1), make_material(glass));
  const double r = 0.04, t = std::exp(-0.7);
  const double truth = r + (1 - r) * (1 - r) * t / (1 - r * t);  // of both together, for light from both sides
  const double reflected = r * (1 + (1 - r) * (1 - r) * t * t / (1 - r * r * t * t));
  const double passed = (1 - r) * (1 - r) * t / (1 - r * r * t * t);
  EXPECT_NEAR(truth, reflected + passed, 1e-12);
  expect_mean(estimate(*world(scene), {0.2, 0.1, 3}, {0, 0, -1}, 4096), reflected + passed, "slab", 1e-2);
}

TEST(Path, ThinPaneOverMattLetsItsLightThrough) {
  // A parallel light at right angles through a pane: 2 F / (1 + F) of it does not arrive. What the plane sends back is
  // seen through the pane again, and some of it comes back from the pane, which only makes the plane brighter.
  SmallScene scene;
  scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(Diffuse{.color = 0.5}));
  Dielectric pane{.index = 1.5};
  pane.thin = true;
  geometry::Frame frame;
  frame.origin = {0, 0, 1};
  scene.add(plane_part(frame, {-0.01, 0.01}, {-0.01, 0.01}), make_material(pane));
  scene.light(DistantLight{.direction = {0, 0, -1}, .lamp = {.intensity = 1}});
  const double pass = 1 - 2 * 0.04 / 1.04;
  EXPECT_NEAR(estimate(*world(scene, {.max_depth = 0}), {3, 0, 0.5}, {-3, 0, -0.5}, 32).mean, 0.5 * pass, 1e-4);
}

TEST(Path, MirrorsInARow) {
  // Two parallel mirrors of reflectance 1/2 and a lamp's ambient light at the end of paths: a path that leaves after k
  // reflections brings 2^-k.
  SmallScene scene;
  ClassicLook mirror;
  mirror.diffuse = 0.0;
  mirror.ambient = 0.0;
  mirror.mirror = 0.5;
  scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(mirror));
  scene.model.background = Spectrum(1, 1, 1);
  expect_mean(estimate(*world(scene), {0, 0, 3}, {0.1, 0, -1}, 32), 0.5, "mirror", 1e-6);
}

TEST(Path, ShadowsOfAmbientLight) {
  // A place on a plane under half of the sky: a wall hides a quarter of a sphere, half of the light.
  SmallScene scene;
  scene.light(AmbientLight{.intensity = 1});
  scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(Diffuse{.color = 1.0}));
  scene.add(plane({0, 1e-6, 0}, {0, -1, 0}), make_material(Diffuse{.color = 0.0}));
  expect_mean(estimate(*world(scene), {0, -1, 1}, {0, 1, -1}, 2048), 0.5, "wall", 5e-3);
}

TEST(Path, WavelengthsTogetherAreWhite) {
  constexpr int kCount = 1 << 14;
  Spectrum sum;
  double last = 0;
  for (int i = 0; i < kCount; ++i) {
    const WavelengthSample sample = sample_wavelength((i + 0.5) / kCount);
    EXPECT_GT(sample.nanometres, last);
    last = sample.nanometres;
    sum += (1.0f / kCount) * sample.share;
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], 1, 1e-3);
  EXPECT_LE(last, 780);
}

TEST(Path, PrismSpreadsColours) {
  // Light at right angles through the first face of a prism, out through the second one at an angle a from it: it goes
  // on at asin(n sin(a)) from that face's normal. The place where it meets a screen is what the screen glows with.
  SmallScene scene;
  const double a = 30 * kPi / 180;
  const MaterialPtr glass = make_material(Dielectric{.glass = "SF10"});
  scene.add(SurfaceSet{plane({0, 0, 0}, {0, 0, 1}), plane({0, 0, -1}, {std::sin(a), 0, -std::cos(a)})}, glass);
  scene.add(plane({0, 0, -11}, {0, 0, 1}), coordinate_screen({1, 0, 0}));
  scene.model.background = Spectrum();
  // Where the ray x = 0 of a wavelength meets the screen.
  const auto place = [&](double nanometres) {
    const double out = std::asin(dielectric_index("SF10", nanometres) * std::sin(a)) - a;
    return -10 * std::tan(out);
  };
  Spectrum truth;
  constexpr int kCount = 4096;
  for (int i = 0; i < kCount; ++i) {
    const WavelengthSample sample = sample_wavelength((i + 0.5) / kCount);
    truth += (static_cast<float>(place(sample.nanometres)) / kCount) * sample.share;
  }
  // Of the light both faces let through: what goes straight through the first one is no bounce, and what the second one
  // reflects is cut off.
  const double n = dielectric_index("SF10", 587.56);
  EXPECT_LT(std::abs(place(450)), 100);
  EXPECT_NE(place(450), place(650));
  const Estimate found = estimate(*world(scene, {.max_depth = 0, .dispersion = true}), {0, 0, 3}, {0, 0, -1}, 16384);
  const double passes = (1 - fresnel_dielectric(1, 1, n)) * (1 - fresnel_dielectric(std::cos(a), n, 1));
  EXPECT_NEAR(found.mean, truth[0] * passes, 0.02 * std::abs(truth[0]) + 3 * found.error);
  const Estimate yellow = estimate(*world(scene, {.max_depth = 0}), {0, 0, 3}, {0, 0, -1}, 4096);
  EXPECT_NEAR(yellow.mean, place(587.5618) * passes, 0.02 * std::abs(truth[0]) + 3 * yellow.error);
}

TEST(Path, PrismDeviatesAsItsIndicesSay) {
  // At the least deviation of a prism of 60 degrees, 2 asin(n sin 30) - 60 degrees, by the indices of Schott's data
  // sheet of N-BK7 for the lines d, F and C.
  const MaterialPtr glass = make_material(Dielectric{.glass = "N-BK7"});
  const auto refracted = [&](const Vec3& direction, const Vec3& normal, double near, double behind) {
    const Scattering scattering = glass->scattering({}, Wavelengths{});
    const Bsdf bsdf(scattering, normal, normal, Vec3(0), -direction, {near, behind});
    for (int i = 0; i < 64; ++i)  // reflected ones are of no interest
      if (const auto sample = bsdf.sample({(i + 0.5) / 64, 0.5}, {0.5, 0.5}))
        if (glm::dot(sample->in, normal) < 0) return sample->in;
    return Vec3(0);
  };
  const struct { double nanometres, index; } lines[] = {{587.5618, 1.51680}, {486.1327, 1.52238}, {656.2725, 1.51432}};
  for (const auto& line : lines) {
    const auto wavelength = static_cast<float>(line.nanometres);
    const double n = glass->interior({{wavelength, wavelength, wavelength, wavelength}})->index;
    const double half = kPi / 6, in = std::asin(line.index * std::sin(half));
    // Faces at 30 degrees to both sides of z; light along the base within, if it comes in at that angle.
    const Vec3 first(-std::cos(half), 0, std::sin(half)), second(-std::cos(half), 0, -std::sin(half));
    const double turn = in - half;
    const Vec3 start(std::cos(turn), 0, std::sin(turn));
    const Vec3 out = refracted(refracted(start, first, 1, n), second, n, 1);
    EXPECT_NEAR(std::acos(glm::dot(start, out)), 2 * in - kPi / 3, 1e-4) << line.nanometres;
  }
}

TEST(Path, DispersingBallInAFurnaceIsWhite) {
  SmallScene scene;
  scene.light(AmbientLight{.intensity = 1});
  scene.model.background = Spectrum(1, 1, 1);
  scene.add(sphere({0, 0, 0}, 1), make_material(Dielectric{.glass = "N-BK7"}));
  expect_mean(estimate(*world(scene, {.dispersion = true}), {0.7, 0, 4}, {0, 0, -1}, 8192), 1, "glass", 1e-2);
}

// White above, dim below the horizon.
EnvironmentLight sky() {
  EnvironmentLight light;
  light.image = make_image(8, 4);
  for (const char* name : {"R", "G", "B"}) {
    Channel& channel = add_channel(light.image, name);
    for (size_t i = 0; i < channel.values.size(); ++i) channel.values[i] = i < 16 ? 1.0f : 0.3f;
  }
  return light;
}

TEST(Path, PanoramaWithoutShadowsStaysBehindThings) {
  EnvironmentLight light = sky();
  light.shadows = false;
  SmallScene scene;
  scene.light(light);
  scene.add(sphere({0, 0, 0}, 1), make_material(Diffuse{.color = 0.0}));
  scene.add(plane({0, 0, -3}, {0, 0, 1}), make_material(Conductor{.metal = "", .roughness = 0, .color = 1.0}));
  const auto w = world(scene);
  EXPECT_EQ(estimate(*w, {0, -5, 0}, {0, 1, 0}, 32).mean, 0) << "black ball";
  EXPECT_NEAR(estimate(*w, {0, -5, 3}, {0, 0, 1}, 32).mean, 1, 1e-5) << "beside it";
  EXPECT_NEAR(estimate(*w, {0, -4, -1}, {0, -1, -1}, 32).mean, 1, 1e-5) << "sky in the mirror";
  EXPECT_EQ(estimate(*w, {0, -3, 0}, {0, 1.5, -3}, 32).mean, 0) << "ball in the mirror";
}

TEST(Path, RaysAskTheLampsThatTheyCanMeet) {
  SmallScene scene;
  scene.light(PointLight{}).light(AmbientLight{}).light(SphereLight{}).light(DistantLight{}).light(sky());
  const auto w = world(scene);
  EXPECT_EQ(w->lamps().size(), 4u);
  EXPECT_EQ(w->lamps_with_size(), (std::vector<size_t>{1, 3}));
  EXPECT_EQ(w->backdrops(), (std::vector<size_t>{3}));
}

TEST(Path, CaughtShadowsAreThoseOfTheClassicModel) {
  SmallScene scene;
  scene.light(sky());
  scene.model.background = Spectrum(1, 1, 1);
  scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(ShadowCatcher{}));
  scene.add(plane_part(geometry::frame_about({0, 0, 1}, {0, 0, 1}), {-1, 1}, {-1, 1}),
            make_material(Diffuse{.color = 0.0}));
  const Estimate classic = estimate(*scene.world(), {0, -3, 0.5}, {0, 3, -0.5}, 2048);
  const Estimate path = estimate(*world(scene), {0, -3, 0.5}, {0, 3, -0.5}, 2048);
  EXPECT_LT(classic.mean, 0.6);
  EXPECT_NEAR(path.mean, classic.mean, 3 * (path.error + classic.error));
}

TEST(Path, ClampIsRecordedInTheOptions) {
  const IntegratorPtr path = make_path_integrator({.clamp = 4});
  const std::any made = path->made_from();
  const auto* options = std::any_cast<PathOptions>(&made);
  ASSERT_NE(options, nullptr);
  EXPECT_EQ(options->clamp, 4);
}

}  // namespace

}  // namespace lekalo::render::path_test
