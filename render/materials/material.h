// What a surface does to light. The `classic` integrator reads every material as the coefficients of Golovanov
// 2016, 8.4.
#pragma once

#include <memory>

#include "render/spectrum.h"
#include "render/trace/ray.h"

namespace lekalo::render {

// Coefficients of the classic light model at a point (Golovanov 2016, 8.4.2-8.4.5). Reflectances are in [0, 1].
struct ClassicCoefficients {
  Spectrum emission;       // radiance added whatever the light
  Spectrum ambient{1.0f};  // k_a, multiplies the ambient light
  Spectrum diffuse;        // k_d (Lambert)
  Spectrum specular;       // k_s of the Phong lobe
  float exponent = 1;      // n of the Phong lobe
  Spectrum mirror;         // share of the traced mirror reflection
  Spectrum transmission;   // k_t, share of the traced refracted ray
  bool fresnel = false;    // mirror and transmission are further weighted by Fresnel's factor
  Spectrum conductor_f0;   // for metals: reflectance at normal incidence when fresnel is set
};

// Substance behind a surface, for refraction and absorption.
struct Medium {
  float index = 1;      // refractive index at the wavelengths asked for
  Spectrum absorption;  // mu of Bouguer's law, 1/length
  int priority = 0;     // of overlapping media the highest one counts
};

class Material {
 public:
  virtual ~Material() = default;
  virtual ClassicCoefficients classic(const SurfacePoint& point, const Wavelengths& wavelengths) const = 0;
  // The medium behind the surface; opaque materials have none.
  virtual const Medium* interior() const { return nullptr; }
  // True when light passes, so that shadow rays may be tinted instead of stopped.
  virtual bool transmits() const { return false; }
  // Unit shading normal after bumps (random normal deviation of rough surfaces); the given one by default.
  virtual Vec3 shading_normal(const SurfacePoint& point) const { return point.normal; }
  // Diffuse reflectance for the albedo layer.
  virtual Spectrum albedo(const SurfacePoint& point, const Wavelengths& wavelengths) const {
    return classic(point, wavelengths).diffuse;
  }
};
using MaterialPtr = std::shared_ptr<const Material>;

// Colour that varies over a surface: constant, checker, grid lines, image.
class Texture {
 public:
  virtual ~Texture() = default;
  virtual Spectrum at(const SurfacePoint& point) const = 0;
};
using TexturePtr = std::shared_ptr<const Texture>;

}  // namespace lekalo::render
