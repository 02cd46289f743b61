// Shape of a curve or surface: features, arc length of parts; how near two curves are as a whole.
#include <fmt/format.h>

#include <stdexcept>

#include "command.h"
#include "geometry/queries/closest/curve_nearness.h"
#include "geometry/queries/differential/curvature.h"
#include "geometry/queries/differential/umbilics.h"
#include "geometry/queries/measures/arc_length.h"
#include "geometry/queries/measures/curve_features.h"
#include "geometry/queries/measures/tangent_spread.h"
#include "measure.h"
#include "parameters.h"

namespace lekalo::command {

namespace {

using geometry::CurveFeature;
using geometry::CurvePtr;
using geometry::Measured;

const CurvePtr& curve_of(const std::string& name, const render::Entity& entity, const char* option) {
  const auto* curve = std::get_if<CurvePtr>(&entity);
  if (!curve) throw UsageError(fmt::format("'{}' is no curve: {} takes curves", name, option));
  return *curve;
}

void put_value(ordered_json& out, const char* key, const Measured& measured) {
  out[key] = finite_or_null(measured.value);
  out[fmt::format("{}_error", key)] = finite_or_null(measured.error);
}

ordered_json row_of(const CurveFeature& feature) {
  ordered_json row{{"kind", geometry::name(feature.kind)}, {"t", feature.t}, {"point", to_json(feature.point)}};
  if (feature.kind == CurveFeature::Kind::vertex) row["curvature"] = feature.curvature;
  if (feature.kind == CurveFeature::Kind::corner) row["angle"] = feature.angle;
  return row;
}

// What these queries say of a curve that they cannot take.
template <class Query>
ordered_json asked(const std::string& name, const Query& query) {
  try {
    return query();
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("'{}': {}", name, error.what()));
  }
}

ordered_json surface_shape(const std::string& name, const geometry::Surface& surface) {
  return asked(name, [&] {
    ordered_json points = ordered_json::array();
    for (const geometry::Vec2& at : geometry::umbilics(surface))
      points.push_back({{"kind", "umbilic"},
                        {"u", at.x},
                        {"v", at.y},
                        {"point", to_json(surface.point(at.x, at.y))},
                        {"curvature", geometry::curvature(surface, at.x, at.y).mean}});
    return ordered_json{{"name", name}, {"kind", "surface"}, {"features", points}};
  });
}

}  // namespace

ordered_json curve_shape(const std::string& name, const render::Entity& entity) {
  if (const auto* surface = std::get_if<geometry::SurfacePtr>(&entity)) return surface_shape(name, **surface);
  const CurvePtr& curve = curve_of(name, entity, "--features");
  return asked(name, [&] {
    const geometry::CurveFeatures found = geometry::curve_features(*curve);
    ordered_json out{{"name", name}, {"kind", "curve"}, {"plane", found.plane}, {"closed", found.closed}};
    if (found.plane) out["plane_normal"] = to_json(found.normal);
    put_value(out, "total_curvature", found.total_curvature);
    if (found.total_torsion) put_value(out, "total_torsion", *found.total_torsion);
    if (found.turning_number) out["turning_number"] = *found.turning_number;
    if (found.area) put_value(out, "area", *found.area);
    const geometry::TangentSpread spread = geometry::tangent_spread(*curve);
    out["widest_angle"] = spread.angle;
    out["widest_at"] = {spread.s, spread.t};
    out["monotone"] = spread.is_monotone();
    ordered_json points = ordered_json::array();
    for (const CurveFeature& feature : found.points) points.push_back(row_of(feature));
    out["features"] = points;
    out["parameters"] = parameters_of(*curve);
    return out;
  });
}

