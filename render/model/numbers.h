// Numbers as texts of drawings.
#pragma once

#include <string>
#include <vector>

namespace lekalo::render {

// As TeX within a formula: 2.5\cdot 10^{-7}; of the digits 1 the power alone.
std::string times_power_of_ten(const std::string& digits, int power);

// The numbers of an axis or a scale, TeX: at least so many digits, and as many as tell each from its neighbours; zeros
// at the end left out. All large or all small ones have the same power of ten.
std::vector<std::string> numbers_of_scale(const std::vector<double>& values, int digits);

}  // namespace lekalo::render
