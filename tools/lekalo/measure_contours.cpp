// Curves that surfaces make: where two meet, sections by planes, silhouettes.
#include <fmt/format.h>

#include <stdexcept>

#include "command.h"
#include "geometry/queries/contours/body_contours.h"
#include "geometry/queries/contours/contour_length.h"
#include "geometry/queries/contours/surface_intersection.h"
#include "geometry/queries/intersections/self_intersections.h"
#include "geometry/queries/measures/mass_properties.h"
#include "measure.h"

namespace lekalo::command {

namespace {

using geometry::BodyPtr;
using geometry::Contour;
using geometry::ContourKind;
using geometry::ContourPoint;
using geometry::ContourPointKind;
using geometry::Contours;
using geometry::SurfacePtr;
using geometry::Vec3;

const char* word(ContourPointKind kind) {
  switch (kind) {
    case ContourPointKind::contact:
      return "contact";
    case ContourPointKind::crossing:
      return "crossing";
    case ContourPointKind::end:
      return "end";
  }
  return "";
}

const char* word(ContourKind kind) {
  switch (kind) {
    case ContourKind::crossing:
      return "crossing";
    case ContourKind::touching:
      return "touching";
    case ContourKind::border:
      return "border";
  }
  return "";
}

const SurfacePtr& surface_of(const std::string& name, const render::Entity& entity) {
  if (const auto* surface = std::get_if<SurfacePtr>(&entity)) return *surface;
  throw UsageError(fmt::format("'{}' is neither a surface nor a body", name));
}

// The names of parameters: those of the surface, or of both.
constexpr const char* kParameters[] = {"u", "v", "u_other", "v_other"};

ordered_json sample(const Contour& contour, double t) {
  ordered_json row{{"t", t}, {"point", to_json(contour.curve->point(t))}};
  for (size_t k = 0; k < contour.images.size(); ++k) {
    const Vec3 place = contour.images[k]->point(t);
    row[kParameters[2 * k]] = place.x;
    row[kParameters[2 * k + 1]] = place.y;
  }
  return row;
}

template <class Found>
void put_points(ordered_json& out, const Found& found) {
  out["points"] = ordered_json::array();
  for (const ContourPoint& point : found.points) {
    ordered_json row{{"kind", word(point.kind)}, {"point", to_json(point.point)}};
    for (size_t i = 0; i < point.parameters.size(); ++i) row[kParameters[i]] = point.parameters[i];
    row["distance"] = point.distance;
    out["points"].push_back(row);
  }
  out["coincident"] = found.coincident;
  out["complete"] = found.complete;
}

ordered_json rows(const Contours& found, int samples) {
  ordered_json out;
  out["branches"] = ordered_json::array();
  for (const Contour& contour : found.branches) {
    const geometry::Interval t = contour.curve->domain();
    const geometry::Measured length = contour_length(contour);
    ordered_json row{{"kind", word(contour.kind)},   {"closed", contour.closed}, {"length", length.value},
                     {"length_error", length.error}, {"error", contour.error},   {"t", {t.lo, t.hi}}};
    row["begin"] = sample(contour, t.lo);
    row["end"] = sample(contour, t.hi);
    if (!contour.cusps.empty())
      for (const double cusp : contour.cusps) row["cusps"].push_back(sample(contour, cusp));
    for (int k = 0; k < samples; ++k) row["samples"].push_back(sample(contour, t.lo + t.width() * k / (samples - 1)));
    out["branches"].push_back(row);
  }
  put_points(out, found);
  out["method"] = found.closed_form ? "closed form" : "search";
  return out;
}

// Of a body: loops of parts of faces.
ordered_json rows(const geometry::BodyContours& found, const geometry::Body& body, const geometry::Body* other,
                  int samples) {
  ordered_json out;
  out["branches"] = ordered_json::array();
  for (const geometry::BodyContour& branch : found.branches) {
    ordered_json row{{"kind", word(branch.parts.front().contour.kind)}, {"closed", branch.closed}};
    double length = 0, length_error = 0, error = 0;
    ordered_json parts = ordered_json::array();
    for (const geometry::BodyContourPart& part : branch.parts) {
      const geometry::Interval all = part.contour.curve->domain();
      const geometry::Measured of_it = contour_length(part.contour, part.t);
      length += of_it.value, length_error += of_it.error;
      error = std::max(error, part.contour.error);
      ordered_json of_part{{"face", body.faces[part.face].origin.text()}};
      if (other) of_part["face_other"] = other->faces[part.other_face].origin.text();
      of_part["begin"] = to_json(part.begin);
      of_part["end"] = to_json(part.end);
      for (int k = 0; k < samples; ++k) {
        const double share = static_cast<double>(k) / (samples - 1);
        const double t = part.t.lo + part.t.width() * (part.backwards ? 1 - share : share);
        of_part["samples"].push_back(sample(part.contour, t <= all.hi ? t : t - all.width()));
      }
      parts.push_back(of_part);
    }
    row["length"] = length;
    row["length_error"] = length_error;
    row["error"] = error;
    row["parts"] = parts;
    out["branches"].push_back(row);
  }
  put_points(out, found);
  return out;
}

template <class Query>
ordered_json asked(const std::string& name, const char* key, const std::string& with, Query&& query) {
  ordered_json out{{"name", name}, {key, with}};
  try {
    out.update(query());
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("'{}': {}", name, error.what()));
  }
  return out;
}

std::string parameters(const ordered_json& row) {
  std::string text;
  for (const char* key : kParameters)
    if (row.contains(key)) text += fmt::format("  {} {:<.17g}", key, row[key].get<double>());
  return text;
}

void print_row(const char* label, const ordered_json& row) {
  std::string in_plane;
  if (row.contains("in_plane"))
    in_plane = fmt::format("  in the plane {} {}", digits(row["in_plane"][0].get<double>()),
                           digits(row["in_plane"][1].get<double>()));
  fmt::print("    {:<8} {}{}{}\n", label, digits(vector_of(row["point"])), parameters(row), in_plane);
}

}  // namespace