void print_curve_shape(const ordered_json& found) {
  if (found["kind"] == "surface") {
    fmt::print("surface '{}'\n", found["name"].get<std::string>());
    for (const ordered_json& row : found["features"])
      fmt::print("{:<16} u {}  v {}  point {}  curvature {}\n", row["kind"].get<std::string>(),
                 digits(row["u"].get<double>()), digits(row["v"].get<double>()), digits(vector_of(row["point"])),
                 digits(row["curvature"].get<double>()));
    return;
  }
  fmt::print("curve '{}', {}, {}\n", found["name"].get<std::string>(),
             found["plane"].get<bool>() ? "plane" : "in space", found["closed"].get<bool>() ? "closed" : "open");
  for (const char* key : {"total_curvature", "total_torsion", "turning_number", "area"})
    if (found.contains(key) && !found[key].is_null()) fmt::print("{:<16} {}\n", key, digits(found[key].get<double>()));
  fmt::print("{:<16} {}  between t {} and {}{}\n", "widest angle", digits(found["widest_angle"].get<double>()),
             digits(found["widest_at"][0].get<double>()), digits(found["widest_at"][1].get<double>()),
             found["monotone"].get<bool>() ? ": monotone" : "");
  for (const ordered_json& row : found["features"]) {
    fmt::print("{:<16} t {}  point {}", row["kind"].get<std::string>(), digits(row["t"].get<double>()),
               digits(vector_of(row["point"])));
    for (const char* key : {"curvature", "angle"})
      if (row.contains(key)) fmt::print("  {} {}", key, digits(row[key].get<double>()));
    fmt::print("\n");
  }
}

ordered_json arc_of(const std::string& name, const render::Entity& entity, double from, double to) {
  const CurvePtr& curve = curve_of(name, entity, "--arc");
  note_outside("t", from, curve->domain(), curve->period());
  note_outside("t", to, curve->domain(), curve->period());
  ordered_json out{{"name", name}, {"kind", "curve"}, {"from", from}, {"to", to}};
  const Measured length = geometry::arc_length(*curve, from, to);
  put_value(out, "length", length);
  return out;
}

ordered_json parameter_at(const std::string& name, const render::Entity& entity, double length) {
  const CurvePtr& curve = curve_of(name, entity, "--at-length");
  return asked(name, [&] {
    const double whole = geometry::measure(*curve).length.value;
    if (!(length >= 0 && length <= whole))
      throw UsageError(fmt::format("--at-length {:g}: the curve '{}' has the length {:g}", length, name, whole));
    const double t = geometry::parameter_at_fraction(*curve, length / whole);
    return ordered_json{
        {"name", name}, {"kind", "curve"}, {"length", length}, {"t", t}, {"point", to_json(curve->point(t))}};
  });
}

void print_arc(const ordered_json& found) {
  for (const auto& [key, value] : found.items()) {
    if (value.is_string() || key.ends_with("_error")) continue;
    fmt::print("{:<18} {}\n", key,
               value.is_null()    ? "-"
               : value.is_array() ? digits(vector_of(value))
                                  : digits(value.get<double>()));
  }
}

ordered_json hausdorff_between(const std::string& name, const render::Entity& entity, const std::string& other_name,
                               const render::Entity& other) {
  const CurvePtr &a = curve_of(name, entity, "--hausdorff"), &b = curve_of(other_name, other, "--hausdorff");
  return asked(name, [&] {
    const geometry::HausdorffDistance d = geometry::hausdorff_distance(a, b);
    return ordered_json{{"name", name},
                        {"with", other_name},
                        {"distance", "hausdorff"},
                        {"lower", d.lower},
                        {"upper", d.upper},
                        {"farthest", {{"of", d.of_first ? name : other_name}, {"t", d.t}, {"point", to_json(d.point)}}},
                        {"nearest", to_json(d.nearest)}};
  });
}

ordered_json frechet_between(const std::string& name, const render::Entity& entity, const std::string& other_name,
                             const render::Entity& other) {
  const CurvePtr &a = curve_of(name, entity, "--frechet"), &b = curve_of(other_name, other, "--frechet");
  return asked(name, [&] {
    const geometry::Nearness d = geometry::frechet_distance(*a, *b);
    return ordered_json{
        {"name", name}, {"with", other_name}, {"distance", "frechet"}, {"lower", d.lower}, {"upper", d.upper}};
  });
}

void print_nearness(const ordered_json& found) {
  fmt::print("{} distance of '{}' and '{}'\n",
             found["distance"].get<std::string>() == "frechet" ? "Frechet" : "Hausdorff",
             found["name"].get<std::string>(), found["with"].get<std::string>());
  fmt::print("at least  {}\nat most   {}\n", digits(found["lower"].get<double>()),
             digits(found["upper"].get<double>()));
  if (!found.contains("farthest")) return;
  const ordered_json& far = found["farthest"];
  fmt::print("farthest  t {} of '{}'  point {}\nnearest   {}\n", digits(far["t"].get<double>()),
             far["of"].get<std::string>(), digits(vector_of(far["point"])), digits(vector_of(found["nearest"])));
}

}  // namespace lekalo::command
