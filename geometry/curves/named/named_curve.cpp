// The type `named_curve`: a preset's formulas with its parameters put in.
#include <fmt/format.h>

#include <cmath>

#include "geometry/curves/analytic/formula_curve.h"
#include "geometry/curves/named/preset_laws.h"
#include "geometry/curves/named/presets.h"

namespace lekalo::geometry {

namespace {

using Constants = std::vector<Expression::Constant>;

constexpr int kMaxTurns = 1000;
constexpr double kWhole = 1e-9;

// Each name once, in the order of the collection.
std::vector<const Preset*> kinds() {
  std::vector<const Preset*> result;
  for (const Preset& preset : presets())
    if (result.empty() || result.back()->name != preset.name) result.push_back(&preset);
  return result;
}

std::vector<std::string> names() {
  std::vector<std::string> result;
  for (const Preset* preset : kinds()) result.emplace_back(preset->name);
  return result;
}

std::string list_of_presets() {
  std::string text;
  for (const Preset* preset : kinds())
    text += fmt::format("{}{} ({})", text.empty() ? "" : "; ", preset->name, parameters_of(*preset));
  return text;
}

// The least q with b/a = p/q; 0 where there is none.
int turns(double a, double b) {
  for (int q = 1; q <= kMaxTurns; ++q)
    if (std::abs(b / a * q - std::round(b / a * q)) <= kWhole) return q;
  return 0;
}

double period(int turns) {
  if (turns == 0)
    throw FieldError("domain", "the curve never closes: b/a is no fraction of small numbers", "give a domain of t");
  return kTwoPi * turns;
}

const Preset& chosen(const std::string& name, const Fields& f, Constants& constants) {
  const Preset* last = nullptr;
  for (const Preset& preset : presets()) {
    if (preset.name != name) continue;
    constants = preset_constants(f, &preset, presets());
    last = &preset;
    if (preset.condition.empty() || preset_value(preset.condition, constants) != 0) return preset;
  }
  throw FieldError("preset", fmt::format("the parameters make no '{}'", name), std::string(last->expectation));
}

FormulaCurve named_curve(const Fields& f) {
  Constants constants;
  const Preset& preset = chosen(f.text("preset"), f, constants);
  if (f.has("a") && f.number("a") == 0) throw FieldError("a", "the size of the curve is zero");
  const bool is_whole = !f.has("domain");
  const int turns_to_close = preset.rolls ? turns(constants[0].value, constants[1].value) : 1;
  constants.push_back({"turns", static_cast<double>(turns_to_close)});
  if (is_whole && preset.rolls) constants.push_back({"period", period(turns_to_close)});
  if (!preset.exponent.empty()) constants.push_back({"exponent", preset_value(preset.exponent, constants)});
  const Interval domain =
      is_whole ? Interval(preset_value(preset.from, constants), preset_value(preset.to, constants)) : f.range("domain");
  const auto of_t = [&](std::string_view text) { return formula_of(std::string(text), {"t"}, constants); };
  return FormulaCurve(PointFormulas({of_t(preset.first), of_t(preset.second), of_t("0")}, preset.coordinates, {"t"}),
                      domain, is_whole && preset.is_closed,
                      turns_to_close > 0 ? rational_law(preset.name, constants) : std::nullopt);
}

}  // namespace

TypeDeclaration named_curve_type() {
  TypeDeclaration type = declare(
      Category::curve, "named_curve",
      fmt::format("Plane curve of the collection of curves that have names; rational ones have an exact NURBS form. "
                  "Presets, and their parameters when left out: {}.",
                  list_of_presets()));
  type.field("preset", choice(names()), "which curve");
  for (const std::string& name : parameter_names(presets()))
    type.optional(name, number(), "of those presets that have it");
  return type
      .optional("domain", range(),
                "of the parameter t; when left out the whole curve, or a part short of its asymptotes")
      .example("preset: hypocycloid, a: 5, b: 2")
      .built_by([](const Fields& f) { return named_curve(f); });
}

}  // namespace lekalo::geometry
