// The magma colour map: perceptually even from black over purple and orange to pale yellow, readable by colour-blind
// people and in grey print (N. Smith, S. van der Walt, "A Better Default Colormap for Matplotlib", 2015; CC0).
#pragma once

#include <array>
#include <cstdint>

namespace lekalo::render {

// sRGB levels for a value in [0, 1] (others are clipped, NaN is the lowest): entry round(255 value) of the table.
std::array<std::uint8_t, 3> magma(double value);

}  // namespace lekalo::render
