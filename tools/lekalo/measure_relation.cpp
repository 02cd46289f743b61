// Where curves and surfaces meet, a curve itself, and three surfaces in points.
#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "command.h"
#include "geometry/queries/contours/common_points.h"
#include "geometry/queries/differential/curvature.h"
#include "geometry/queries/intersections/self_intersections.h"
#include "measure.h"

namespace lekalo::command {

namespace {

using geometry::CurvePtr;
using geometry::Interval;
using geometry::kPi;
using geometry::SurfacePtr;
using geometry::Vec3;

template <class Intersection>
ordered_json intersection_row(ordered_json row, const Intersection& one) {
  row["point"] = to_json(one.point);
  row["distance"] = one.distance;
  row["contact"] = one.contact;
  return row;
}

// Between the directions of two vectors, 0 to pi; null where a curve has no tangent.
ordered_json angle_between(const std::optional<Vec3>& a, const std::optional<Vec3>& b) {
  if (!a || !b) return nullptr;
  return std::atan2(glm::length(glm::cross(*a, *b)), glm::dot(*a, *b));
}
std::optional<Vec3> tangent(const geometry::Curve& curve, double t) {
  const geometry::CurveCurvature at = geometry::curvature(curve, t);
  return at.has_tangent ? std::optional(at.tangent) : std::nullopt;
}

ordered_json intersections(const geometry::Curve& a, const geometry::Curve& b, double tolerance) {
  const geometry::CurveIntersections found = intersect(a, b, tolerance);
  ordered_json points = ordered_json::array(), common = ordered_json::array();
  for (const geometry::CurveIntersection& one : found.points) {
    points.push_back(intersection_row({{"t", one.s}, {"t_other", one.t}}, one));
    points.back()["angle"] = angle_between(tangent(a, one.s), tangent(b, one.t));
  }
  for (const geometry::CommonPart& part : found.common)
    common.push_back({{"t", range(part.s)}, {"t_other", {part.begin, part.end}}});
  return {{"points", points}, {"common", common}};
}

ordered_json intersections(const geometry::Curve& curve, const geometry::Surface& surface, double tolerance) {
  const geometry::SurfaceIntersections found = intersect(curve, surface, tolerance);
  ordered_json points = ordered_json::array(), common = ordered_json::array();
  for (const geometry::SurfaceIntersection& one : found.points) {
    points.push_back(intersection_row({{"t", one.t}, {"u", one.u}, {"v", one.v}}, one));
    // With the tangent plane: what lacks of a right angle to the normal, positive where the curve comes out.
    const ordered_json to_normal = angle_between(tangent(curve, one.t), surface.normal(one.u, one.v));
    points.back()["angle"] = to_normal.is_null() ? to_normal : ordered_json(0.5 * kPi - to_normal.get<double>());
  }
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
      found = intersections(**curve, **other_curve, tolerance);
    else if (curve && other_surface)
      found = intersections(**curve, **other_surface, tolerance);
    else if (surface && other_curve)
      found = intersections(**other_curve, **surface, tolerance);
    else
      throw UsageError(fmt::format("'{}' and '{}': meetings are found of curves and surfaces", name, other_name));
    out.update(found);
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("'{}' with '{}': {}", name, other_name, error.what()));
  }
  return out;
}

