// Spectral paths against integrals over the wavelengths, within four standard errors of the mean.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <functional>

#include "render/integrators/path.h"
#include "render/lobes/film.h"
#include "render/lobes/fresnel.h"
#include "render/materials/optical_constants.h"
#include "render/spectra/hero_wavelengths.h"
#include "render/spectra/illuminants.h"
#include "render/spectra/observer.h"
#include "render/spectra/upsampling.h"
#include "tests/render/small_scene.h"

namespace lekalo::render::spectral_test {
namespace {

using geometry::kPi;

struct Colors {
  Vec3 mean{0}, error{0};
};

Colors estimate(const SmallScene& scene, PathOptions options, const Vec3& origin, const Vec3& direction, int count) {
  options.spectral = true;
  auto model = std::make_shared<Model>(scene.model);
  model->integrator = make_path_integrator(options);
  const World world(model);
  const IntegratorPtr prepared = model->integrator->prepared(world);
  const Integrator& integrator = prepared ? *prepared : *model->integrator;
  Ray ray;
  ray.origin = origin;
  ray.direction = glm::normalize(direction);
  Hit first;
  if (!world.nearest(ray, first)) first.instance = -1;
  constexpr int kBlocks = 32;
  Vec3 sum(0), squares(0);
  for (int block = 0; block < kBlocks; ++block) {
    Vec3 of_block(0);
    for (int i = 0; i < count / kBlocks; ++i) {
      SampleStream random(block, 0, i, count / kBlocks, 1);
      of_block += rgb(integrator.trace(world, ray, first, random).radiance) / static_cast<double>(count / kBlocks);
    }
    sum += of_block / static_cast<double>(kBlocks);
    squares += of_block * of_block / static_cast<double>(kBlocks);
  }
  return {sum, glm::sqrt(glm::max(Vec3(0), squares - sum * sum) / (kBlocks - 1.0))};
}

void expect_colors(const Colors& found, const Vec3& truth, double max_error, const char* what) {
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(found.mean[c], truth[c], 4 * found.error[c] + 1e-4) << what << ", colour " << c;
    EXPECT_LT(found.error[c], max_error) << what << ", colour " << c;
  }
}

Wavelengths about(double nanometres) {
  const auto l = static_cast<float>(nanometres);
  return {{l, l, l, l + 1e-3f}};
}

TEST(Spectral, WhiteSurfaceUnderAWhiteLampIsWhite) {
  SmallScene scene;
  scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(Diffuse{.color = 1.0}));
  scene.light(PointLight{.position = {0, 0, 2}});
  expect_colors(estimate(scene, {}, {0, -1, 1}, {0, 1, -1}, 4096), Vec3(1), 2e-3, "white");
}

// Between the entries of the tables all is straight, and so are narrow lines: their integral is not the sum over the
// entries, by some thousandths. By trapezoids of 1/4 nm.
Vec3 color_by_integral(const std::function<double(double)>& multiple) {
  Vec3 sum(0), white(0);
  for (int i = 0; i <= 1600; ++i) {
    const double l = 380 + 0.25 * i, place = (l - kFirstNanometre) / kNanometreStep;
    const auto below = static_cast<size_t>(std::min(place, kSpectrumEntries - 2.0));
    const Vec3 response =
        glm::mix(white_response()[below], white_response()[below + 1], place - static_cast<double>(below));
    const double width = i == 0 || i == 1600 ? 0.5 : 1;
    white += width * response;
    sum += width * multiple(l) * response;
  }
  return sum / white;
}

TEST(Spectral, LampsShowTheirSpectra) {
  for (const char* name : {"A", "D50", "F2", "F11"}) {
    const auto spectrum = std::make_shared<LampSpectrum>([name](double l) { return illuminant_power(name, l); });
    SmallScene scene;
    scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(Diffuse{.color = Vec3(0.8, 0.3, 0.1)}));
    scene.light(PointLight{.position = {0, 0, 2}, .lamp = {.color = spectrum->color(), .spectrum = spectrum}});
    const Vec3 truth = color_by_integral([&](double l) {
      return static_cast<double>(spectrum->at(rgb(spectrum->color()), about(l))[0] *
                                 upsampled_reflectance(Spectrum(0.8f, 0.3f, 0.1f), about(l))[0]);
    });
    expect_colors(estimate(scene, {}, {0, -1, 1}, {0, 1, -1}, 8192), truth, 4e-3, name);
  }
}

TEST(Spectral, MetalsMirrorTheIntegralsOfTheirReflectance) {
  for (const char* name : {"Cu", "Au", "Ag"}) {
    SmallScene scene;
    scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(Conductor{.metal = name, .roughness = 0}));
    scene.light(AmbientLight{});
    scene.model.background = Spectrum(1, 1, 1);
    const double cosine = std::sqrt(0.5);
    const Vec3 truth = color_of([&](double l) {
      const ComplexIndex index = metal_index(name, about(l));
      return fresnel_conductor(cosine, static_cast<double>(index.n[0]), static_cast<double>(index.k[0]));
    });
    expect_colors(estimate(scene, {}, {0, -1, 1}, {0, 1, -1}, 4096), truth, 2e-3, name);
  }
}

