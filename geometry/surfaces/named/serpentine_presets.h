// The collection of serpentines that have names, as formulas (Grezdov, Filippenko 2010 lists tubes, coils, corrugated
// surfaces, garlands and knots, and gives no formulas).
#pragma once

#include "geometry/curves/named/preset_fields.h"

namespace lekalo::geometry {

// Formulas of path and section are of t, laws of s in 0..1, the fraction of the path's length; all know the parameters.
// The section is closed, t in 0..2 pi.
struct SerpentinePreset {
  std::string_view name;
  std::string_view x, y, z, until;  // the path from t = 0
  bool is_path_closed;
  std::string_view section_x, section_y;
  std::string_view scale, twist;
  std::vector<PresetParameter> parameters;
};

std::span<const SerpentinePreset> serpentine_presets();

}  // namespace lekalo::geometry
