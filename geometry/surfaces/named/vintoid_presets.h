// The collection of vintoids that have names, as formulas (Grezdov, Filippenko 2010, with the evolutions that the paper
// leaves out).
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "geometry/curves/named/preset_fields.h"

namespace lekalo::geometry {

// Formulas of the profile are of t, laws of u; both know the parameters. u runs from 0 to `to`.
struct VintoidPreset {
  std::string_view name;
  std::string_view x, y, from, until;  // the profile, distance and height, over t
  bool is_profile_closed;
  std::string_view distance, height, turn, scale_x, scale_y;
  std::string_view to;
  std::vector<PresetParameter> parameters;
};

std::span<const VintoidPreset> vintoid_presets();

}  // namespace lekalo::geometry
