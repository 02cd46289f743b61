// What the functions of formulas are, for manuals.
#pragma once

#include <string_view>
#include <vector>

namespace lekalo::geometry {

// "sin(x): sine of an angle, ...", one for each function.
std::vector<std::string_view> function_descriptions();

}  // namespace lekalo::geometry
