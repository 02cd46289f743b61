#include "render/samplers/sampler.h"

#include <cmath>

namespace lekalo::render {

namespace {

// The finaliser of SplitMix64 (Steele, Lea, Flood 2014): a bijection of 64 bits without visible structure.
uint64_t mix(uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

constexpr uint64_t kGolden = 0x9e3779b97f4a7c15u;

double unit(uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

uint64_t pixel_key(uint32_t x, uint32_t y, uint32_t seed) {
  return mix(mix((static_cast<uint64_t>(y) << 32 | x) + kGolden) + (seed + 1) * kGolden);
}

// The place of i in a permutation of 0..length-1 chosen by the key: bijections of the next power of two, repeated until
// the result is in range (cycle walking).
uint32_t permuted(uint32_t i, uint32_t length, uint64_t key) {
  if (length <= 1) return 0;
  uint32_t mask = length - 1;
  mask |= mask >> 1, mask |= mask >> 2, mask |= mask >> 4, mask |= mask >> 8, mask |= mask >> 16;
  const uint32_t a = static_cast<uint32_t>(key), b = static_cast<uint32_t>(key >> 32);
  do {  // xor with the key, odd multiplication and xor-shift are each invertible modulo mask + 1
    i = (i ^ a) & mask;
    i = (i * 0xe170893du) & mask;
    i ^= (i & mask) >> 3;
    i = (i + b) & mask;
    i = (i * ((a >> 7) | 1)) & mask;
    i ^= (i & mask) >> 2;
    i = (i * 0x0929eb3fu) & mask;
    i ^= (i & mask) >> 4;
    i = (i + (b >> 9)) & mask;
    i = (i * 0xdc3d8495u) & mask;
    i ^= (i & mask) >> 1;
  } while (i >= length);
  return i;
}

class StratifiedSampler final : public Sampler {
 public:
  StratifiedSampler(int samples, uint32_t seed)
      : samples_(samples),
        seed_(seed),
        columns_(static_cast<uint32_t>(std::sqrt(static_cast<double>(samples)))),
        rows_((samples + columns_ - 1) / columns_) {}

  int samples_per_pixel() const override { return samples_; }

  Vec2 pixel_position(uint32_t x, uint32_t y, int sample) const override {
    if (samples_ == 1) return {0.5, 0.5};
    const uint64_t key = pixel_key(x, y, seed_);
    const uint32_t s = permuted(sample, samples_, mix(key + 1));
    const uint32_t column = permuted(s % columns_, columns_, mix(key + 2));
    const uint32_t row = permuted(s / columns_, rows_, mix(key + 3));
    const double jitter_x = unit(mix(mix(key + 4) + s * kGolden));
    const double jitter_y = unit(mix(mix(key + 5) + s * kGolden));
    return {std::fmin((column + (row + jitter_x) / rows_) / columns_, kBelowOne),
            std::fmin((s + jitter_y) / samples_, kBelowOne)};
  }

  SampleStream stream(uint32_t x, uint32_t y, int sample) const override { return SampleStream(x, y, sample, seed_); }

 private:
  static constexpr double kBelowOne = 1 - 0x1p-53;
  int samples_;
  uint32_t seed_, columns_, rows_;
};

}  // namespace

SampleStream::SampleStream(uint32_t x, uint32_t y, uint32_t sample, uint32_t seed)
    : key_(mix(pixel_key(x, y, seed) + (static_cast<uint64_t>(sample) + 1) * kGolden)) {}

double SampleStream::next() { return unit(mix(key_ + ++dimension_ * kGolden)); }

Vec2 SampleStream::next_pair() {
  const double first = next();
  return {first, next()};
}

SamplerPtr make_stratified_sampler(int samples, uint32_t seed) {
  return std::make_shared<StratifiedSampler>(samples, seed);
}

}  // namespace lekalo::render
