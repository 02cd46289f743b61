// Colours mixed by noise: clouds, stone, marble, wear. In the space of the scene, or in the surface's parameters.
#include "render/textures/noise.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/describe.h"
#include "render/materials/textured_color.h"

namespace lekalo::render {

using namespace geometry;

namespace {

double smooth(double t) { return t * t * t * (t * (6 * t - 15) + 10); }

// Perlin's twelve gradients, to the middles of a cube's edges: the inner product with the way from the lattice point.
double slope(uint64_t hash, const Vec3& way) {
  const double u = (hash & 15) < 8 ? way.x : way.y;
  const double v = (hash & 15) < 4 ? way.y : ((hash & 13) == 12 ? way.x : way.z);
  return ((hash & 1) ? -u : u) + ((hash & 2) ? -v : v);
}

// Of the corners of a lattice cell, i + 2 j + 4 k for that at (i, j, k).
std::array<uint64_t, 8> corner_hashes(const Vec3& cell, uint64_t seed) {
  const auto with = [](uint64_t hash, double x) {
    return hash_combine(hash, static_cast<uint64_t>(static_cast<int64_t>(x)));
  };
  std::array<uint64_t, 8> hashes;
  for (int i = 0; i < 2; ++i) {
    const uint64_t x = with(seed, cell.x + i);
    for (int j = 0; j < 2; ++j) {
      const uint64_t xy = with(x, cell.y + j);
      for (int k = 0; k < 2; ++k) hashes[i + 2 * j + 4 * k] = with(xy, cell.z + k);
    }
  }
  return hashes;
}

}  // namespace

double gradient_noise(const Vec3& place, uint64_t seed) {
  constexpr double kFar = 0x1p52;  // beyond, places are whole
  if (!(std::max({std::fabs(place.x), std::fabs(place.y), std::fabs(place.z)}) < kFar)) return 0;
  const Vec3 cell = glm::floor(place), way = place - cell;
  const Vec3 w(smooth(way.x), smooth(way.y), smooth(way.z));
  const std::array<uint64_t, 8> hashes = corner_hashes(cell, seed);
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
    const double share = (i ? w.x : 1 - w.x) * (j ? w.y : 1 - w.y) * (k ? w.z : 1 - w.z);
    if (share > 0) sum += share * slope(hashes[corner], way - Vec3(i, j, k));
  }
  return std::clamp(sum, -1.0, 1.0);
}

double fractal_noise(const Vec3& place, int octaves, uint64_t seed) {
  double sum = 0, height = 1, heights = 0, scale = 1;
  for (int k = 0; k < octaves; ++k, height *= 0.5, scale *= 2) {
    sum += height * gradient_noise(scale * place, hash_combine(seed, static_cast<uint64_t>(k)));
    heights += height;
  }
  return sum / heights;
}

namespace {

enum class Pattern { clouds, veins, bands };

struct Noise {
  double size = 1;  // of the coarsest grains, > 0
  int octaves = 4;
  Pattern pattern = Pattern::clouds;
  Vec3 across{0, 0, 1};  // of bands, unit
  double swirl = 1;      // of bands, by how many of them they are bent
  int seed = 0;
  bool in_parameters = false;
  TexturedColor color = 0.0, background = 1.0;
};

class NoiseTexture final : public Texture {
 public:
  explicit NoiseTexture(const Noise& noise) : noise_(noise) {}

  Spectrum at(const SurfacePoint& point) const override {
    const auto share = static_cast<float>(share_at(point));
    return share * noise_.color.at(point) + (1 - share) * noise_.background.at(point);
  }
  uint64_t cell(const SurfacePoint& point) const override {
    return hash_combine(noise_.color.cell(point), noise_.background.cell(point));
  }

 private:
  // Of the colour; the rest is background.
  double share_at(const SurfacePoint& point) const {
    const Vec3 place = (noise_.in_parameters ? Vec3(point.u, point.v, 0) : point.position) / noise_.size;
    const double n = fractal_noise(place, noise_.octaves, static_cast<uint64_t>(noise_.seed));
    switch (noise_.pattern) {
      case Pattern::clouds:
        return std::clamp(0.5 + 0.8 * n, 0.0, 1.0);
      case Pattern::veins:
        return std::pow(1 - std::fabs(n), 10);
      case Pattern::bands:
        return 0.5 + 0.5 * std::sin(kTwoPi * (glm::dot(place, noise_.across) + noise_.swirl * n));
    }
    return 0;
  }

  Noise noise_;
};

}  // namespace

TypeDeclaration noise_type() {
  return declare(Category::texture, "noise",
                 "Two colours mixed at random, the same in every run: clouds and stains, veins of stone, bent bands.")
      .example("pattern: veins, size: 0.8, color: [0.25, 0.25, 0.3], background: 0.85")
      .field("size", length().positive(), "of the coarsest grains; of bands the distance from one to the next", "1")
      .field("octaves", integer().between(1, 12), "layers of grains, each half as large as the one before", "4")
      .field(
          "pattern", choice({"clouds", "veins", "bands"}),
          "clouds: as much of one colour as of the other; veins: thin lines of `color`; bands: layers across `across`",
          "clouds")
      .field("across", direction(), "of bands: the direction in which they follow one another", "z")
      .field("swirl", number().non_negative(), "of bands: how many of their distances they are bent by", "1")
      .field("seed", integer(), "another number gives other grains", "0")
      .field("place", choice({"space", "parameters"}),
             "space: as cut out of a block, in coordinates of the scene; parameters: in the surface's u and v", "space")
      .field("color", textured_color(), "of the veins, of one half of the clouds or bands", "black")
      .field("background", textured_color(), "the other colour", "white")
      .built_by([](const Fields& f) -> TexturePtr {
        Noise noise;
        noise.size = f.number("size");
        noise.octaves = f.integer("octaves");
        const std::string& pattern = f.text("pattern");
        noise.pattern = pattern == "clouds" ? Pattern::clouds : pattern == "veins" ? Pattern::veins : Pattern::bands;
        noise.across = f.vec3("across");
        noise.swirl = f.number("swirl");
        noise.seed = f.integer("seed");
        noise.in_parameters = f.text("place") == "parameters";
        noise.color = color_texture(f, "color");
        noise.background = color_texture(f, "background");
        return std::make_shared<NoiseTexture>(noise);
      });
}

}  // namespace lekalo::render