TEST(Spectral, SoapFilmsMirrorTheIntegralOfAirysSum) {
  for (const double thickness : {180.0, 420.0}) {
    SmallScene scene;
    const ThinFilm film{.index = 1.33, .least = thickness, .most = thickness, .texture = nullptr};
    scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(Dielectric{.index = 1, .thin = true, .film = film}));
    scene.add(plane({0, 0, -1}, {0, 0, 1}), make_material(Diffuse{.color = 0.0}));
    scene.model.background = Spectrum(1, 1, 1);
    const Vec3 truth = color_of([&](double l) { return film_reflectance(std::sqrt(0.5), 1, 1.33, 1.0, thickness, l); });
    expect_colors(estimate(scene, {}, {0, -1, 1}, {0, 1, -1}, 1 << 14), truth, 5e-3, "film");
  }
}

TEST(Spectral, ColouredLightOnAColouredSurface) {
  SmallScene scene;
  const Vec3 surface(0.7, 0.2, 0.1), lamp(0.2, 1, 0.3);
  scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(Diffuse{.color = surface}));
  scene.light(PointLight{.position = {0, 0, 2}, .lamp = {.color = lamp}});
  const Vec3 truth = color_of([&](double l) {
    return static_cast<double>(upsampled_light(rgb(lamp), about(l))[0] *
                               upsampled_reflectance(rgb(surface), about(l))[0]);
  });
  expect_colors(estimate(scene, {}, {0, -1, 1}, {0, 1, -1}, 4096), truth, 2e-3, "two colours");
}

TEST(Spectral, PrismSpreadsColours) {
  // As Path.PrismSpreadsColours: where the ray meets a screen is what the screen glows with.
  SmallScene scene;
  const double a = 30 * kPi / 180;
  scene.add(SurfaceSet{plane({0, 0, 0}, {0, 0, 1}), plane({0, 0, -1}, {std::sin(a), 0, -std::cos(a)})},
            make_material(Dielectric{.glass = "SF10"}));
  scene.add(plane({0, 0, -11}, {0, 0, 1}), coordinate_screen({-1, 0, 0}));
  const Vec3 truth = color_of([&](double l) {
    const double n = dielectric_index("SF10", l), out = std::asin(n * std::sin(a)) - a;
    return 10 * std::tan(out) * (1 - fresnel_dielectric(1, 1, n)) * (1 - fresnel_dielectric(std::cos(a), n, 1));
  });
  expect_colors(estimate(scene, {.max_depth = 0}, {0, 0, 3}, {0, 0, -1}, 1 << 15), truth, 0.1, "prism");
}

TEST(Spectral, MilkThatAbsorbsNothingIsAsBrightAsAllAround) {
  // However often each colour is scattered: a white furnace.
  SmallScene scene;
  scene.add(sphere({0, 0, 0}, 1), make_material(Dielectric{.index = 1, .scattering = Vec3(3, 1, 0.5)}));
  scene.light(AmbientLight{});
  scene.model.background = Spectrum(1, 1, 1);
  const Colors found = estimate(scene, {.max_depth = 1000, .max_scatterings = 1000}, {0, -3, 0}, {0, 1, 0.1}, 1 << 13);
  expect_colors(found, Vec3(1), 0.02, "milk");
}

TEST(Spectral, PhotonsBringWhiteLightAsInRgb) {
  SmallScene scene;
  scene.add(plane({0, 0, 0}, {0, 0, 1}), make_material(Diffuse{.color = 0.7}));
  scene.add(sphere({0, 0, 1.2}, 0.8), make_material(Dielectric{.index = 1.5}));
  scene.light(PointLight{.position = {0, 0, 6}, .lamp = {.intensity = 30, .inverse_square = true}});
  const PathOptions options{.photons = 20000};
  auto model = std::make_shared<Model>(scene.model);
  model->integrator = make_path_integrator(options);
  const World world(model);
  const IntegratorPtr prepared = model->integrator->prepared(world);
  Ray ray;
  ray.origin = {0.9, -1.5, 0.3};
  ray.direction = glm::normalize(Vec3(0.05, 0.05, 0) - ray.origin);
  Hit first;
  ASSERT_TRUE(world.nearest(ray, first));
  double mean = 0;
  constexpr int kCount = 4096;
  for (int i = 0; i < kCount; ++i) {
    SampleStream random(0, 0, i, kCount, 1);
    mean += static_cast<double>(prepared->trace(world, ray, first, random).radiance[0]) / kCount;
  }
  const Colors found = estimate(scene, options, ray.origin, ray.direction, kCount);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found.mean[c], mean, 4 * found.error[c] + 5e-3 * mean) << c;
}

}  // namespace
}  // namespace lekalo::render::spectral_test
