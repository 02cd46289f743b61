// Laws that every lobe obeys: no more light than falls on it, the same both ways, samples of the density that it says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "render/lobes/bsdf.h"
#include "render/lobes/fresnel.h"
#include "render/samplers/sampler.h"

namespace lekalo::render::lobes_test {

namespace {

using geometry::kPi;
using geometry::kTwoPi;

struct Subject {
  std::string name;
  Scattering scattering;
  Sides sides;
  double loss;  // of a white one, at most
};

const LobeAlbedo& kept(LobeAlbedoPtr albedo) {
  static std::vector<LobeAlbedoPtr> all;
  all.push_back(std::move(albedo));
  return *all.back();
}

Subject subject(std::string name, const Lobe& lobe, double loss, Sides sides = {}) {
  Subject s{std::move(name), {}, sides, loss};
  std::visit([&](const auto& one) { s.scattering.lobes.add(one); }, lobe);
  return s;
}

MetalLobe white_metal(double roughness, double anisotropy) {
  MetalLobe lobe;
  lobe.reflectance.color = Spectrum(1.0f);
  lobe.roughness = roughness;
  lobe.anisotropy = anisotropy;
  lobe.albedo = &kept(mirror_albedo(roughness, anisotropy));
  lobe.mean = lobe.reflectance.mean();
  return lobe;
}

ClearLobe glass(double roughness, bool thin = false) {
  ClearLobe lobe;
  lobe.roughness = roughness;
  lobe.thin = thin;
  return lobe;
}

// Under a film of water 300 nm thick.
ClearLobe filmed(ClearLobe lobe, double index) {
  static std::vector<FilmTablePtr> films;
  films.push_back(std::make_shared<FilmTable>(1.33, 300, 300, [index](double) { return std::complex<double>(index); }));
  lobe.film = films.back().get();
  lobe.thickness = 300;
  lobe.index = index;
  return lobe;
}

CoatedMattLobe white_plastic(double roughness) {
  CoatLobe coat = coat_lobe(1.5);
  coat.roughness = roughness;
  coat.albedo = &kept(coat_albedo(roughness, 1.5));
  return {Spectrum(1.0f), coat};
}

SheenLobe white_sheen(double roughness) {
  SheenLobe lobe;
  lobe.color = Spectrum(1.0f);
  lobe.roughness = roughness;
  lobe.albedo = &kept(sheen_albedo(roughness));
  return lobe;
}

// White ones of every kind. Rough clear boundaries lose the light of further bounces between their facets.
std::vector<Subject> subjects() {
  const Spectrum white(1.0f);
  std::vector<Subject> all{
      subject("lambert", LambertLobe{white}, 1e-3),
      subject("rough matt 0.5", RoughMattLobe{white, 0.5}, 1e-3),
      subject("rough matt 1", RoughMattLobe{white, 1}, 1e-3),
      subject("sheet", SheetLobe{Spectrum(0.7f), Spectrum(0.3f)}, 1e-3),
      subject("phong", PhongLobe{Spectrum(5.0f), 8}, 1),
      subject("boundary", BoundaryLobe{Spectrum(0.25f), Spectrum(0.75f), true}, 1e-3, {1, 1.5}),
      subject("smooth metal", white_metal(0, 0), 1e-3),
      subject("metal 0.3", white_metal(0.3, 0), 5e-3),
      subject("metal 0.6", white_metal(0.6, 0), 5e-3),
      subject("metal 1", white_metal(1, 0), 5e-3),
      subject("stretched metal", white_metal(0.5, 0.8), 5e-3),
      subject("smooth glass", glass(0), 1e-3, {1, 1.5}),
      subject("smooth glass, from inside", glass(0), 1e-3, {1.5, 1}),
      subject("rough glass", glass(0.4), 0.08, {1, 1.5}),
      subject("rough glass, from inside", glass(0.4), 0.25, {1.5, 1}),
      subject("very rough glass", glass(0.8), 0.4, {1, 1.5}),
      subject("thin pane", glass(0, true), 1e-3),
      subject("rough thin pane", glass(0.5, true), 0.2),
      subject("filmed glass", filmed(glass(0), 1.5), 1e-3, {1, 1.5}),
      subject("filmed glass, from inside", filmed(glass(0), 1.5), 1e-3, {1.5, 1}),
      subject("rough filmed glass", filmed(glass(0.4), 1.5), 0.08, {1, 1.5}),
      subject("rough filmed glass, from inside", filmed(glass(0.4), 1.5), 0.25, {1.5, 1}),
      subject("filmed pane", filmed(glass(0, true), 1.5), 1e-3),
      subject("soap film", filmed(glass(0, true), 1), 1e-3),
      subject("smooth plastic", white_plastic(0), 1e-3),
      subject("plastic 0.4", white_plastic(0.4), 1e-3),
      subject("plastic 1", white_plastic(1), 1e-3),
      subject("sheen", white_sheen(0.3), 1),
      subject("tidy sheen", white_sheen(0), 1),
      subject("untidy sheen", white_sheen(1), 1),
  };
  all.push_back({"cloth over matt", {}, {}, 0.2});
  all.back().scattering.lobes.add(RoughMattLobe{white, 0.3});
  all.back().scattering.lobes.cover(white_sheen(0.4), Spectrum(0.8f), kept(sheen_albedo(0.4)));
  all.push_back({"coat over metal", {}, {}, 0.2});
  all.back().scattering.lobes.add(white_metal(0.4, 0));
  const LobeAlbedo& coat = kept(coat_albedo(0.2, 1.5));
  CoatLobe lobe = coat_lobe(1.5);
  lobe.roughness = 0.2;
  lobe.albedo = &coat;
  all.back().scattering.lobes.cover(lobe, white, coat);
  return all;
}

Vec3 viewer(double cosine) {
  return {std::sqrt(1 - cosine * cosine) * 0.8, std::sqrt(1 - cosine * cosine) * 0.6, cosine};
}

Bsdf bsdf(const Subject& s, const Vec3& out) {
  return Bsdf(s.scattering, {0, 0, 1}, {0, 0, 1}, {1, 0, 0}, out, s.sides);
}

struct Mean {
  double mean, error;
};

// The light of a white furnace that the viewer gets, by samples.
Mean furnace(const Subject& s, const Vec3& out, int count) {
  const Bsdf f = bsdf(s, out);
  double sum = 0, squares = 0;
  for (int i = 0; i < count; ++i) {
    SampleStream random(1, 2, i, count, 3);
    const Vec2 choice = random.next_sobol_pair(), square = random.next_sobol_pair();
    const auto taken = f.sample(choice, square);
    const double value = taken ? taken->share[1] : 0;
    sum += value;
    squares += value * value;
  }
  const double mean = sum / count;
  return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean) / count)};
}

