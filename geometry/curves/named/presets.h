// The collection of plane curves that have names, as formulas (Grezdov, Filippenko 2010; Lawrence 1972).
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "geometry/curves/named/preset_fields.h"

namespace lekalo::geometry {

// Formulas are of t and the parameters. Rows of one name are tried in order: the first whose condition holds is taken.
struct Preset {
  std::string_view name;
  Coordinates coordinates;  // cartesian x, y; cylindrical distance, angle
  std::string_view first, second;
  std::vector<PresetParameter> parameters;
  std::string_view from, to;          // the domain when none is given: a full trace, or short of asymptotes
  bool is_closed;                     // over that domain
  std::string_view condition = {};    // of the parameters, empty for none
  std::string_view expectation = {};  // what to say where none of the conditions holds
  std::string_view exponent = {};     // of the parameters: a number that formulas call `exponent`
  // Its domain needs `period`: 2 pi q, where b/a = p/q in lowest terms.
  bool rolls = false;
};

std::span<const Preset> presets();

}  // namespace lekalo::geometry
