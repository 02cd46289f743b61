// One wavelength for a path that glass splits by colour.
//
// A path in RGB carries all colours at once until it meets a substance whose index depends on the wavelength. There it
// takes one wavelength, by chance, and from there on stands for this one alone: its light counts with the share w of
// the wavelength in red, green and blue,
//
//   w_c(l) = m_c(l) / p(l),  m the CIE 1931 functions in linear Rec.709, each scaled to an integral of 1,
//
// p the density of the choice, as the sum of the CIE functions. The mean of w is white. Spectral colours are outside of
// Rec.709: some of w is negative.
#pragma once

#include "render/material.h"

namespace lekalo::render {

struct WavelengthSample {
  float nanometres;
  Spectrum share;  // w
};

// `random` in [0, 1).
WavelengthSample sample_wavelength(double random);

// True if the substance behind the surface bends colours differently.
bool disperses(const Material& material);

}  // namespace lekalo::render
