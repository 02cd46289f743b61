// Whether curves and surfaces are regular, and the cells of surfaces.
#include <fmt/format.h>

#include <cmath>

#include "command.h"
#include "geometry/queries/differential/regularity.h"
#include "geometry/queries/measures/cell_diameters.h"
#include "measure.h"

namespace lekalo::command {

namespace {

ordered_json regularity_of_curve(const geometry::Curve& curve) {
  const geometry::CurveRegularity found = geometry::regularity(curve);
  ordered_json out;
  out["regular"] = found.is_regular();
  out["pieces"] = found.pieces;
  out["least_speed"] = found.min_speed;
  out["curvature_bound"] = finite_or_null(found.curvature_bound);
  out["singular"] = found.singular;
  return out;
}

ordered_json regularity_of_surface(const geometry::Surface& surface) {
  const geometry::SurfaceRegularity found = geometry::regularity(surface);
  ordered_json out, singular = ordered_json::array();
  for (const geometry::Rectangle& part : found.singular)
    singular.push_back({{"u", range(part.u)}, {"v", range(part.v)}});
  out["regular"] = found.is_regular();
  out["least_area"] = found.min_area;
  out["singular"] = singular;
  return out;
}

const geometry::SurfacePtr& surface_named(const std::string& name, const render::Entity& entity) {
  const auto* surface = std::get_if<geometry::SurfacePtr>(&entity);
  if (!surface) throw UsageError(fmt::format("'{}' is not a surface", name));
  return *surface;
}

}  // namespace

ordered_json regularity(const std::string& name, const render::Entity& entity) {
  ordered_json out{{"name", name}};
  try {
    const auto* curve = std::get_if<geometry::CurvePtr>(&entity);
    out.update(curve ? regularity_of_curve(**curve) : regularity_of_surface(*surface_named(name, entity)));
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("'{}': {}", name, error.what()));
  }
  return out;
}

void print_regularity(const ordered_json& found) {
  const bool of_curve = found.contains("pieces");
  fmt::print("'{}' is {}\n", found["name"].get<std::string>(),
             found["regular"].get<bool>() ? "regular" : "not regular");
  if (of_curve) {
    fmt::print("smooth pieces      {}\n", found["pieces"].get<int>());
    if (found["regular"].get<bool>())
      fmt::print("least speed        {}\ncurvature at most  {}\n", digits(found["least_speed"].get<double>()),
                 digits(found["curvature_bound"].get<double>()));
    for (const auto& t : found["singular"]) fmt::print("singular           t = {}\n", digits(t.get<double>()));
    return;
  }
  if (found["regular"].get<bool>()) fmt::print("|r_u x r_v| at least {}\n", digits(found["least_area"].get<double>()));
  for (const auto& part : found["singular"])
    fmt::print("singular           u = {} to {}, v = {} to {}\n", digits(part["u"][0].get<double>()),
               digits(part["u"][1].get<double>()), digits(part["v"][0].get<double>()),
               digits(part["v"][1].get<double>()));
}

ordered_json cells_of(const std::string& name, const render::Entity& entity, const std::vector<double>& counts,
                      const std::vector<double>& line) {
  const geometry::Surface& surface = *surface_named(name, entity);
  for (const double count : counts)
    if (!(count >= 1 && count <= 1000 && count == std::nearbyint(count)))
      throw UsageError("--cells takes two whole numbers from 1 to 1000");
  const int u = static_cast<int>(counts[0]), v = static_cast<int>(counts[1]);
  ordered_json out;
  try {
    const geometry::CellDiameters cells = geometry::cell_diameters(surface, u, v);
    out = {{"name", name},
           {"cells", {u, v}},
           {"cell_diameter", cells.largest},
           {"chain", cells.chain},
           {"diameter", cells.bound()}};
    if (line.empty()) return out;
    const geometry::Line ray{{line[0], line[1], line[2]}, {line[3], line[4], line[5]}};
    if (!(glm::length(ray.direction) > 0)) throw UsageError("--line has no direction");
    const double distance = geometry::farthest_node(surface, u, v, ray);
    out["node_distance"] = distance;
    out["misses"] = geometry::surely_misses(cells, distance);
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("'{}': {}", name, error.what()));
  }
  return out;
}

void print_cells(const ordered_json& found) {
  fmt::print("'{}' in {} x {} cells\n", found["name"].get<std::string>(), found["cells"][0].get<int>(),
             found["cells"][1].get<int>());
  fmt::print("diameter of a cell at most  {}\nof the surface at most      {}, over chains of {} cells\n",
             digits(found["cell_diameter"].get<double>()), digits(found["diameter"].get<double>()),
             found["chain"].get<int>());
  if (found.contains("misses"))
    fmt::print("farthest node from the line {}: {}\n", digits(found["node_distance"].get<double>()),
               found["misses"].get<bool>() ? "the line misses the surface" : "the diameters tell nothing of the line");
}

}  // namespace lekalo::command
