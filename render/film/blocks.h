// What the samples of a pixel say together, and when a block of pixels has had enough of them.
#pragma once

#include <cmath>
#include <span>

#include "render/film/cryptomatte.h"
#include "render/film/tiles.h"

namespace lekalo::render {

// Pixels of a side of a block, which is sampled as one. Tiles are whole blocks.
inline constexpr int kBlockSize = 8;

// The window with all blocks of the picture that it touches.
inline Window whole_blocks(const Window& w) {
  const auto up = [](int v) { return (v + kBlockSize - 1) / kBlockSize * kBlockSize; };
  return {w.x0 / kBlockSize * kBlockSize, w.y0 / kBlockSize * kBlockSize, up(w.x1), up(w.y1)};
}

struct PixelRecord {
  int count = 0;  // of samples that are finite
  Vec3 sum{0}, squares{0};
  MatteCount objects, materials;

  void add(const Spectrum& radiance) {
    const Vec3 color = rgb(radiance);
    ++count;
    sum += color;
    squares += color * color;
  }
  // Of the mean, as if samples were drawn without regard to each other: even ones are less uncertain.
  Vec3 variance() const {
    if (count < 2) return Vec3(0);
    return glm::max(squares - sum * sum / static_cast<double>(count), Vec3(0)) / (count * (count - 1.0));
  }
  void clear() {
    count = 0;
    sum = squares = Vec3(0);
    objects.clear();
    materials.clear();
  }
};

// Standard error of pixels as displayed (gamma 2), of 1 between black and white: the root of the mean of its squares
// over pixels and colours. What is darker than kDark counts as that: nobody sees its noise.
inline double displayed_error(std::span<const PixelRecord> pixels) {
  constexpr double kDark = 0.01;
  double sum = 0;
  for (const PixelRecord& pixel : pixels) {
    const Vec3 variance = pixel.variance();
    for (int i = 0; i < 3; ++i) sum += variance[i] / (4 * std::max(kDark, pixel.sum[i] / std::max(pixel.count, 1)));
  }
  return std::sqrt(sum / (3 * static_cast<double>(pixels.size())));
}

}  // namespace lekalo::render
