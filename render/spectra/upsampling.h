// Spectra for colours: of the many that look the same one that is smooth.
#pragma once

#include <array>

#include "render/spectrum.h"

namespace lekalo::render {

// Reflectance S of a linear Rec.709 colour, each lane in [0, 1] (Jakob and Hanika, "A low-dimensional function space
// for efficient spectral upsampling", 2019):
//   S(l) = 1/2 + u / (2 sqrt(1 + u^2)),  u = c0 x^2 + c1 x + c2,  x = (l - 580 nm) / 200 nm,
// with the coefficients found by damped Gauss-Newton steps so that it has the colour under D65. Greys are the same at
// all wavelengths. Without spectral wavelengths the colour is returned as it is.
Spectrum upsampled_reflectance(const Spectrum& color, const Wavelengths& wavelengths);

// Light of a colour, lanes >= 0 without bound, as a multiple of D65: a reflectance of half its brightness, scaled.
// Absorption and scattering of substances, too.
Spectrum upsampled_light(const Spectrum& color, const Wavelengths& wavelengths);

// Light of any colour, lanes of either sign, as a sum of three fixed spectra at the wavelengths: the smoothest ones (of
// the least integral of the squared second derivative) whose colours are red, green and blue. Their sum is 1.
class LinearUpsampling {
 public:
  LinearUpsampling() = default;  // of RGB: light as it is
  explicit LinearUpsampling(const Wavelengths& wavelengths);
  Spectrum operator()(const Spectrum& color) const {
    return spectral_ ? color[0] * primaries_[0] + color[1] * primaries_[1] + color[2] * primaries_[2] : color;
  }

 private:
  bool spectral_ = false;
  std::array<Spectrum, 3> primaries_;
};

}  // namespace lekalo::render
