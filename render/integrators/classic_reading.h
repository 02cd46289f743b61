// The lobes of a material as the coefficients of the classic light model (Golovanov 2016, 8.4.2-8.4.5). With r a lobe's
// roughness, n = (1/r^4 - 1)/2 within 1 to 1000 Phong's exponent, s = (1 - 4 r^2)^2 up to r = 0.5 and then 0, F0 and F
// the reflectance at right and at the actual angle:
//
//   Lambert, rough matt   k_a = k_d = albedo
//   coat over a matt body k_a = k_d = albedo; k_s = F0 (n + 2)/2, at most 1; mirror = s F
//   coat                  k_s and mirror of it
//   metal                 k_a = (1 - s) F0; k_d = r k_a; k_s = F0 times (1 - s)(n + 2)/2, at most F0; mirror = s F
//   clear boundary        k_s = F0 (n + 2)/2, at most 1; k_t = 1 - F, mirror = F; of a thin pane F is 2 F / (1 + F)
//   matt sheet            k_a = k_d = reflectance
//   sheen                 nothing
//
// Phong's lobes and smooth boundaries are taken as they stand. Several lobes add up; the highlight has the exponent and
// the mirror the Fresnel's reflectance of the last of them.
#pragma once

#include "render/lobes/scattering.h"
#include "render/material.h"

namespace lekalo::render {

// How Fresnel's reflectance F of the boundary enters mirror and transmission.
enum class Fresnel {
  none,
  boundary,  // of the media on both sides: mirror + transmission F and transmission (1 - F)
  pane,      // of both faces of a pane of the given index, R = 2 F / (1 + F): mirror + transmission R and
             // transmission (1 - R)
  coat,      // of a clear coat of the given index over an opaque body: mirror F
  conductor  // of the complex index (index, extinction): mirror F
};

// Reflectances are in [0, 1].
struct ClassicCoefficients {
  Spectrum emission;      // radiance added whatever the light
  Spectrum ambient;       // k_a, multiplies the ambient light
  Spectrum diffuse;       // k_d (Lambert)
  Spectrum specular;      // k_s of the Phong lobe
  float exponent = 1;     // n of the Phong lobe
  Spectrum mirror;        // share of the traced mirror reflection
  Spectrum transmission;  // k_t, share of the traced refracted ray
  float spread = 0;       // n of the light k_t cos(beta)^n of lamps behind the surface; 0: none
  Fresnel fresnel = Fresnel::none;
  Spectrum index{1.0f};          // of panes, coats and conductors, at the wavelengths asked for
  Spectrum extinction;           // of conductors: imaginary part of the index
  bool two_sided = true;         // false: the back shows only emission and ambient light
  bool catches_shadows = false;  // shows the background, darkened where lights do not reach; not seen from behind
};

ClassicCoefficients classic_reading(const Scattering& scattering);
inline ClassicCoefficients classic_reading(const Material& material, const SurfacePoint& point,
                                           const Wavelengths& wavelengths) {
  return classic_reading(material.scattering(point, wavelengths));
}

}  // namespace lekalo::render