TEST(Lobes, WhiteFurnaceGainsNothingAndLosesWhatIsListed) {
  for (const Subject& s : subjects())
    for (const double cosine : {1.0, 0.8, 0.5, 0.2, 0.05}) {
      const Mean light = furnace(s, viewer(cosine), 1 << 14);
      // Sobol's samples are farther below their standard error than by this factor.
      EXPECT_LE(light.mean, 1 + 1e-3 + 3 * light.error / 8) << s.name << " at " << cosine;
      EXPECT_GE(light.mean, 1 - s.loss - 3 * light.error / 8) << s.name << " at " << cosine;
    }
}

TEST(Lobes, AreReciprocal) {
  // With radiance over the square of the index f is the same both ways but for those squares.
  for (const Subject& s : subjects())
    for (int i = 0; i < 50; ++i) {
      SampleStream random(5, 6, i, 1, 7);
      const Vec3 a = cosine_direction(random.next_pair());
      Vec3 b = cosine_direction(random.next_pair());
      if (a.z < 0.05 || b.z < 0.05) continue;
      const double there = bsdf(s, a).evaluate(b)[0] / b.z, back = bsdf(s, b).evaluate(a)[0] / a.z;
      if (s.scattering.unbalanced) continue;
      EXPECT_NEAR(there, back, 1e-5 * std::max(1.0, there)) << s.name;
      b.z = -b.z;
      const double through = bsdf(s, a).evaluate(b)[0] / -b.z;
      Subject behind = s;
      std::swap(behind.sides.near, behind.sides.behind);
      const double from_behind = bsdf(behind, Vec3(b.x, b.y, -b.z)).evaluate(Vec3(a.x, a.y, -a.z))[0] / a.z;
      const double n0 = s.sides.near, n1 = s.sides.behind;
      EXPECT_NEAR(through / (n1 * n1), from_behind / (n0 * n0), 1e-5 * std::max(1.0, through)) << s.name;
    }
}

// Integral of the density over a cell of the grid of directions, z and the angle about it.
double cell_share(const Bsdf& f, double z0, double z1, double a0, double a1) {
  constexpr int kN = 24;
  double sum = 0;
  for (int i = 0; i < kN; ++i)
    for (int j = 0; j < kN; ++j) {
      const double z = z0 + (z1 - z0) * (i + 0.5) / kN, a = a0 + (a1 - a0) * (j + 0.5) / kN;
      const double r = std::sqrt(std::max(0.0, 1 - z * z));
      sum += f.density({r * std::cos(a), r * std::sin(a), z});
    }
  return sum * (z1 - z0) * (a1 - a0) / (kN * kN);
}

