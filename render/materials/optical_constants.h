// Measured optical constants: complex refractive indices of metals (tables) and indices of glasses, crystals and
// liquids (dispersion formulas). Data and their sources: data/SOURCES.md.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "render/spectrum.h"

namespace lekalo::render {

// Wavelength of the Fraunhofer line d (helium, yellow) in nanometres; catalogues give refractive indices for it.
inline constexpr float kLineD = 587.5618f;

struct ComplexIndex {
  Spectrum n;  // real part
  Spectrum k;  // extinction, >= 0
};

// Names that metal_index knows: chemical symbols, CuZn (brass, 70 % Cu) and CuZn_90_10 (tombac).
const std::vector<std::string>& metal_names();

// Complex index at the wavelengths, linear between the table's entries, constant beyond its ends.
// Throws std::invalid_argument for an unknown name.
ComplexIndex metal_index(std::string_view name, const Wavelengths& wavelengths);

// Names that dielectric_index knows: Schott glasses (N-BK7, ...), fused_silica, water, diamond, ...
const std::vector<std::string>& dielectric_names();

// Refractive index at a wavelength in nanometres by the substance's dispersion formula; wavelengths outside the
// formula's range of validity are moved to its end. Throws std::invalid_argument for an unknown name.
double dielectric_index(std::string_view name, double nanometres);

// Cauchy's formula n = a + b / l^2 for the index n_d of line d and the Abbe number (n_d - 1) / (n_F - n_C) > 0.
double cauchy_index(double index_d, double abbe, double nanometres);

}  // namespace lekalo::render
