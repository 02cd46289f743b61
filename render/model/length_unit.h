// What a scene unit is (info.unit).
#pragma once

#include <optional>
#include <string>

namespace lekalo::render {

// Millimetres of a unit of length by its usual name (um, mm, cm, dm, m, km, in, ft, yd); nothing for another text.
std::optional<double> millimetres_of(const std::string& unit);

}  // namespace lekalo::render
