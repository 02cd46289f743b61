// Light and reflectance in four lanes, with the wavelengths they stand for passed along.
//
// In RGB rendering the first three lanes are linear Rec.709 red, green and blue, the fourth is unused (zero), and the
// wavelengths are the nominal ones of the primaries, which is all that dispersion formulas and metal tables need to
// know. No material or light knows which of the two it is working for.
#pragma once

#include <array>
#include <cmath>

#include "geometry/vectors.h"

namespace lekalo::render {

using geometry::Vec2;
using geometry::Vec3;

struct Spectrum {
  std::array<float, 4> lanes{};

  constexpr Spectrum() = default;
  explicit constexpr Spectrum(float all) : lanes{all, all, all, all} {}
  constexpr Spectrum(float a, float b, float c, float d = 0) : lanes{a, b, c, d} {}

  float& operator[](int i) { return lanes[i]; }
  float operator[](int i) const { return lanes[i]; }
  Spectrum& operator+=(const Spectrum& s) {
    for (int i = 0; i < 4; ++i) lanes[i] += s.lanes[i];
    return *this;
  }
  Spectrum& operator*=(const Spectrum& s) {
    for (int i = 0; i < 4; ++i) lanes[i] *= s.lanes[i];
    return *this;
  }
  Spectrum& operator*=(float s) {
    for (float& lane : lanes) lane *= s;
    return *this;
  }
  friend Spectrum operator+(Spectrum a, const Spectrum& b) { return a += b; }
  friend Spectrum operator*(Spectrum a, const Spectrum& b) { return a *= b; }
  friend Spectrum operator*(Spectrum a, float b) { return a *= b; }
  friend Spectrum operator*(float a, Spectrum b) { return b *= a; }
  friend Spectrum operator-(Spectrum a, const Spectrum& b) {
    for (int i = 0; i < 4; ++i) a.lanes[i] -= b.lanes[i];
    return a;
  }
  bool operator==(const Spectrum&) const = default;

  bool is_zero() const { return lanes[0] == 0 && lanes[1] == 0 && lanes[2] == 0 && lanes[3] == 0; }
  float largest() const { return std::fmax(std::fmax(lanes[0], lanes[1]), std::fmax(lanes[2], lanes[3])); }
  bool is_finite() const {
    return std::isfinite(lanes[0]) && std::isfinite(lanes[1]) && std::isfinite(lanes[2]) && std::isfinite(lanes[3]);
  }
};

// exp of each lane: exp(-mu l) is Bouguer's law (Golovanov 2016, 8.4).
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
