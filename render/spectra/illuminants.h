// Standard illuminants of the CIE, and black bodies.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lekalo::render {

// Names that illuminant_power knows: D65, D50, A, F2, F7, F11.
const std::vector<std::string>& illuminant_names();

// Relative spectral power at a wavelength, linear between the table's entries and constant beyond its ends. Throws
// std::invalid_argument for an unknown name. Data and their source: data/SOURCES.md.
double illuminant_power(std::string_view name, double nanometres);

// Spectral radiance of a black body of a temperature in kelvin > 0, relative to that at 560 nm (Planck's law):
// 1 / (l^5 (exp(c2 / (l T)) - 1)), c2 = 1.438777e7 nm K (CODATA 2018).
double black_body_power(double kelvin, double nanometres);

}  // namespace lekalo::render
