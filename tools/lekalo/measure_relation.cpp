// Where a curve or surface is nearest to a point, and where curves and surfaces meet.
#include <fmt/format.h>

#include <stdexcept>

#include "command.h"
#include "geometry/queries/curve_intersections.h"
#include "geometry/queries/projection.h"
#include "measure.h"

namespace lekalo::command {

namespace {

using geometry::CurvePtr;
using geometry::FootKind;
using geometry::Interval;
using geometry::SurfacePtr;
using geometry::Vec3;

const char* word(FootKind kind) {
  switch (kind) {
    case FootKind::minimum:
      return "minimum";
    case FootKind::maximum:
      return "maximum";
    case FootKind::saddle:
      return "saddle";
    case FootKind::degenerate:
      return "degenerate";
    case FootKind::border:
      return "border";
  }
  return "";
}

ordered_json range(const Interval& x) { return ordered_json::array({x.lo, x.hi}); }

template <class Foot>
ordered_json foot_row(ordered_json row, const Foot& foot) {
  row["point"] = to_json(foot.point);
  row["distance"] = foot.distance;
  row["kind"] = word(foot.kind);
  return row;
}

ordered_json feet(const geometry::Curve& curve, const Vec3& point) {
  ordered_json out;
  const geometry::CurveFeet found = project(point, curve);
  out["distance"] = found.feet.front().distance;
  for (const geometry::CurveFoot& foot : found.feet) out["feet"].push_back(foot_row({{"t", foot.t}}, foot));
  for (const Interval& arc : found.arcs) out["arcs"].push_back(range(arc));
  return out;
}

ordered_json feet(const geometry::Surface& surface, const Vec3& point) {
  ordered_json out;
  const geometry::SurfaceFeet found = project(point, surface);
  out["distance"] = found.feet.front().distance;
  for (const geometry::SurfaceFoot& foot : found.feet)
    out["feet"].push_back(foot_row({{"u", foot.u}, {"v", foot.v}}, foot));
  for (const geometry::Rectangle& region : found.regions)
    out["regions"].push_back({{"u", range(region.u)}, {"v", range(region.v)}});
  return out;
}

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

std::string parameters(const ordered_json& row) {
  std::string text;
  for (const char* key : {"t", "t_other", "u", "v"})
    if (row.contains(key)) text += fmt::format("{}{} {:<20.17g}", text.empty() ? "" : " ", key, row[key].get<double>());
  return text;
}

Vec3 vector_of(const ordered_json& v) { return {v[0], v[1], v[2]}; }

}  // namespace

ordered_json distance_to_point(const std::string& name, const render::Entity& entity, const std::string& to,
                               const Vec3& point) {
  ordered_json out{{"name", name}};
  try {
    ordered_json found;
    if (const auto* curve = std::get_if<CurvePtr>(&entity)) {
      out["kind"] = "curve";
      found = feet(**curve, point);
    } else if (const auto* surface = std::get_if<SurfacePtr>(&entity)) {
      out["kind"] = "surface";
      found = feet(**surface, point);
    } else {
      throw UsageError(fmt::format("'{}' is neither a curve nor a surface: distances are measured from those", name));
    }
    out["to"] = to;
    out.update(found);
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("'{}': {}", name, error.what()));
  }
  return out;
}

void print_distance(const ordered_json& found) {
  fmt::print("{} '{}' to {}: distance {}\n", found["kind"].get<std::string>(), found["name"].get<std::string>(),
             found["to"].get<std::string>(), digits(found["distance"].get<double>()));
  for (const ordered_json& foot : found["feet"])
    fmt::print("  {:<11}{}  distance {:<20.17g}  point {}\n", foot["kind"].get<std::string>(), parameters(foot),
               foot["distance"].get<double>(), digits(vector_of(foot["point"])));
  if (found.contains("arcs"))
    for (const ordered_json& arc : found["arcs"])
      fmt::print("  all points from t {} to {} are as far\n", digits(arc[0].get<double>()),
                 digits(arc[1].get<double>()));
  if (found.contains("regions"))
    for (const ordered_json& region : found["regions"])
      fmt::print("  feet that cannot be told apart: u {:.9g} to {:.9g}, v {:.9g} to {:.9g}\n",
                 region["u"][0].get<double>(), region["u"][1].get<double>(), region["v"][0].get<double>(),
                 region["v"][1].get<double>());
}

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
    fmt::print("  {:<9}{}  point {}\n", one["contact"].get<bool>() ? "contact" : "crossing", parameters(one),
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
