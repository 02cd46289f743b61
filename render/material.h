// What a surface does to light: lobes (lobes/scattering.h), which each integrator reads in its own way. A material
// knows none of these.
#pragma once

#include <any>
#include <cstdint>
#include <memory>
#include <optional>

#include "render/ray.h"
#include "render/spectrum.h"

namespace lekalo::render {

struct Scattering;

// Substance behind a surface, for refraction and absorption.
struct Medium {
  float index = 1;      // refractive index at the first of the wavelengths asked for
  Spectrum absorption;  // mu of Bouguer's law, 1/length
  int priority = 0;     // of overlapping media the highest one counts; of equal ones the one entered last
  Spectrum scattering;  // mu_s, 1/length: light is scattered on its way; the classic model leaves it out
  float forward = 0;    // mean cosine g of the angle by which it is turned (Henyey and Greenstein 1941), in (-1, 1)

  Spectrum extinction() const { return absorption + scattering; }
};

class Material {
 public:
  virtual ~Material() = default;
  virtual Scattering scattering(const SurfacePoint& point, const Wavelengths& wavelengths) const = 0;
  // The medium behind the surface; opaque materials have none.
  virtual std::optional<Medium> interior(const Wavelengths&) const { return std::nullopt; }
  // True when light passes, so that shadow rays may be tinted instead of stopped.
  virtual bool transmits() const { return false; }
  // True if anything depends on the surface's parameters, or the directions in which they grow: textures, bumps.
  virtual bool uses_parameters() const { return true; }
  // Unit shading normal after bumps (random normal deviation of rough surfaces); the given one by default.
  virtual Vec3 shading_normal(const SurfacePoint& point) const { return point.normal; }
  // Diffuse reflectance for the albedo layer.
  virtual Spectrum albedo(const SurfacePoint& point, const Wavelengths& wavelengths) const;
  // Number of the texture cell (square of a checker, line or ground of a grid) at the point, so that comparisons can
  // leave out pixels on cell borders; 0 without textures.
  virtual uint64_t cell(const SurfacePoint&) const { return 0; }
  // The plain value of materials.h that it was made from, for exporters; empty for other classes.
  virtual std::any made_from() const { return {}; }
};
using MaterialPtr = std::shared_ptr<const Material>;

// Colour that varies over a surface: checker, grid lines, image.
class Texture {
 public:
  virtual ~Texture() = default;
  virtual Spectrum at(const SurfacePoint& point) const = 0;
  virtual uint64_t cell(const SurfacePoint&) const { return 0; }
  // The plain value of textures.h that it was made from, for exporters; empty for other classes.
  virtual std::any made_from() const { return {}; }
};
using TexturePtr = std::shared_ptr<const Texture>;

}  // namespace lekalo::render