ordered_json surface_intersections(const std::string& name, const render::Entity& entity, const std::string& other_name,
                                   const render::Entity& other, double tolerance, int samples) {
  return asked(name, "with", other_name, [&] {
    const BodyPtr* a = std::get_if<BodyPtr>(&entity);
    const BodyPtr* b = std::get_if<BodyPtr>(&other);
    if (a && b) return rows(intersect(**a, **b, tolerance), **a, b->get(), samples);
    if (a) return rows(intersect(**a, surface_of(other_name, other), tolerance), **a, nullptr, samples);
    if (b) return rows(intersect(**b, surface_of(name, entity), tolerance), **b, nullptr, samples);
    return rows(intersect(surface_of(name, entity), surface_of(other_name, other), tolerance), samples);
  });
}

ordered_json surface_self_intersections(const std::string& name, const render::Entity& entity, double tolerance,
                                        int samples) {
  if (!std::holds_alternative<SurfacePtr>(entity))
    throw UsageError(fmt::format("'{}' is a body: self-intersections are found of curves and surfaces", name));
  return asked(name, "with", name,
               [&] { return rows(self_intersection(surface_of(name, entity), tolerance), samples); });
}

void put_plane_coordinates(ordered_json& rows, const Vec3& origin, const Vec3& normal) {
  if (!(glm::length(normal) > 0)) return;
  const geometry::Frame frame = geometry::frame_about(origin, glm::normalize(normal));
  if (rows.is_object() && rows.contains("point")) {
    const Vec3 off = vector_of(rows["point"]) - origin;
    rows["in_plane"] = {glm::dot(off, frame.x), glm::dot(off, frame.y)};
  }
  if (rows.is_structured())
    for (ordered_json& one : rows) put_plane_coordinates(one, origin, normal);
}