namespace {

const char* word(geometry::SelfIntersectionKind kind) {
  switch (kind) {
    case geometry::SelfIntersectionKind::crossing:
      return "crossing";
    case geometry::SelfIntersectionKind::contact:
      return "contact";
    case geometry::SelfIntersectionKind::cusp:
      return "cusp";
  }
  return "";
}

void print_common(const ordered_json& part) {
  fmt::print("  common   t {} to {}", digits(part["t"][0].get<double>()), digits(part["t"][1].get<double>()));
  if (part.contains("t_other"))
    fmt::print("  t_other {} to {}", digits(part["t_other"][0].get<double>()),
               digits(part["t_other"][1].get<double>()));
  fmt::print("\n");
}

std::string count_text(size_t count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

}  // namespace

ordered_json self_intersections(const std::string& name, const CurvePtr& curve, double tolerance) {
  ordered_json points = ordered_json::array(), common = ordered_json::array();
  const geometry::CurveSelfIntersections found = geometry::self_intersections(*curve, tolerance);
  for (const geometry::CurveSelfIntersection& one : found.points)
    points.push_back({{"kind", word(one.kind)},
                      {"t", one.s},
                      {"t_other", one.t},
                      {"point", to_json(one.point)},
                      {"distance", one.distance}});
  for (const geometry::CommonPart& part : found.common)
    common.push_back({{"t", range(part.s)}, {"t_other", {part.begin, part.end}}});
  return {{"name", name}, {"with", name}, {"points", points}, {"common", common}};
}

void print_self_intersections(const ordered_json& found) {
  const size_t parts = found["common"].size();
  fmt::print("'{}' with itself: {}{}\n", found["name"].get<std::string>(), count_text(found["points"].size(), "point"),
             parts == 0 ? "" : ", " + count_text(parts, "part") + " run twice");
  for (const ordered_json& one : found["points"])
    fmt::print("  {:<9}{}  point {}\n", one["kind"].get<std::string>(), parameter_text(one),
               digits(vector_of(one["point"])));
  for (const ordered_json& part : found["common"]) print_common(part);
}

ordered_json common_points_of(const std::array<std::string, 3>& names,
                              const std::array<const render::Entity*, 3>& entities, double tolerance) {
  std::array<geometry::SurfaceOrBody, 3> of;
  for (int i = 0; i < 3; ++i) {
    if (const auto* surface = std::get_if<SurfacePtr>(entities[i]))
      of[i] = *surface;
    else if (const auto* body = std::get_if<geometry::BodyPtr>(entities[i]))
      of[i] = *body;
    else
      throw UsageError(
          fmt::format("'{}' is neither a surface nor a body: common points are found of three of these", names[i]));
  }
  ordered_json out{{"names", names}, {"points", ordered_json::array()}, {"curves", ordered_json::array()}};
  try {
    const geometry::CommonPoints found = common_points(of, tolerance);
    for (const geometry::CommonPoint& one : found.points) {
      ordered_json row{{"point", to_json(one.point)}, {"contact", one.contact}, {"distance", one.distance}};
      row["places"] = ordered_json::array();
      for (int i = 0; i < 3; ++i) {
        ordered_json place{{"u", one.places[i].x}, {"v", one.places[i].y}};
        if (one.faces[i] >= 0) place["face"] = std::get<geometry::BodyPtr>(of[i])->faces[one.faces[i]].origin.text();
        row["places"].push_back(place);
      }
      out["points"].push_back(row);
    }
    for (const geometry::CommonCurve& one : found.curves)
      out["curves"].push_back(
          {{"begin", to_json(one.curve->point(one.t.lo))}, {"end", to_json(one.curve->point(one.t.hi))}});
    out["complete"] = found.complete;
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("'{}', '{}' and '{}': {}", names[0], names[1], names[2], error.what()));
  }
  return out;
}

void print_common_points(const ordered_json& found) {
  const ordered_json& names = found["names"];
  const size_t curves = found["curves"].size();
  fmt::print("'{}', '{}' and '{}': {}{}{}\n", names[0].get<std::string>(), names[1].get<std::string>(),
             names[2].get<std::string>(), count_text(found["points"].size(), "common point"),
             curves == 0 ? "" : ", " + count_text(curves, "common curve"),
             found["complete"].get<bool>() ? "" : "; what coincides or touches along a curve is left out");
  for (const ordered_json& one : found["points"]) {
    fmt::print("  {:<9}{}\n", one["contact"].get<bool>() ? "contact" : "crossing", digits(vector_of(one["point"])));
    for (int i = 0; i < 3; ++i) {
      const ordered_json& place = one["places"][i];
      fmt::print("    {}{}  u {:<.17g}  v {:<.17g}\n", names[i].get<std::string>(),
                 place.contains("face") ? " " + place["face"].get<std::string>() : "", place["u"].get<double>(),
                 place["v"].get<double>());
    }
  }
  for (const ordered_json& one : found["curves"])
    fmt::print("  curve    {} to {}\n", digits(vector_of(one["begin"])), digits(vector_of(one["end"])));
}

void print_intersections(const ordered_json& found) {
  const size_t points = found["points"].size(), parts = found["common"].size();
  fmt::print("'{}' with '{}': {} point{}{}\n", found["name"].get<std::string>(), found["with"].get<std::string>(),
             points, points == 1 ? "" : "s",
             parts == 0 ? "" : fmt::format(", {} part{} in common", parts, parts == 1 ? "" : "s"));
  for (const ordered_json& one : found["points"])
    fmt::print("  {:<9}{}  point {}{}\n", one["contact"].get<bool>() ? "contact" : "crossing", parameter_text(one),
               digits(vector_of(one["point"])),
               one["angle"].is_null() ? "" : "  angle " + digits(one["angle"].get<double>()));
  for (const ordered_json& part : found["common"]) print_common(part);
}

}  // namespace lekalo::command
