// Sample positions inside pixels and random numbers for a path, reproducible for any order of evaluation.
#pragma once

#include <cstdint>
#include <memory>

#include "render/spectrum.h"

namespace lekalo::render {

// Random numbers of one sample of one pixel: a function of (pixel, sample, dimension) and nothing else. The pairs that
// the samples 0..count-1 of a pixel draw in the same place of their paths are stratified together, like the positions
// in the pixel: penumbras get smooth with as many samples.
class SampleStream {
 public:
  SampleStream(uint32_t x, uint32_t y, uint32_t sample, uint32_t count, uint32_t seed);
  // The same, but for the pairs of next_sobol_pair(): one sequence serves the pixels of a square of 256 x 256 in a
  // shuffled Morton order, so that the samples of each square of 2 x 2, 4 x 4, ... pixels are even together, and the
  // error of what they show is blue noise (Ahmed, Wonka, "Screen-space blue-noise diffusion of Monte Carlo sampling
  // error via hierarchical ordering of pixels", 2020). sample < count <= 2^16; best for counts that are powers of two.
  static SampleStream in_picture(uint32_t x, uint32_t y, uint32_t sample, uint32_t count, uint32_t seed);
  Vec2 next_pair();  // uniform in [0, 1)^2
  // The same from Sobol's first two dimensions, shuffled and scrambled as Owen's (Burley, "Practical hash-based Owen
  // scrambling", 2020): evenest for counts that are powers of two.
  Vec2 next_sobol_pair();
  // As if so many pairs had been drawn.
  void skip_pairs(uint32_t n) { dimension_ += n; }

 private:
  uint64_t key_;       // of pixel and seed
  uint64_t sequence_;  // the same, or of square and seed where its pixels share a sequence
  bool shares_sequence_ = false;
  uint32_t morton_ = 0;  // code of the pixel in its square
  uint32_t sample_, count_;
  uint32_t dimension_ = 0;
};

class Sampler {
 public:
  virtual ~Sampler() = default;
  virtual int samples_per_pixel() const = 0;
  // Position of a sample (below samples_per_pixel) in its pixel, in [0, 1)^2; sample counts of 1 give the centre (0.5,
  // 0.5).
  virtual Vec2 pixel_position(uint32_t x, uint32_t y, int sample) const = 0;
  // Also for a sample beyond the pixel's own, which is drawn apart from them.
  virtual SampleStream stream(uint32_t x, uint32_t y, int sample) const = 0;
};
using SamplerPtr = std::shared_ptr<const Sampler>;

// Correlated multi-jittered samples (Kensler 2013): for any number of samples, one in each column and row strip and one
// in each cell of a near-square grid, shuffled differently in each pixel. samples >= 1. Up to 2^16 samples the streams
// are those of SampleStream::in_picture.
SamplerPtr make_stratified_sampler(int samples, uint32_t seed);

// Sobol's points, shuffled and scrambled as next_sobol_pair(): the first 16, 32, 64, ... are even in themselves, for
// pixels that may not take them all.
SamplerPtr make_progressive_sampler(int samples, uint32_t seed);

}  // namespace lekalo::render
