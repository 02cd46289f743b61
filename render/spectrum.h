// Light and reflectance in four lanes, with the wavelengths they stand for passed along.
//
// In RGB rendering the first three lanes are linear Rec.709 red, green and blue, the fourth is unused (zero), and the
// wavelengths are the nominal ones of the primaries, which is all that dispersion formulas and metal tables need to
// know. No material or light knows which of the two it is working for.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#ifdef __SSE__
#include <xmmintrin.h>
#endif

#include "geometry/vectors.h"

namespace lekalo::render {

using geometry::Vec2;
using geometry::Vec3;

class Spectrum {
 public:
  constexpr Spectrum() : lanes_{0, 0, 0, 0} {}
  explicit constexpr Spectrum(float all) : lanes_{all, all, all, all} {}
  constexpr Spectrum(float a, float b, float c, float d = 0) : lanes_{a, b, c, d} {}

  float operator[](int i) const { return lanes_[i]; }
  void set(int i, float value) { lanes_[i] = value; }
  Spectrum& operator+=(const Spectrum& s) { return lanes_ += s.lanes_, *this; }
  Spectrum& operator*=(const Spectrum& s) { return lanes_ *= s.lanes_, *this; }
  Spectrum& operator*=(float s) { return lanes_ *= s, *this; }
  friend Spectrum operator+(Spectrum a, const Spectrum& b) { return a += b; }
  friend Spectrum operator*(Spectrum a, const Spectrum& b) { return a *= b; }
  friend Spectrum operator*(Spectrum a, float b) { return a *= b; }
  friend Spectrum operator*(float a, Spectrum b) { return b *= a; }
  friend Spectrum operator-(Spectrum a, const Spectrum& b) { return a.lanes_ -= b.lanes_, a; }
  bool operator==(const Spectrum& s) const {
#ifdef __SSE__
    return _mm_movemask_ps(lanes_ == s.lanes_) == 15;
#else
    const auto halves = std::bit_cast<std::array<int64_t, 2>>(lanes_ == s.lanes_);  // all bits of a lane that is equal
    return (halves[0] & halves[1]) == -1;
#endif
  }

  bool is_zero() const { return *this == Spectrum(); }
  float largest() const { return std::max(std::max(lanes_[0], lanes_[1]), std::max(lanes_[2], lanes_[3])); }
  bool is_finite() const { return *this - *this == Spectrum(); }

 private:
  // One register: GCC's and Clang's vector extension, on every processor.
  using Lanes = float __attribute__((vector_size(16)));
  Lanes lanes_;
};

// exp of each lane.
inline Spectrum exp(const Spectrum& s) { return {std::exp(s[0]), std::exp(s[1]), std::exp(s[2]), std::exp(s[3])}; }

// Linear Rec.709 colour as a spectrum of RGB rendering.
inline Spectrum rgb(const Vec3& color) {
  return {static_cast<float>(color.x), static_cast<float>(color.y), static_cast<float>(color.z)};
}
inline Vec3 rgb(const Spectrum& s) { return {s[0], s[1], s[2]}; }

// Wavelengths in nanometres of the four lanes.
struct Wavelengths {
  std::array<float, 4> nanometres{611.4f, 549.1f, 464.2f, 549.1f};  // dominant wavelengths of the Rec.709 primaries
};

}  // namespace lekalo::render
