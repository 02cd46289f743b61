// Lengths, areas, volumes and moments with their errors.
#include "measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "command.h"
#include "geometry/curves/operations/arc_blend_curve.h"
#include "geometry/curves/operations/surface_curve.h"
#include "geometry/queries/differential/plane_lines.h"
#include "geometry/queries/measures/enclosed_area.h"
#include "geometry/queries/measures/mass_properties.h"
#include "geometry/queries/measures/shape_measures.h"
#include "geometry/queries/quadrics/conic_of_curve.h"
#include "parameters.h"

namespace lekalo::command {

namespace {

using geometry::MassProperties;
using geometry::Measured;
using geometry::Vec3;

void put(ordered_json& out, const char* key, const Measured& measured) {
  out[key] = measured.value;
  out[std::string(key) + "_error"] = measured.error;
}

void put_centroid(ordered_json& out, const Vec3& centroid, double error) {
  out["centroid"] = to_json(centroid);
  out["centroid_error"] = error;
}

void put_conic(ordered_json& out, const geometry::Curve& curve) {
  const auto conic = geometry::conic_of(curve);
  if (!conic) return;
  out["conic"] = geometry::name(conic->kind);
  if (conic->kind == geometry::CanonicalConic::Kind::parabola) {
    out["vertex"] = to_json(conic->frame.origin);
    out["focal_length"] = conic->a;
  } else {
    out["center"] = to_json(conic->frame.origin);
    out["half_axes"] = {conic->a, conic->b};
  }
  out["axis"] = to_json(conic->frame.x);
}

void put(ordered_json& out, const MassProperties& mass) {
  put(out, "area", mass.area);
  out["closed"] = mass.closed;
  if (!mass.closed) return;
  put(out, "volume", mass.volume);
  put_centroid(out, mass.centroid, mass.centroid_error);
  out["inertia"] = to_json(mass.inertia);
  out["inertia_error"] = mass.inertia_error;
  out["principal_moments"] = to_json(mass.principal_moments);
  out["principal_axes"] = to_json(glm::transpose(mass.principal_axes));
}

void put(ordered_json& out, const geometry::SurfaceMeasures& measures) {
  put(out, "area", measures.area);
  put_centroid(out, measures.centroid, measures.centroid_error);
}

// Normals of the planes that the surface, or its lines of parameter, lie in.
void put_planes(ordered_json& out, const geometry::Surface& surface) {
  if (!surface.bounded()) return;
  const geometry::PlaneLines planes = geometry::plane_lines(surface);
  if (planes.surface) out["plane"] = to_json(*planes.surface);
  if (planes.along_u) out["plane_of_u_lines"] = to_json(*planes.along_u);
  if (planes.along_v) out["plane_of_v_lines"] = to_json(*planes.along_v);
}

geometry::SurfaceMeasures sum_of(const std::vector<geometry::SurfaceMeasures>& parts) {
  geometry::SurfaceMeasures sum;
  for (const geometry::SurfaceMeasures& one : parts) {
    sum.area.value += one.area.value;
    sum.area.error += one.area.error;
    sum.centroid += one.area.value * one.centroid;
  }
  if (!(sum.area.value > 0)) return sum;
  sum.centroid /= sum.area.value;
  for (const geometry::SurfaceMeasures& one : parts)
    sum.centroid_error +=
        (one.area.value * one.centroid_error + glm::length(one.centroid - sum.centroid) * one.area.error) /
        sum.area.value;
  return sum;
}

geometry::SurfaceMeasures measure_set(const render::SurfaceSet& set) {
  std::vector<geometry::SurfaceMeasures> parts;
  for (const geometry::SurfacePtr& surface : set) parts.push_back(geometry::measure(*surface));
  return sum_of(parts);
}

// An open shell bounds nothing: it has an area and a centroid as a surface has.
void put_body(ordered_json& out, const geometry::Body& body) {
  const MassProperties mass = geometry::measure(body);
  put(out, mass);
  if (mass.closed) return;
  std::vector<geometry::SurfaceMeasures> parts;
  for (int face = 0; face < static_cast<int>(body.faces.size()); ++face)
    parts.push_back(geometry::measure_face(body, face));
  const geometry::SurfaceMeasures sum = sum_of(parts);
  put_centroid(out, sum.centroid, sum.centroid_error);
}

}  // namespace

ordered_json measures(const std::string& name, const render::Entity& given) {
  ordered_json out;
  out["name"] = name;
  std::string no_boundary;
  const render::Entity entity = by_boundary(given, &no_boundary);
  try {
    if (const auto* curve = std::get_if<geometry::CurvePtr>(&entity)) {
      const geometry::CurveMeasures measured = geometry::measure(**curve);
      out["kind"] = "curve";
      put(out, "length", measured.length);
      put_centroid(out, measured.centroid, measured.centroid_error);
      if (const auto area = geometry::enclosed_area(**curve)) put(out, "enclosed_area", *area);
      put_conic(out, **curve);
      out["parameters"] = parameters_of(**curve);
      // A line found by steps says how far it may be from the one that is meant.
      const auto* line = dynamic_cast<const geometry::SurfaceCurve*>(curve->get());
      if (line && line->error() > 0) out["deviation"] = line->error();
      if (const auto* path = dynamic_cast<const geometry::ToolPath*>(curve->get())) put_tool_path(out, *path);
      const auto* blend = dynamic_cast<const geometry::ArcBlendCurve*>(curve->get());
      if (blend) out["segments"] = blend->segments();
      if (blend && blend->bounds()) {
        out["deviation_bound"] = blend->bounds()->position;
        out["angle_bound"] = blend->bounds()->angle;
      }
      put_plan(out, **curve);
    } else if (const auto* surface = std::get_if<geometry::SurfacePtr>(&entity)) {
      out["kind"] = "surface";
      put(out, geometry::measure(**surface));
      put_planes(out, **surface);
      out["parameters"] = parameters_of(**surface);
    } else if (const auto* set = std::get_if<render::SurfaceSet>(&entity)) {
      out["kind"] = "patches";
      put(out, measure_set(*set));
    } else if (const auto* body = std::get_if<geometry::BodyPtr>(&entity)) {
      out["kind"] = "body";
      put_body(out, **body);
    } else if (const auto* mesh = std::get_if<geometry::MeshPtr>(&entity)) {
      out["kind"] = "mesh";
      put(out, geometry::measure(**mesh));
      if (!out["closed"].get<bool>()) put_open_sides(out, geometry::sides(**mesh));
    } else if (const auto* shape = std::get_if<geometry::ShapePtr>(&entity)) {
      const geometry::ShapeMeasures measured = geometry::measure(**shape);
      out["kind"] = "shape";
      if (!no_boundary.empty()) out["by_lines"] = "its boundary is not made: " + no_boundary;
      put(out, "area", measured.area);
      put(out, "volume", measured.volume);
      put_centroid(out, measured.centroid, measured.centroid_error);
    } else {
      throw UsageError(fmt::format("'{}' is a point or a group: there is nothing to measure", name));
    }
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("'{}': {}", name, error.what()));
  }
  try {
    demand_finite(out);
  } catch (const std::invalid_argument&) {
    throw UsageError(fmt::format("'{}' is too large: its measures are beyond what numbers can hold", name));
  }
  return out;
}

