// Light of single wavelengths, and what colour it is.
//
// Spectral rendering counts light as a multiple of the white D65: where that sends out the power W(l), a lane of the
// value v at the wavelength l stands for v W(l). So white light is 1 in all lanes, and a grey scene is the same in each
// of them as in RGB. A lane's colour is
//
//   w_c(l) = r_c(l) / p(l),   r_c = W m_c, scaled to an integral of 1,  c red, green, blue,
//
// m the CIE 1931 functions in linear Rec.709, p the density of the choice of wavelengths, as |r_R| + |r_G| + |r_B|.
// The mean of w is white. Spectral colours are outside of Rec.709: some of w is negative.
//
// A path takes four wavelengths, a quarter of the choice apart, of which the first one, the hero, decides where colours
// part (Wilkie et al., "Hero wavelength spectral sampling", 2014).
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "render/spectrum.h"

namespace lekalo::render {

struct WavelengthSample {
  float nanometres;
  Spectrum share;  // w
};

// `random` in [0, 1); wavelengths rise with it.
WavelengthSample sample_wavelength(double random);

struct HeroWavelengths {
  Wavelengths wavelengths;
  std::array<Spectrum, 4> shares;  // w / 4 of each lane

  // Linear Rec.709 of light in these lanes.
  Spectrum color(const Spectrum& light) const {
    Spectrum sum;
    for (int i = 0; i < 4; ++i) sum += light[i] * shares[static_cast<size_t>(i)];
    return sum;
  }
};

HeroWavelengths hero_wavelengths(double random);

// True for four wavelengths that all differ; those that stand for red, green and blue, or for all of the light, do not.
inline bool is_spectral(const Wavelengths& wavelengths) {
  return wavelengths.nanometres[1] != wavelengths.nanometres[3];
}

// 1 in all lanes that are used: four, or red, green and blue.
inline Spectrum whole(const Wavelengths& wavelengths) {
  return is_spectral(wavelengths) ? Spectrum(1.0f) : Spectrum(1, 1, 1);
}

// r_c at the entries of the tables (observer.h).
const std::vector<Vec3>& white_response();
// Linear Rec.709 of a spectrum that is given as a multiple of D65.
Vec3 color_of(const std::function<double(double nanometres)>& multiple);

}  // namespace lekalo::render
