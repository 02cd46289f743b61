// A curve or surface against a table of points that something else computed at the same parameters.
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "command.h"
#include "geometry/surface.h"
#include "measure.h"

namespace lekalo::command {

namespace {

using geometry::Vec3;

constexpr size_t kShownPlaces = 10;

// Where the named columns stand; without a line of names they stand in this order. Further columns are not looked at.
std::vector<size_t> columns_of(const render::Table& table, const std::string& table_name,
                               const std::vector<std::string>& wanted) {
  std::vector<size_t> columns;
  for (const std::string& name : wanted) {
    const auto& names = table.columns;
    const size_t column = names.empty()
                              ? columns.size()
                              : static_cast<size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    if (column >= table.column_count || (names.empty() && table.column_count != wanted.size()))
      throw UsageError(fmt::format("{}: the table needs the columns {}", table_name, fmt::join(wanted, ", ")));
    columns.push_back(column);
  }
  return columns;
}

struct Place {
  size_t row;
  Vec3 table, here;
  double distance, step;  // step: largest difference of a coordinate
};

double largest(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

std::string vector_text(const ordered_json& v) { return digits(Vec3(v[0], v[1], v[2])); }

}  // namespace

ordered_json compare_with_table(const std::string& name, const render::Entity& entity, const render::Table& table,
                                const std::string& table_name, std::optional<double> tolerance) {
  const auto* curve = std::get_if<geometry::CurvePtr>(&entity);
  const auto* surface = std::get_if<geometry::SurfacePtr>(&entity);
  if (!curve && !surface)
    throw UsageError(fmt::format("'{}' is neither a curve nor a surface: a table of parameters cannot meet it", name));
  const std::vector<std::string> parameters =
      curve ? std::vector<std::string>{"t"} : std::vector<std::string>{"u", "v"};
  std::vector<std::string> wanted = parameters;
  wanted.insert(wanted.end(), {"x", "y", "z"});
  const std::vector<size_t> columns = columns_of(table, table_name, wanted);

  std::vector<Place> places;
  double size = 0, squares = 0;
  for (size_t row = 0; row < table.row_count(); ++row) {
    const auto at = [&](size_t k) { return table.at(row, columns[k]); };
    const size_t first = parameters.size();
    Place place{row, {at(first), at(first + 1), at(first + 2)}, {}, 0, 0};
    place.here = curve ? (*curve)->point(at(0)) : (*surface)->point(at(0), at(1));
    const Vec3 difference = place.here - place.table;
    const bool finite = std::isfinite(difference.x + difference.y + difference.z);
    place.distance = finite ? glm::length(difference) : geometry::kInfinity;
    place.step = finite ? largest(difference) : geometry::kInfinity;
    size = std::max(size, largest(place.table));
    squares += place.distance * place.distance;
    places.push_back(place);
  }
  // Units in the last place of the largest coordinate: near zero a coordinate's own ulps would say nothing.
  const double ulp = std::max(std::nextafter(size, geometry::kInfinity) - size, std::numeric_limits<double>::min());
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.distance > b.distance; });
  double worst_step = 0;
  for (const Place& place : places) worst_step = std::max(worst_step, place.step);

  ordered_json out;
  out["name"] = name;
  out["kind"] = curve ? "curve" : "surface";
  out["table"] = table_name;
  out["samples"] = places.size();
  out["maximum_distance"] = places.front().distance;
  out["rms_distance"] = std::sqrt(squares / static_cast<double>(places.size()));
  out["maximum_ulps"] = worst_step / ulp;
  out["ulp"] = ulp;
  if (tolerance) {
    out["tolerance"] = *tolerance;
    out["passed"] = places.front().distance <= *tolerance;
  }
  out["worst"] = ordered_json::array();
  for (size_t k = 0; k < std::min(places.size(), kShownPlaces); ++k) {
    const Place& place = places[k];
    ordered_json one;
    one["line"] = table.lines[place.row];
    for (size_t i = 0; i < parameters.size(); ++i) one[parameters[i]] = table.at(place.row, columns[i]);
    one["expected"] = to_json(place.table);
    one["point"] = to_json(place.here);
    one["distance"] = place.distance;
    one["ulps"] = place.step / ulp;
    out["worst"].push_back(std::move(one));
  }
  return out;
}

void print_comparison(const ordered_json& compared) {
  fmt::print("{} '{}' against {}: {} samples\n", compared["kind"].get<std::string>(),
             compared["name"].get<std::string>(), compared["table"].get<std::string>(),
             compared["samples"].get<size_t>());
  const bool judged = compared.contains("passed");
  fmt::print("largest distance {:.6g}, root mean square {:.6g}, largest difference of a coordinate {:.6g} ulps{}\n",
             compared["maximum_distance"].get<double>(), compared["rms_distance"].get<double>(),
             compared["maximum_ulps"].get<double>(),
             !judged                          ? ""
             : compared["passed"].get<bool>() ? ": passed"
                                              : fmt::format(": more than {:.6g}", compared["tolerance"].get<double>()));
  fmt::print("worst places:\n");
  for (const auto& place : compared["worst"]) {
    const std::string parameters = place.contains("t") ? "t " + digits(place["t"].get<double>())
                                                       : fmt::format("u {} v {}", digits(place["u"].get<double>()),
                                                                     digits(place["v"].get<double>()));
    fmt::print("  line {}: {}: distance {:.6g}, {:.6g} ulps\n    table {}\n    here  {}\n", place["line"].get<int>(),
               parameters, place["distance"].get<double>(), place["ulps"].get<double>(), vector_text(place["expected"]),
               vector_text(place["point"]));
  }
}

}  // namespace lekalo::command
