// A colour of a material or texture: the same everywhere, or from a texture.
#pragma once

#include <algorithm>
#include <string_view>

#include "geometry/describe.h"
#include "render/material.h"
#include "render/spectra/hero_wavelengths.h"
#include "render/spectra/upsampling.h"

namespace lekalo::render {

class TexturedColor {
 public:
  TexturedColor(double grey) : constant_(static_cast<float>(grey)) { constant_.set(3, 0); }
  TexturedColor(const Vec3& linear_rec709) : constant_(rgb(linear_rec709)) {}
  TexturedColor(TexturePtr texture) : texture_(std::move(texture)) {}

  Spectrum at(const SurfacePoint& point) const { return texture_ ? texture_->at(point) : constant_; }
  // The colour as a reflectance or as light at the wavelengths (spectra/upsampling.h).
  Spectrum at(const SurfacePoint& point, const Wavelengths& wavelengths) const {
    return upsampled_reflectance(at(point), wavelengths);
  }
  Spectrum light_at(const SurfacePoint& point, const Wavelengths& wavelengths) const {
    return upsampled_light(at(point), wavelengths);
  }
  // Each lane between 0 and 1, whatever a picture holds: for shares of two things.
  Spectrum share_at(const SurfacePoint& point, const Wavelengths& wavelengths) const {
    const Spectrum s = at(point);
    const auto share = [&](int lane) { return std::clamp(s[lane], 0.0f, 1.0f); };
    return upsampled_reflectance({share(0), share(1), share(2), share(3)}, wavelengths);
  }
  uint64_t cell(const SurfacePoint& point) const { return texture_ ? texture_->cell(point) : 0; }
  const TexturePtr& texture() const { return texture_; }
  bool is_black() const { return !texture_ && constant_.is_zero(); }

 private:
  Spectrum constant_;
  TexturePtr texture_;
};

// Mixes a number into a hash (of texture cells, of the tree of rays behind a sample).
constexpr uint64_t hash_combine(uint64_t hash, uint64_t value) {
  uint64_t z = hash * 0x9e3779b97f4a7c15u + value + 0x632be59bd9b4e019u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

// A colour field that accepts a texture in its place: Kind::color with Category::texture among its categories. The
// value is a Vec3 (linear Rec.709) or a TexturePtr.
geometry::FieldType textured_color();
// The same for reflectances and transmittances: values in [0, 1].
geometry::FieldType textured_share();

TexturedColor color_texture(const geometry::Fields& fields, std::string_view field);

// The per-direction field `spacing` of ruled lines: a number, or the word `none`, which is infinite.
Vec2 line_spacing(const geometry::Fields& fields);

}  // namespace lekalo::render
