// One wavelength for a path that glass splits by colour.
//
// A path in RGB carries all colours at once until it meets a substance whose index depends on the wavelength. There it
// takes one wavelength, by chance, and from there on stands for this one alone: its light counts with the share of the
// wavelength in red, green and blue (spectra/hero_wavelengths.h). A path that carries four wavelengths keeps the first
// of them there.
#pragma once

#include "render/material.h"
#include "render/spectra/hero_wavelengths.h"

namespace lekalo::render {

// True if the substance behind the surface bends colours differently.
bool disperses(const Material& material);

}  // namespace lekalo::render
