// Whole materials: none sends back more light than falls on it, and their parameters do what they say.
#include "render/materials/materials.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/integrators/classic_reading.h"
#include "render/lobes/bsdf.h"
#include "render/materials/textures.h"
#include "render/samplers/sampler.h"

namespace lekalo::render::materials_test {

namespace {

// Share of the light of a white furnace that reaches the viewer, by lane.
Spectrum furnace(const Material& material, double cosine, const SurfacePoint& point = {}) {
  constexpr int kSamples = 4096;
  const Scattering scattering = material.scattering(point, {});
  const auto medium = material.interior({});
  const Vec3 out(std::sqrt(1 - cosine * cosine), 0, cosine);
  const Bsdf bsdf(scattering, {0, 0, 1}, {0, 0, 1}, {1, 0, 0}, out, {1, medium ? medium->index : 1.0});
  Spectrum sum;
  for (int i = 0; i < kSamples; ++i) {
    SampleStream random(1, 1, i, kSamples, 1);
    const Vec2 choice = random.next_sobol_pair(), square = random.next_sobol_pair();
    if (const auto taken = bsdf.sample(choice, square)) sum += (1.0f / kSamples) * taken->share;
  }
  return sum;
}

Principled white() {
  Principled p;
  p.base_color = 1.0;
  return p;
}

TEST(Materials, SendBackNoMoreLightThanFallsOnThem) {
  Principled glass = white(), metal = white(), coated = white(), fuzzy = white(), all = white();
  glass.transmission_weight = 1;
  metal.base_metalness = 1;
  coated.coat_weight = 1;
  fuzzy.fuzz_weight = 1;
  all.base_metalness = 0.3;
  all.transmission_weight = 0.4;
  all.coat_weight = 0.5;
  all.fuzz_weight = 0.5;
  ClassicLook greedy;  // as it stands it would send back 0.8 + 1 + 1
  greedy.mirror = 1.0;
  greedy.specular = 1.0;
  greedy.exponent = 1;
  const Mix mix{make_material(coated), make_material(Diffuse{.color = 1.0, .roughness = 0.7}), 0.4};
  const std::vector<std::pair<const char*, MaterialPtr>> materials{
      {"principled", make_material(white())},
      {"principled glass", make_material(glass)},
      {"principled metal", make_material(metal)},
      {"principled coat", make_material(coated)},
      {"principled fuzz", make_material(fuzzy)},
      {"principled all", make_material(all)},
      {"cloth", make_material(Cloth{.color = 1.0})},
      {"sheet", make_material(TranslucentSheet{.color = 0.5, .transmission = 0.5})},
      {"mix", make_material(mix)},
      {"classic", make_material(greedy)},
      {"silver", make_material(Conductor{.metal = "Ag", .roughness = 0.5})},
      {"plastic", make_material(Plastic{.color = 1.0})}};
  for (const auto& [name, material] : materials)
    for (const double cosine : {1.0, 0.5, 0.1}) {
      const Spectrum back = furnace(*material, cosine);
      EXPECT_LE(back.largest(), 1 + 2e-3) << name << " at " << cosine;
      EXPECT_GE(back[0], 0.6f) << name << " at " << cosine;
    }
}

TEST(Materials, WhiteSheetAndPlasticKeepAllLight) {
  for (const double cosine : {1.0, 0.3}) {
    EXPECT_NEAR(furnace(*make_material(TranslucentSheet{.color = 0.6, .transmission = 0.4}), cosine)[1], 1, 1e-5);
    EXPECT_NEAR(furnace(*make_material(Plastic{.color = 1.0, .roughness = 0.3}), cosine)[1], 1, 3e-3);
  }
}

TEST(Materials, MixIsTheMeanOfBoth) {
  const MaterialPtr dark = make_material(Diffuse{.color = 0.2}), bright = make_material(Diffuse{.color = 0.8});
  EXPECT_NEAR(furnace(*make_material(Mix{dark, bright, 0.25}), 0.7)[0], 0.35, 1e-4);
  EXPECT_NEAR(classic_reading(*make_material(Mix{dark, bright, 0.25}), {}, {}).diffuse[0], 0.35, 1e-6);
  const MaterialPtr glass = make_material(Dielectric{});
  EXPECT_THROW(make_material(Mix{glass, glass, 0.5}), std::invalid_argument);
  EXPECT_TRUE(make_material(Mix{glass, dark, 0.5})->transmits());
}

TEST(Materials, MixKeepsTheAmbientLightOfClassicLooks) {
  const MaterialPtr look = make_material(ClassicLook{.color = 1.0, .ambient = 1.0, .diffuse = 0.0});
  const auto ambient = [](const MaterialPtr& first, const MaterialPtr& second) {
    return classic_reading(*make_material(Mix{first, second, 0.25}), {}, {}).ambient[0];
  };
  EXPECT_NEAR(ambient(look, look), 1, 1e-6);
  EXPECT_NEAR(ambient(look, make_material(Diffuse{.color = 0.2})), 0.75 + 0.25 * 0.2, 1e-6);
  const MaterialPtr metal = make_material(Conductor{.metal = "", .roughness = 0.6, .color = 0.5});
  EXPECT_NEAR(ambient(look, metal), 0.75 + 0.25 * classic_reading(*metal, {}, {}).ambient[0], 1e-6);
}

TEST(Materials, MixesThatCannotBeAreRefused) {
  const MaterialPtr dark = make_material(Diffuse{.color = 0.2}), catcher = make_material(ShadowCatcher{});
  EXPECT_THROW(make_material(Mix{catcher, dark, 0.5}), std::invalid_argument);
  EXPECT_THROW(make_material(Mix{dark, catcher, 0.5}), std::invalid_argument);
  Principled layered = white();
  layered.base_metalness = 0.5;
  layered.coat_weight = 0.5;
  layered.fuzz_weight = 0.5;
  const MaterialPtr four = make_material(layered);
  ASSERT_EQ(four->scattering({}, {}).lobes.size(), 4);
  const MaterialPtr eight = make_material(Mix{four, four, 0.0}), twelve = make_material(Mix{eight, four, 0.5});
  EXPECT_THROW(make_material(Mix{twelve, dark, 0.5}), std::invalid_argument);
}

TEST(Materials, MetalsKnowTheirMeanReflectance) {
  Principled principled;
  principled.base_metalness = 1;
  Wavelengths yellow;
  yellow.nanometres.fill(587.56f);
  for (const MaterialPtr& material : {make_material(Conductor{.metal = "Cu"}), make_material(principled),
                                      make_material(Conductor{.metal = "", .color = 0.5})})
    for (const Wavelengths& wavelengths : {Wavelengths(), yellow}) {
      const Scattering scattering = material->scattering({}, wavelengths);
      const auto& metal = std::get<MetalLobe>(scattering.lobes[0].lobe);
      EXPECT_EQ(metal.mean, metal.reflectance.mean());
    }
}

TEST(Materials, RoughnessFromATexture) {
  Plastic plastic;
  plastic.roughness.texture = make_texture(Checker{.color = 0.0, .background = 0.5});
  const MaterialPtr material = make_material(plastic);
  EXPECT_TRUE(material->uses_parameters());
  SurfacePoint point;
  point.u = point.v = 0.5;
  EXPECT_EQ(classic_reading(*material, point, {}).exponent, 1000);
  point.u = 1.5;
  EXPECT_NEAR(classic_reading(*material, point, {}).exponent, (1 / 0.0625 - 1) / 2, 1e-4);
}

TEST(Materials, PrincipledGlassAbsorbsAsItsDepthSays) {
  Principled p;
  p.transmission_weight = 1;
  p.transmission_color = Vec3(0.5, 0.25, 1);
  p.transmission_depth = 2;
  const auto medium = make_material(p)->interior({});
  ASSERT_TRUE(medium.has_value());
  EXPECT_NEAR(std::exp(-2 * medium->absorption[0]), 0.5, 1e-6);
  EXPECT_NEAR(std::exp(-2 * medium->absorption[1]), 0.25, 1e-6);
  EXPECT_EQ(medium->absorption[2], 0);
  p.base_metalness = 1;
  EXPECT_FALSE(make_material(p)->interior({}).has_value());
}

TEST(Materials, ThinPaneHasNoSubstance) {
  Dielectric pane;
  pane.thin = true;
  EXPECT_FALSE(make_material(pane)->interior({}).has_value());
  EXPECT_EQ(classic_reading(*make_material(pane), {}, {}).transmission, Spectrum(1, 1, 1));
}

}  // namespace

}  // namespace lekalo::render::materials_test
