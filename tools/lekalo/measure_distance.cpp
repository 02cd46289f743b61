// How far curves, surfaces and bodies are from points and from each other.
#include <fmt/format.h>

#include <optional>
#include <stdexcept>

#include "command.h"
#include "geometry/queries/closest/closest_point.h"
#include "geometry/queries/closest/distance.h"
#include "geometry/queries/quadrics/plane_coordinates.h"
#include "measure.h"

namespace lekalo::command {

namespace {

using geometry::BodyPtr;
using geometry::CurvePtr;
using geometry::DistanceMinimum;
using geometry::DistancePlace;
using geometry::FootPointKind;
using geometry::Interval;
using geometry::SurfacePtr;
using geometry::Vec3;

const char* word(FootPointKind kind) {
  switch (kind) {
    case FootPointKind::minimum:
      return "minimum";
    case FootPointKind::maximum:
      return "maximum";
    case FootPointKind::saddle:
      return "saddle";
    case FootPointKind::degenerate:
      return "degenerate";
    case FootPointKind::border:
      return "border";
  }
  return "";
}

template <class FootPoint>
ordered_json foot_point_row(ordered_json row, const FootPoint& foot_point) {
  row["point"] = to_json(foot_point.point);
  row["distance"] = foot_point.distance;
  row["kind"] = word(foot_point.kind);
  return row;
}

// Of formulas that are not bounded: everything else has a nearest place.
constexpr const char* kNoFootPoints = "no foot was found: its formulas have no finite bounds";

ordered_json foot_points(const geometry::Curve& curve, const Vec3& point) {
  ordered_json out;
  const geometry::CurveFootPoints found = project(point, curve);
  if (found.foot_points.empty()) throw std::invalid_argument(kNoFootPoints);
  out["distance"] = found.foot_points.front().distance;
  for (const geometry::CurveFootPoint& foot_point : found.foot_points)
    out["feet"].push_back(foot_point_row({{"t", foot_point.t}}, foot_point));
  for (const Interval& arc : found.arcs) out["arcs"].push_back(range(arc));
  return out;
}

ordered_json foot_points(const SurfacePtr& surface, const Vec3& point) {
  ordered_json out;
  const geometry::SurfaceFootPoints found = project(point, *surface);
  if (found.foot_points.empty()) throw std::invalid_argument(kNoFootPoints);
  out["distance"] = found.foot_points.front().distance;
  for (const geometry::SurfaceFootPoint& foot_point : found.foot_points)
    out["feet"].push_back(foot_point_row({{"u", foot_point.u}, {"v", foot_point.v}}, foot_point));
  for (const geometry::Rectangle& region : found.regions)
    out["regions"].push_back({{"u", range(region.u)}, {"v", range(region.v)}});
  if (const auto in = geometry::plane_coordinates(point, surface)) {
    ordered_json rows = ordered_json::array();
    for (int i = 0; i < 3; ++i) rows.push_back(to_json(Vec3(in->inverse[0][i], in->inverse[1][i], in->inverse[2][i])));
    out["in_plane"] = {{"u", in->u}, {"v", in->v}, {"distance", in->distance}, {"inverse", rows}};
  }
  return out;
}

const char* kind_of(const render::Entity& entity) {
  return std::holds_alternative<Vec3>(entity)         ? "point"
         : std::holds_alternative<CurvePtr>(entity)   ? "curve"
         : std::holds_alternative<SurfacePtr>(entity) ? "surface"
                                                      : "body";
}

std::optional<geometry::Distant> distant(const render::Entity& entity) {
  if (const auto* point = std::get_if<Vec3>(&entity)) return *point;
  if (const auto* curve = std::get_if<CurvePtr>(&entity)) return curve->get();
  if (const auto* surface = std::get_if<SurfacePtr>(&entity)) return surface->get();
  if (const auto* body = std::get_if<BodyPtr>(&entity)) return body->get();
  return std::nullopt;
}

bool has_width(const std::array<Interval, 2>& ranges) { return ranges[0].width() > 0 || ranges[1].width() > 0; }

ordered_json end_row(const DistancePlace& place, bool has_ranges, const std::array<Interval, 2>& ranges) {
  ordered_json row = place_row(place);
  if (!has_ranges) return row;
  // A range without end has no numbers.
  const auto put = [&](const char* name, const Interval& reach) {
    if (row.contains(name) && reach.width() < geometry::kInfinity) row[std::string(name) + "_range"] = range(reach);
  };
  put("t", ranges[0]), put("u", ranges[0]), put("v", ranges[1]);
  return row;
}

ordered_json minima(const geometry::Distant& a, const geometry::Distant& b, bool nearest) {
  const geometry::Distance found =
      distance(a, b, nearest ? geometry::DistanceMinima::nearest : geometry::DistanceMinima::all);
  ordered_json out{{"distance", found.distance}, {"bound", found.bound}, {"meet", found.meet}};
  out["minima"] = ordered_json::array();
  for (const DistanceMinimum& one : found.minima) {
    // Of a place where surfaces meet nothing is known beside it.
    const bool is_known = !found.meet || one.isolated || has_width(one.range_a) || has_width(one.range_b);
    const bool has_ranges = is_known && !one.isolated;
    ordered_json row{{"distance", one.distance}};
    if (is_known) row["isolated"] = one.isolated;
    row["at"] = end_row(one.a, has_ranges, one.range_a);
    row["at_other"] = end_row(one.b, has_ranges, one.range_b);
    out["minima"].push_back(std::move(row));
  }
  return out;
}

std::string ranges_text(const ordered_json& place) {
  std::string text;
  for (const char* key : {"t", "u", "v"})
    if (const auto found = place.find(std::string(key) + "_range"); found != place.end())
      text += fmt::format("{}{} {:.9g} to {:.9g}", text.empty() ? "" : ", ", key, (*found)[0].get<double>(),
                          (*found)[1].get<double>());
  return text;
}

void print_minima(const ordered_json& found) {
  fmt::print("{} '{}' to {}: ", found["kind"].get<std::string>(), found["name"].get<std::string>(),
             found["to"].get<std::string>());
  if (found["meet"].get<bool>())
    fmt::print("they meet\n");
  else
    fmt::print("distance {}, certainly at least {}\n", digits(found["distance"].get<double>()),
               digits(found["bound"].get<double>()));
  for (const ordered_json& one : found["minima"]) {
    fmt::print("  minimum  distance {}\n    from  {}\n    to    {}\n", digits(one["distance"].get<double>()),
               place_text(one["at"]), place_text(one["at_other"]));
    if (!one.contains("isolated")) {
      fmt::print("    one place of those where they meet; --intersect finds all\n");
      continue;
    }
    if (one["isolated"].get<bool>()) continue;
    const std::string at = ranges_text(one["at"]), other = ranges_text(one["at_other"]);
    fmt::print("    places beside are as near{}{}{}{}\n", at.empty() ? "" : ": from ", at,
               other.empty() ? ""
               : at.empty()  ? ": to "
                             : "; to ",
               other);
  }
}

void print_in_plane(const ordered_json& in) {
  fmt::print("  in the plane's axes  u {}  v {}  signed distance {}\n", digits(in["u"].get<double>()),
             digits(in["v"].get<double>()), digits(in["distance"].get<double>()));
  for (int i = 0; i < 3; ++i)
    fmt::print("  {:<19}  {}\n", i == 0 ? "inverse matrix" : "", digits(vector_of(in["inverse"][i])));
}

}  // namespace

ordered_json range(const Interval& x) { return ordered_json::array({x.lo, x.hi}); }

Vec3 vector_of(const ordered_json& v) { return {v[0], v[1], v[2]}; }

ordered_json place_row(const DistancePlace& place) {
  using Kind = DistancePlace::Kind;
  ordered_json row = ordered_json::object();
  if (place.kind == Kind::vertex) row["vertex"] = place.index;
  if (place.kind == Kind::edge) row["edge"] = place.index;
  if (place.kind == Kind::face) row["face"] = place.index;
  if (place.kind == Kind::curve || place.kind == Kind::edge) row["t"] = place.t;
  if (place.kind == Kind::surface || place.kind == Kind::face) row["u"] = place.u, row["v"] = place.v;
  row["point"] = to_json(place.point);
  return row;
}

std::string place_text(const ordered_json& place) {
  std::string text;
  for (const char* part : {"vertex", "edge", "face"})
    if (place.contains(part)) text += fmt::format("{} {}  ", part, place[part].get<int>());
  for (const char* key : {"t", "u", "v"})
    if (place.contains(key)) text += fmt::format("{} {:.17g}  ", key, place[key].get<double>());
  return text + "point " + digits(vector_of(place["point"]));
}

std::string parameter_text(const ordered_json& row) {
  std::string text;
  for (const char* key : {"t", "t_other", "u", "v"})
    if (row.contains(key)) text += fmt::format("{}{} {:<20.17g}", text.empty() ? "" : " ", key, row[key].get<double>());
  return text;
}

ordered_json distance_to(const std::string& name, const render::Entity& entity, const std::string& to,
                         const render::Entity& other, bool nearest) {
  ordered_json out{{"name", name}};
  const auto a = distant(entity), b = distant(other);
  if (!a || std::holds_alternative<Vec3>(entity))
    throw UsageError(fmt::format("'{}' is no curve, surface or body: distances are measured from those", name));
  if (!b) throw UsageError(fmt::format("'{}' is no point, curve, surface or body: give one of those to --to", to));
  try {
    out["kind"] = kind_of(entity);
    out["to"] = to;
    const auto* point = std::get_if<Vec3>(&other);
    const bool foot_points_wanted = point && !nearest && !std::holds_alternative<BodyPtr>(entity);
    if (foot_points_wanted && std::holds_alternative<CurvePtr>(entity))
      out.update(foot_points(*std::get<CurvePtr>(entity), *point));
    else if (foot_points_wanted)
      out.update(foot_points(std::get<SurfacePtr>(entity), *point));
    else
      out.update(minima(*a, *b, nearest));
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("'{}' to '{}': {}", name, to, error.what()));
  }
  return out;
}

void print_distance(const ordered_json& found) {
  if (found.contains("minima")) return print_minima(found);
  fmt::print("{} '{}' to {}: distance {}\n", found["kind"].get<std::string>(), found["name"].get<std::string>(),
             found["to"].get<std::string>(), digits(found["distance"].get<double>()));
  for (const ordered_json& foot_point : found["feet"])
    fmt::print("  {:<11}{}  distance {:<20.17g}  point {}\n", foot_point["kind"].get<std::string>(),
               parameter_text(foot_point), foot_point["distance"].get<double>(),
               digits(vector_of(foot_point["point"])));
  if (found.contains("in_plane")) print_in_plane(found["in_plane"]);
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

}  // namespace lekalo::command
