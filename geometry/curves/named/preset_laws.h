// Which presets are rational curves.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "geometry/curves/analytic/rational_form.h"

namespace lekalo::geometry {

// Of a preset with these values of its parameters, and `turns`, the least number q of turns that b/a = p/q needs, where
// it has them; nothing where it is not rational.
std::optional<RationalLaw> rational_law(std::string_view preset, std::span<const Expression::Constant> constants);

}  // namespace lekalo::geometry
