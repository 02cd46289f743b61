// Serpentines: what a section sweeps along a path (Grezdov, Filippenko 2010, "Serpentines"). A preset gives the path,
// the section and the laws, as far as they are not given; the rest is that of sweep_surface.
#include <algorithm>

#include "geometry/curves/analytic/formula_curve.h"
#include "geometry/describe.h"
#include "geometry/surfaces/named/serpentine_presets.h"

namespace lekalo::geometry {

TypeDeclaration sweep_surface_type();

namespace {

using Constants = std::vector<Expression::Constant>;

CurvePtr curve_of(std::array<std::string_view, 3> formulas, double until, bool closed, const char* field,
                  const Constants& constants) {
  if (!(until > 0)) throw FieldError(field, "the path has no length", "its numbers of turns and sizes are positive");
  const auto of_t = [&](std::string_view text) { return formula_of(std::string(text), {"t"}, constants); };
  const PointFormulas point({of_t(formulas[0]), of_t(formulas[1]), of_t(formulas[2])}, Coordinates::cartesian, {"t"});
  return std::make_shared<FormulaCurve>(point, Interval(0, until), closed);
}

std::any serpentine(const Fields& given) {
  const std::span<const SerpentinePreset> presets = serpentine_presets();
  const SerpentinePreset& preset = *chosen_preset(given, presets);
  const Constants constants = preset_constants(given, &preset, presets);
  Fields sweep = given;
  if (!given.has("path"))
    sweep.set("path", curve_of({preset.x, preset.y, preset.z}, preset_value(preset.until, constants),
                               preset.is_path_closed, "preset", constants));
  if (!given.has("section") && !given.has("sections"))
    sweep.set("section", curve_of({preset.section_x, preset.section_y, "0"}, kTwoPi, true, "preset", constants));
  const auto of_s = [&](std::string_view text) { return formula_of(std::string(text), {"s"}, constants); };
  if (!given.given("scale")) sweep.set("scale", std::vector<Expression>{of_s(preset.scale)});
  if (!given.given("twist")) sweep.set("twist", of_s(preset.twist));
  static const TypeDeclaration type = sweep_surface_type();
  return type.build(sweep);
}

}  // namespace

TypeDeclaration serpentine_type() {
  const std::span<const SerpentinePreset> presets = serpentine_presets();
  TypeDeclaration type =
      declare(Category::surface, "serpentine",
              fmt::format("Sweep along a path by a preset: coils, springs, bellows, ropes, garlands, knots. Path, "
                          "section and laws may be given in place of the preset's. Presets, and their parameters when "
                          "left out: {}.",
                          list_of_presets(presets)));
  type.field("preset", choice(preset_names(presets)), "gives path, section and laws, as far as they are not given");
  for (const std::string& name : parameter_names(presets))
    type.optional(name, number(), "of those presets that have it");
  for (Field field : sweep_surface_type().fields) {
    if (field.name == "path") field.required = false;
    type.fields.push_back(std::move(field));
  }
  return type.example("preset: coil").built_by(serpentine);
}

}  // namespace lekalo::geometry
