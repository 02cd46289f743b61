// Where curves and surfaces meet.
#include <fmt/format.h>

#include <stdexcept>

#include "command.h"
#include "geometry/queries/curve_intersections.h"
#include "measure.h"

namespace lekalo::command {

namespace {

using geometry::CurvePtr;
using geometry::Interval;
using geometry::SurfacePtr;
using geometry::Vec3;

template <class Meeting>
ordered_json meeting_row(ordered_json row, const Meeting& one) {
  row["point"] = to_json(one.point);
  row["distance"] = one.distance;
  row["contact"] = one.contact;
  return row;
}

ordered_json meetings(const geometry::Curve& a, const geometry::Curve& b, double tolerance) {
  const geometry::CurveMeetings found = intersect(a, b, tolerance);
  ordered_json points = ordered_json::array(), common = ordered_json::array();
  for (const geometry::CurveMeeting& one : found.points)
    points.push_back(meeting_row({{"t", one.s}, {"t_other", one.t}}, one));
  for (const geometry::CommonPart& part : found.common)
    common.push_back({{"t", range(part.s)}, {"t_other", {part.begin, part.end}}});
  return {{"points", points}, {"common", common}};
}

ordered_json meetings(const geometry::Curve& curve, const geometry::Surface& surface, double tolerance) {
  const geometry::SurfaceMeetings found = intersect(curve, surface, tolerance);
  ordered_json points = ordered_json::array(), common = ordered_json::array();
  for (const geometry::SurfaceMeeting& one : found.points)
    points.push_back(meeting_row({{"t", one.t}, {"u", one.u}, {"v", one.v}}, one));
  for (const Interval& part : found.on_surface) common.push_back({{"t", range(part)}});
  return {{"points", points}, {"common", common}};
}

}  // namespace

ordered_json intersections(const std::string& name, const render::Entity& entity, const std::string& other_name,
                           const render::Entity& other, double tolerance) {
  const auto* curve = std::get_if<CurvePtr>(&entity);
  const auto* other_curve = std::get_if<CurvePtr>(&other);
  const auto* surface = std::get_if<SurfacePtr>(&entity);
  const auto* other_surface = std::get_if<SurfacePtr>(&other);
  ordered_json out{{"name", name}, {"with", other_name}};
  try {
    ordered_json found;
    if (curve && other_curve)
      found = meetings(**curve, **other_curve, tolerance);
    else if (curve && other_surface)
      found = meetings(**curve, **other_surface, tolerance);
    else if (surface && other_curve)
      found = meetings(**other_curve, **surface, tolerance);
    else
      throw UsageError(fmt::format("'{}' and '{}': meetings are found of curves and surfaces", name, other_name));
    out.update(found);
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("'{}' with '{}': {}", name, other_name, error.what()));
  }
  return out;
}

void print_intersections(const ordered_json& found) {
  const size_t points = found["points"].size(), parts = found["common"].size();
  fmt::print("'{}' with '{}': {} point{}{}\n", found["name"].get<std::string>(), found["with"].get<std::string>(),
             points, points == 1 ? "" : "s",
             parts == 0 ? "" : fmt::format(", {} part{} in common", parts, parts == 1 ? "" : "s"));
  for (const ordered_json& one : found["points"])
    fmt::print("  {:<9}{}  point {}\n", one["contact"].get<bool>() ? "contact" : "crossing", parameter_text(one),
               digits(vector_of(one["point"])));
  for (const ordered_json& part : found["common"]) {
    fmt::print("  common   t {} to {}", digits(part["t"][0].get<double>()), digits(part["t"][1].get<double>()));
    if (part.contains("t_other"))
      fmt::print("  t_other {} to {}", digits(part["t_other"][0].get<double>()),
                 digits(part["t_other"][1].get<double>()));
    fmt::print("\n");
  }
}

}  // namespace lekalo::command
