// CSS colour names and hexadecimal colours: display (sRGB) values in linear Rec.709.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/vectors.h"

namespace lekalo::render {

// One channel of the sRGB transfer function undone (IEC 61966-2-1).
double linear_of_srgb(double value);

std::optional<geometry::Vec3> named_color(std::string_view name);  // CSS Color Module Level 4, lower case
std::optional<geometry::Vec3> hex_color(std::string_view text);    // #rgb or #rrggbb
const std::vector<std::string>& color_names();

}  // namespace lekalo::render