ordered_json section(const std::string& name, const render::Entity& entity, const std::string& plane, int samples) {
  const std::vector<double> p = parse_numbers(plane, 6, "--section");
  const Vec3 origin{p[0], p[1], p[2]}, normal{p[3], p[4], p[5]};
  ordered_json out = asked(name, "section", plane, [&] {
    if (const BodyPtr* body = std::get_if<BodyPtr>(&entity))
      return rows(plane_section(**body, origin, normal), **body, nullptr, samples);
    return rows(plane_section(surface_of(name, entity), origin, normal), samples);
  });
  put_plane_coordinates(out, origin, normal);
  return out;
}

geometry::ViewOf view_asked(const std::string& view, const render::Camera* camera) {
  geometry::ViewOf seen;
  if (view == "camera") {
    if (!camera) throw UsageError("the scene has no camera: --silhouette takes DX,DY,DZ or eye:X,Y,Z too");
    seen.central = !camera->is_parallel();
    seen.direction_or_eye =
        seen.central ? camera->ray(0.5 * camera->width(), 0.5 * camera->height()).origin : camera->view_direction();
  } else {
    seen.central = view.starts_with("eye:");
    const std::vector<double> p = parse_numbers(seen.central ? view.substr(4) : view, 3, "--silhouette");
    seen.direction_or_eye = {p[0], p[1], p[2]};
  }
  return seen;
}

ordered_json silhouette_seen(const std::string& name, const render::Entity& entity, const std::string& view,
                             const render::Camera* camera, int samples) {
  const geometry::ViewOf seen = view_asked(view, camera);
  return asked(name, "silhouette", view, [&] {
    if (const BodyPtr* body = std::get_if<BodyPtr>(&entity))
      return rows(silhouette(**body, seen), **body, nullptr, samples);
    return rows(silhouette(surface_of(name, entity), seen), samples);
  });
}

void print_contours(const ordered_json& found) {
  const size_t branches = found["branches"].size(), points = found["points"].size();
  for (const char* key : {"with", "section", "silhouette"})
    if (found.contains(key))
      fmt::print("'{}' {} {}: {} branch{}, {} singular point{}{}{}\n", found["name"].get<std::string>(), key,
                 found[key] == found["name"] ? "itself" : fmt::format("'{}'", found[key].get<std::string>()), branches,
                 branches == 1 ? "" : "es", points, points == 1 ? "" : "s",
                 found["coincident"].get<bool>() ? "; they coincide in part" : "",
                 found["complete"].get<bool>() ? "" : "; incomplete: what nearly touches or coincides is left out");
  int number = 0;
  for (const ordered_json& branch : found["branches"]) {
    const std::string kind = branch["kind"];
    fmt::print("  {} {:<7}{} length {}   error {:.2g}   off by {:.2g}\n", ++number,
               branch["closed"].get<bool>() ? "closed" : "open", kind == "crossing" ? "" : kind + "  ",
               digits(branch["length"].get<double>()), branch["length_error"].get<double>(),
               branch["error"].get<double>());
    if (branch.contains("parts")) {
      for (const ordered_json& part : branch["parts"])
        fmt::print("    {}{}: {} to {}\n", part["face"].get<std::string>(),
                   part.contains("face_other") ? " and " + part["face_other"].get<std::string>() : "",
                   digits(vector_of(part["begin"])), digits(vector_of(part["end"])));
    } else if (branch.contains("samples")) {
      for (const ordered_json& row : branch["samples"]) print_row("", row);
    } else {
      print_row("begin", branch["begin"]);
      if (!branch["closed"].get<bool>()) print_row("end", branch["end"]);
    }
    if (branch.contains("cusps"))
      for (const ordered_json& row : branch["cusps"]) print_row("cusp", row);
  }
  for (const ordered_json& point : found["points"])
    fmt::print("  {:<9} {}{}\n", point["kind"].get<std::string>(), digits(vector_of(point["point"])),
               parameters(point));
}

}  // namespace lekalo::command