TEST(Lobes, SamplesHaveTheirDensity) {
  // Pearson's chi-square over cells of directions; what is sharp or brings nothing is one cell more.
  constexpr int kHeights = 10, kAngles = 12, kSamples = 40000;
  int tests = 0;
  for (const Subject& s : subjects())
    for (const double cosine : {0.9, 0.35}) {
      const Bsdf f = bsdf(s, viewer(cosine));
      std::vector<double> expected(2 * kHeights * kAngles), counted(expected.size());
      double all = 0;
      for (int i = 0; i < 2 * kHeights; ++i)
        for (int j = 0; j < kAngles; ++j) {
          const double share = cell_share(f, -1 + i / double(kHeights), -1 + (i + 1) / double(kHeights),
                                          kTwoPi * j / kAngles, kTwoPi * (j + 1) / kAngles);
          expected[i * kAngles + j] = share * kSamples;
          all += share;
        }
      EXPECT_LE(all, 1.003) << s.name;
      double others = 0;
      for (int i = 0; i < kSamples; ++i) {
        SampleStream random(8, 9, i, 1, 10);  // independent ones
        const Vec2 choice = random.next_pair(), square = random.next_pair();
        const auto taken = f.sample(choice, square);
        if (!taken || taken->sharp) {
          ++others;
          continue;
        }
        EXPECT_NEAR(taken->density, f.density(taken->in), 1e-9 * taken->density);
        const int row = std::clamp(static_cast<int>((taken->in.z + 1) * kHeights), 0, 2 * kHeights - 1);
        const double angle = std::atan2(taken->in.y, taken->in.x);
        const int column =
            std::clamp(static_cast<int>((angle < 0 ? angle + kTwoPi : angle) / kTwoPi * kAngles), 0, kAngles - 1);
        ++counted[row * kAngles + column];
      }
      double chi = 0, few_expected = std::max(0.0, kSamples * (1 - all)), few_counted = others;
      int cells = 0;
      for (size_t i = 0; i < expected.size(); ++i) {
        if (expected[i] < 10) {
          few_expected += expected[i], few_counted += counted[i];
          continue;
        }
        chi += (counted[i] - expected[i]) * (counted[i] - expected[i]) / expected[i];
        ++cells;
      }
      if (few_expected >= 10) {
        chi += (few_counted - few_expected) * (few_counted - few_expected) / few_expected;
        ++cells;
      }
      ++tests;
      if (cells < 2) continue;
      // Wilson and Hilferty: (chi / k)^(1/3) is normal. 4.5 deviations are 3e-6, 2e-4 over all tests.
      const double k = cells - 1;
      const double normal = (std::cbrt(chi / k) - (1 - 2 / (9 * k))) / std::sqrt(2 / (9 * k));
      EXPECT_LT(normal, 4.5) << s.name << " at " << cosine << ": " << chi << " of " << k;
    }
  EXPECT_EQ(tests, 2 * static_cast<int>(subjects().size()));
}

TEST(Lobes, SheenIsAsImportantAsTheLightItSendsBack) {
  for (const double cosine : {1.0, 0.5, 0.2}) {
    const Subject s = subject("sheen", white_sheen(0.3), 1);
    EXPECT_NEAR(white_sheen(0.3).importance(viewer(cosine), {}), furnace(s, viewer(cosine), 1 << 12).mean, 0.01);
  }
}

TEST(Lobes, MeanReflectanceOfFresnel) {
  // 2 times the integral of F cos d cos at index 1.5 is 0.0918 (Egan and Hilgeman 1973).
  EXPECT_NEAR(coat_albedo(0, 1.5)->mean(), 0.0918, 1e-4);
  EXPECT_NEAR(coat_albedo(0, 1.5)->at({0, 0, 1}), 0.04, 1e-6);
  EXPECT_NEAR(coat_albedo(0, 1.5)->at({std::sqrt(0.75), 0, 0.5}), fresnel_dielectric(0.5, 1, 1.5), 1e-3);
}

TEST(Lobes, SchlickMetalHasItsColours) {
  MetalReflectance metal;
  metal.color = Spectrum(0.9f, 0.5f, 0.1f);
  metal.edge_tint = Spectrum(1.0f);
  EXPECT_NEAR(metal.at(1)[1], 0.5, 1e-6);
  EXPECT_NEAR(metal.at(0)[1], 1, 1e-6);
  EXPECT_NEAR(metal.at(0.5)[2], 0.1 + 0.9 / 32, 1e-6);
  metal.edge_tint = Spectrum(0.5f);
  const double at_82 = 0.5 + 0.5 * std::pow(6.0 / 7, 5);  // cos of 82 degrees is about 1/7
  EXPECT_NEAR(metal.at(1.0 / 7)[1], 0.5 * at_82, 1e-6);
}

TEST(Lobes, MeanOfATintedMetalIsTheIntegral) {
  MetalReflectance metal;
  metal.color = Spectrum(0.9f, 0.5f, 0.1f);
  metal.edge_tint = Spectrum(1.0f, 0.5f, 0.7f);
  constexpr int kN = 2000;
  Vec3 sum(0);
  for (int i = 0; i < kN; ++i) {
    const double c = (i + 0.5) / kN;
    for (int lane = 0; lane < 3; ++lane) sum[lane] += 2 * c / kN * metal.at(c)[lane];
  }
  for (int lane = 0; lane < 3; ++lane) EXPECT_NEAR(metal.mean()[lane], sum[lane], 1e-6) << lane;
}

}  // namespace

}  // namespace lekalo::render::lobes_test
