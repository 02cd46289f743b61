// What the fields and descriptions of types with presets have in common: a preset has a name and parameters with values
// for when they are left out; one field for each parameter that any preset has.
#pragma once

#include <fmt/format.h>

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/describe.h"
#include "geometry/expression/expression.h"
#include "geometry/point_formulas.h"

namespace lekalo::geometry {

struct PresetParameter {
  std::string_view name;
  double value;  // when left out
};

template <class Preset>
std::string parameters_of(const Preset& preset) {
  std::string text;
  for (const PresetParameter& p : preset.parameters)
    text += fmt::format("{}{} = {:.4g}", text.empty() ? "" : ", ", p.name, p.value);
  return text;
}

template <class Preset>
std::vector<std::string> preset_names(std::span<const Preset> presets) {
  std::vector<std::string> result;
  for (const Preset& preset : presets) result.emplace_back(preset.name);
  return result;
}

// "knot (a = 2, b = 0.3); screw (...)"
template <class Preset>
std::string list_of_presets(std::span<const Preset> presets) {
  std::string text;
  for (const Preset& preset : presets)
    text += fmt::format("{}{} ({})", text.empty() ? "" : "; ", preset.name, parameters_of(preset));
  return text;
}

template <class Preset>
std::set<std::string> parameter_names(std::span<const Preset> presets) {
  std::set<std::string> all;
  for (const Preset& preset : presets)
    for (const PresetParameter& p : preset.parameters) all.emplace(p.name);
  return all;
}

// The one that the field `preset` names; null without it.
template <class Preset>
const Preset* chosen_preset(const Fields& f, std::span<const Preset> presets) {
  if (!f.has("preset")) return nullptr;
  for (const Preset& preset : presets)
    if (preset.name == f.text("preset")) return &preset;
  return nullptr;
}

// Values of the preset's parameters, as given or its own. Throws FieldError for a parameter that it does not have.
template <class Preset>
std::vector<Expression::Constant> preset_constants(const Fields& f, const Preset* preset,
                                                   std::span<const Preset> presets) {
  std::vector<Expression::Constant> result;
  for (const std::string& name : parameter_names(presets)) {
    const PresetParameter* known = nullptr;
    for (size_t i = 0; preset && i < preset->parameters.size(); ++i)
      if (preset->parameters[i].name == name) known = &preset->parameters[i];
    if (f.has(name) && !known)
      throw FieldError(name,
                       preset ? fmt::format("'{}' has no parameter '{}'", preset->name, name)
                              : fmt::format("'{}' is a parameter of presets", name),
                       preset ? fmt::format("it has {}", parameters_of(*preset)) : "write the number into the laws");
    if (known) result.push_back({name, f.has(name) ? f.number(name) : known->value});
  }
  return result;
}

inline double preset_value(std::string_view text, std::span<const Expression::Constant> constants) {
  return formula_of(std::string(text), {}, constants)();
}

}  // namespace lekalo::geometry