void print_measures(const ordered_json& measured) {
  const auto vector_text = [](const ordered_json& v) { return digits(Vec3(v[0], v[1], v[2])); };
  fmt::print("{} '{}'{}\n", measured["kind"].get<std::string>(), measured["name"].get<std::string>(),
             !measured.value("closed", true)     ? ", not closed: it has no volume"
             : measured.value("volume", 0.0) < 0 ? ", inside out: its volume is negative"
                                                 : "");
  for (const auto& [key, value] : measured.items()) {
    if (key == "by_lines") fmt::print("by lines           {}\n", value.get<std::string>());
    if (key == "without_mass") fmt::print("without mass       {}\n", value.get<std::string>());
    if (key == "conic") fmt::print("{:<18} {}\n", key, value.get<std::string>());
    if (key == "attributes") {
      print_attributes(value);
      continue;
    }
    if (value.is_string() || value.is_boolean() || key.ends_with("_error")) continue;
    if (key == "parameters" || value.is_object()) {
      value.is_object() ? print_plan(value) : print_parameters(value);
      continue;
    }
    const bool is_matrix = value.is_array() && value[0].is_array();
    std::string label = key;
    std::replace(label.begin(), label.end(), '_', ' ');
    fmt::print("{:<18} {}", label,
               is_matrix ? vector_text(value[0])
               : value.is_array() && value.size() == 2
                   ? fmt::format("{} {}", digits(value[0].get<double>()), digits(value[1].get<double>()))
               : value.is_array() ? vector_text(value)
                                  : digits(value.get<double>()));
    if (const auto error = measured.find(key + "_error"); error != measured.end())
      fmt::print("   error {:.2g}", error->get<double>());
    fmt::print("\n");
    for (size_t row = 1; is_matrix && row < value.size(); ++row) fmt::print("{:<18} {}\n", "", vector_text(value[row]));
  }
}

}  // namespace lekalo::command
