// Areas and volumes by rules of few points on triangular cells of the parameter plane.
#include <fmt/format.h>

#include "command.h"
#include "geometry/queries/measures/triangle_cubature.h"
#include "measure.h"

namespace lekalo::command {

ordered_json cubature_of(const std::string& name, const render::Entity& entity, int points, double turn) {
  const double angle = turn * geometry::kPi / 180;
  ordered_json out{{"name", name}, {"points", points}, {"turn", turn}};
  if (const auto* body = std::get_if<geometry::BodyPtr>(&entity)) {
    const geometry::CellMeasures found = geometry::measure_on_triangles(**body, points, angle);
    out["cells"] = found.cells;
    out["area"] = found.area;
    if ((*body)->is_closed()) out["volume"] = found.volume;
  } else if (const auto* surface = std::get_if<geometry::SurfacePtr>(&entity)) {
    if (!(*surface)->bounded()) throw UsageError(fmt::format("the surface '{}' is unbounded", name));
    const geometry::CellMeasures found = geometry::measure_on_triangles(**surface, points, angle);
    out["cells"] = found.cells;
    out["area"] = found.area;
  } else {
    throw UsageError(fmt::format("'{}' is neither a surface nor a body", name));
  }
  return out;
}

void print_cubature(const ordered_json& found) {
  fmt::print("'{}' on {} triangles, {} points each\n", found["name"].get<std::string>(), found["cells"].get<size_t>(),
             found["points"].get<int>());
  for (const char* key : {"area", "volume"})
    if (found.contains(key)) fmt::print("{:<8} {:.17g}\n", key, found[key].get<double>());
}

}  // namespace lekalo::command
