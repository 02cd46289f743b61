// Sheets: the rim of one that may overlap itself; by how much a surface stretches that is laid on another.
#include <fmt/format.h>

#include <stdexcept>

#include "command.h"
#include "geometry/queries/differential/stretch.h"
#include "geometry/queries/intersections/sheet_rim.h"
#include "measure.h"

namespace lekalo::command {

namespace {

ordered_json row_of(const geometry::Stretch& stretch) {
  return {{"stretch", stretch.value}, {"strain", stretch.strain()}, {"u", stretch.u}, {"v", stretch.v}};
}

}  // namespace

ordered_json rim_of(const std::string& name, const render::Entity& entity, const std::vector<double>& chord,
                    const render::Entity* along) {
  const auto* curve = std::get_if<geometry::CurvePtr>(&entity);
  const auto* secant = along ? std::get_if<geometry::CurvePtr>(along) : nullptr;
  if (!curve || (along && !secant)) throw UsageError(fmt::format("'{}': --rim and --secant take curves", name));
  try {
    std::optional<std::pair<double, double>> ends;
    if (!chord.empty()) ends = {chord[0], chord[1]};
    const geometry::SheetRim found = geometry::sheet_rim(**curve, ends, secant ? secant->get() : nullptr);
    ordered_json out{{"name", name},
                     {"kind", "curve"},
                     {"turning_number", found.turning_number},
                     {"crossings", found.crossings},
                     {"rim", found.is_rim}};
    if (found.is_connected) out["connected"] = *found.is_connected;
    return out;
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("'{}': {}", name, error.what()));
  }
}

void print_rim(const ordered_json& found) {
  fmt::print("curve '{}' is {}the rim of a sheet\n", found["name"].get<std::string>(),
             found["rim"].get<bool>() ? "" : "not ");
  fmt::print("turning number     {}\ncrossings          {}\n", found["turning_number"].get<int>(),
             found["crossings"].get<int>());
  if (found.contains("connected"))
    fmt::print("the chord is {}one line on the sheet\n", found["connected"].get<bool>() ? "" : "not ");
}

ordered_json stretch_of(const std::string& name, const render::Entity& entity, const std::string& other_name,
                        const render::Entity& other, int samples) {
  const auto *from = std::get_if<geometry::SurfacePtr>(&entity), *to = std::get_if<geometry::SurfacePtr>(&other);
  if (!from || !to) throw UsageError(fmt::format("'{}' is no surface: --stretch takes two", from ? other_name : name));
  try {
    const geometry::Stretches found = geometry::stretches(**from, **to, samples);
    return {{"name", name}, {"to", other_name}, {"least", row_of(found.least)}, {"greatest", row_of(found.greatest)}};
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("'{}': {}", name, error.what()));
  }
}

void print_stretch(const ordered_json& found) {
  fmt::print("'{}' laid on '{}'\n", found["name"].get<std::string>(), found["to"].get<std::string>());
  for (const char* key : {"least", "greatest"})
    fmt::print("{:<9} stretch {}  strain {}  at u {}, v {}\n", key, digits(found[key]["stretch"].get<double>()),
               digits(found[key]["strain"].get<double>()), digits(found[key]["u"].get<double>()),
               digits(found[key]["v"].get<double>()));
}

}  // namespace lekalo::command
