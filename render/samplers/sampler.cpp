#include "render/samplers/sampler.h"

#include <algorithm>
#include <array>
#include <bit>
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

// Sample `i` of `count` >= 2 of a correlated multi-jittered pattern (Kensler 2013): one sample in each of `count`
// strips either way, and one in each cell of a near-square grid.
Vec2 multi_jittered(uint32_t i, uint32_t count, uint64_t key) {
  constexpr double kBelowOne = 1 - 0x1p-53;
  const uint32_t columns = static_cast<uint32_t>(std::sqrt(static_cast<double>(count)));
  const uint32_t rows = (count + columns - 1) / columns;
  const uint32_t s = permuted(i, count, mix(key + 1));
  const uint32_t column = permuted(s % columns, columns, mix(key + 2));
  const uint32_t row = permuted(s / columns, rows, mix(key + 3));
  const double jitter_x = unit(mix(mix(key + 4) + s * kGolden));
  const double jitter_y = unit(mix(mix(key + 5) + s * kGolden));
  return {std::fmin((column + (row + jitter_x) / rows) / columns, kBelowOne),
          std::fmin((s + jitter_y) / count, kBelowOne)};
}

uint32_t reversed(uint32_t x) {
  x = (x >> 16) | (x << 16);
  x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
  x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
  return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

// Owen's scrambling in base 2: each bit is flipped or not by a hash of those above it (Laine and Karras 2011, with the
// constants of Burley 2020).
uint32_t scrambled(uint32_t x, uint32_t seed) {
  x = reversed(x);
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return reversed(x);
}

// Second dimension of Sobol's sequence, from the first, which is the reversed index. Its matrix is Pascal's modulo 2, a
// product of one step for each power of two.
uint32_t second_sobol(uint32_t x) {
  x ^= (x & 0x55555555u) << 1;
  x ^= (x & 0x33333333u) << 2;
  x ^= (x & 0x0f0f0f0fu) << 4;
  x ^= (x & 0x00ff00ffu) << 8;
  return x ^ (x << 16);
}

// The pixels that share a sequence are a square of 2^8 a side; with 2^16 samples each the sequence's 32 bits are full.
constexpr int kSquareBits = 8;
constexpr uint32_t kMaxInPicture = 1u << (32 - 2 * kSquareBits);

// Bits of the lower half moved apart: to the even places.
uint32_t spread(uint32_t x) {
  x = (x | x << 8) & 0x00ff00ffu;
  x = (x | x << 4) & 0x0f0f0f0fu;
  x = (x | x << 2) & 0x33333333u;
  return (x | x << 1) & 0x55555555u;
}

using Order = std::array<uint8_t, 4>;
constexpr std::array<Order, 24> kOrders = [] {
  std::array<Order, 24> orders{};
  Order order{0, 1, 2, 3};
  for (Order& one : orders) {
    one = order;
    std::next_permutation(order.begin(), order.end());
  }
  return orders;
}();

// The Morton code with the quarters of each square in a random order, which depends on the square.
uint32_t shuffled_morton(uint32_t code, uint64_t key) {
  uint32_t shuffled = 0, square = 1;
  for (int shift = 2 * (kSquareBits - 1); shift >= 0; shift -= 2) {
    const uint32_t quarter = code >> shift & 3;
    const Order& order = kOrders[(mix(key + square * kGolden) >> 32) * kOrders.size() >> 32];
    shuffled = shuffled << 2 | order[quarter];
    square = square << 2 | quarter;
  }
  return shuffled;
}

class StratifiedSampler final : public Sampler {
 public:
  StratifiedSampler(int samples, uint32_t seed) : samples_(samples), seed_(seed) {}

  int samples_per_pixel() const override { return samples_; }

  Vec2 pixel_position(uint32_t x, uint32_t y, int sample) const override {
    if (samples_ == 1) return {0.5, 0.5};
    return multi_jittered(sample, samples_, pixel_key(x, y, seed_));
  }

  SampleStream stream(uint32_t x, uint32_t y, int sample) const override {
    if (sample < samples_ && static_cast<uint32_t>(samples_) <= kMaxInPicture)
      return SampleStream::in_picture(x, y, sample, samples_, seed_);
    return SampleStream(x, y, sample, samples_, seed_);
  }

 private:
  int samples_;
  uint32_t seed_;
};

class ProgressiveSampler final : public Sampler {
 public:
  ProgressiveSampler(int samples, uint32_t seed) : samples_(samples), seed_(seed) {}

  int samples_per_pixel() const override { return samples_; }
  Vec2 pixel_position(uint32_t x, uint32_t y, int sample) const override {
    return SampleStream(x, y, static_cast<uint32_t>(sample), static_cast<uint32_t>(samples_), ~seed_).next_sobol_pair();
  }
  SampleStream stream(uint32_t x, uint32_t y, int sample) const override {
    return SampleStream(x, y, static_cast<uint32_t>(sample), static_cast<uint32_t>(samples_), seed_);
  }

 private:
  int samples_;
  uint32_t seed_;
};

}  // namespace

SampleStream::SampleStream(uint32_t x, uint32_t y, uint32_t sample, uint32_t count, uint32_t seed)
    : key_(mix(pixel_key(x, y, seed) + kGolden)), sequence_(key_), sample_(sample), count_(count) {}

SampleStream SampleStream::in_picture(uint32_t x, uint32_t y, uint32_t sample, uint32_t count, uint32_t seed) {
  constexpr uint32_t kWithin = (1u << kSquareBits) - 1;
  SampleStream stream(x, y, sample, count, seed);
  stream.sequence_ = mix(pixel_key(x >> kSquareBits, y >> kSquareBits, seed) + 2 * kGolden);
  stream.shares_sequence_ = true;
  stream.morton_ = spread(y & kWithin) << 1 | spread(x & kWithin);
  return stream;
}

Vec2 SampleStream::next_pair() {
  const uint64_t key = mix(key_ + ++dimension_ * kGolden);
  if (count_ > 1 && sample_ < count_) return multi_jittered(sample_, count_, key);
  return {unit(mix(key + (2 * static_cast<uint64_t>(sample_) + 1) * kGolden)),
          unit(mix(key + (2 * static_cast<uint64_t>(sample_) + 2) * kGolden))};
}

Vec2 SampleStream::next_sobol_pair() {
  const uint64_t key = mix(sequence_ + ++dimension_ * kGolden);
  uint32_t first;
  if (shares_sequence_) {
    // The samples of a pixel are shuffled by a hash of their own: that of scrambled() is too weak to part the orders of
    // two pairs all over a picture.
    const int bits = std::bit_width(count_ - 1);
    const uint32_t pixel = shuffled_morton(morton_, mix(key + 4));
    const uint32_t own = scrambled(sample_, static_cast<uint32_t>(mix(key + 5 + (uint64_t{morton_} + 1) * kGolden)));
    first = reversed(pixel << bits | (own & ((1u << bits) - 1)));
  } else {
    first = reversed(scrambled(sample_, static_cast<uint32_t>(mix(key + 1))));
  }
  const uint32_t x = scrambled(first, static_cast<uint32_t>(mix(key + 2)));
  const uint32_t y = scrambled(second_sobol(first), static_cast<uint32_t>(mix(key + 3)));
  return {x * 0x1p-32, y * 0x1p-32};
}

SamplerPtr make_progressive_sampler(int samples, uint32_t seed) {
  return std::make_shared<ProgressiveSampler>(samples, seed);
}

SamplerPtr make_stratified_sampler(int samples, uint32_t seed) {
  return std::make_shared<StratifiedSampler>(samples, seed);
}

}  // namespace lekalo::render
