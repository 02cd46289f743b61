// Sections and outlines of what has no faces of its own: solids put together of others, formulas, tubes, balls, meshes.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <stdexcept>

#include "command.h"
#include "geometry/queries/contours/mesh_contours.h"
#include "geometry/queries/measures/mass_properties.h"
#include "geometry/shapes/csg/csg_contours.h"
#include "geometry/shapes/implicit/implicit_contours.h"
#include "geometry/shapes/tube/ball_outlines.h"
#include "geometry/transformed.h"
#include "measure.h"

namespace lekalo::command {

namespace {

using geometry::Affine;
using geometry::CurvePtr;
using geometry::Vec3;
using geometry::ViewOf;

struct Found {
  std::vector<CurvePtr> lines;
  bool complete = true;
};

// Section where there is a normal, else the outline as seen.
struct Asked {
  Vec3 through{0}, normal{0};
  ViewOf view;
  bool section = false;
};

void take(const geometry::ShapeOutlines& outlines, bool edges, Found& found) {
  found.complete = found.complete && outlines.complete;
  for (const geometry::ShapeOutline& line : outlines.lines)
    if (line.edge == edges) found.lines.push_back(line.curve);
}

void take(const geometry::ImplicitContours& contours, Found& found) {
  found.complete = found.complete && contours.complete;
  for (const geometry::ImplicitContour& line : contours.lines) found.lines.push_back(line.curve);
}

void take(const geometry::CsgLines& lines, geometry::CsgLine::Kind kind, Found& found) {
  found.complete = found.complete && lines.complete && lines.left_out.empty();
  for (const geometry::CsgLine& line : lines.lines)
    if (line.kind == kind) found.lines.push_back(line.curve);
}

Found lines_of(const geometry::Shape& shape, const Asked& asked) {
  Found found;
  if (const auto* formula = dynamic_cast<const geometry::ImplicitSurface*>(&shape)) {
    take(asked.section ? plane_section(*formula, asked.through, asked.normal, asked.view)
                       : silhouette(*formula, asked.view),
         found);
  } else if (const auto* balls = dynamic_cast<const geometry::Balls*>(&shape)) {
    asked.section ? take(plane_section(*balls, asked.through, asked.normal, asked.view), true, found)
                  : take(outlines(*balls, asked.view), false, found);
  } else if (const auto* tube = dynamic_cast<const geometry::Tube*>(&shape)) {
    asked.section ? take(plane_section(*tube, asked.through, asked.normal, asked.view), true, found)
                  : take(outlines(*tube, asked.view), false, found);
  } else if (const auto* solid = dynamic_cast<const geometry::Csg*>(&shape)) {
    asked.section
        ? take(csg_section(*solid, asked.through, asked.normal, asked.view), geometry::CsgLine::Kind::section, found)
        : take(csg_lines(*solid, asked.view), geometry::CsgLine::Kind::silhouette, found);
  } else {
    throw std::invalid_argument("of this shape neither sections nor silhouettes are known");
  }
  return found;
}

Found lines_of(const render::Entity& entity, Asked asked) {
  Found found;
  if (const auto* mesh = std::get_if<geometry::MeshPtr>(&entity)) {
    if (asked.section) return {plane_section(**mesh, asked.through, asked.normal), true};
    for (const geometry::MeshLine& line : mesh_lines(**mesh, asked.view))
      if (line.kind == geometry::MeshLineKind::silhouette) found.lines.push_back(line.curve);
    return found;
  }
  const geometry::Shape& shape = **std::get_if<geometry::ShapePtr>(&entity);
  const auto* moved = dynamic_cast<const geometry::TransformedShape*>(&shape);
  if (!moved) return lines_of(shape, asked);
  const Affine& map = moved->map();
  const Affine back = map.inverse();
  asked.through = back.point(asked.through);
  asked.normal = glm::transpose(map.linear) * asked.normal;
  asked.view.direction_or_eye = asked.view.central ? back.point(asked.view.direction_or_eye)
                                                   : glm::normalize(back.direction(asked.view.direction_or_eye));
  found = lines_of(*moved->original(), asked);
  for (CurvePtr& line : found.lines) line = transformed(line, map);
  return found;
}

ordered_json as_json(const CurvePtr& line, double size, int samples) {
  const geometry::Interval t = line->domain();
  const geometry::CurveMeasures measured = geometry::measure(*line);
  const Vec3 begin = line->point(t.lo), end = line->point(t.hi);
  ordered_json row{{"kind", "crossing"},
                   {"closed", glm::length(end - begin) <= geometry::kSamePoint * size},
                   {"length", measured.length.value},
                   {"length_error", measured.length.error},
                   {"error", geometry::kSamePoint * size}};
  row["begin"]["point"] = to_json(begin);
  row["end"]["point"] = to_json(end);
  for (int k = 0; k < samples; ++k)
    row["samples"].push_back({{"point", to_json(line->point(t.lo + t.width() * k / (samples - 1)))}});
  return row;
}

ordered_json answer(const std::string& name, const char* key, const std::string& with, const render::Entity& entity,
                    const Asked& asked, int samples) {
  ordered_json out{{"name", name}, {key, with}};
  try {
    const Found found = lines_of(entity, asked);
    const double size = render::bounds(entity).diameter();
    double length = 0;
    out["branches"] = ordered_json::array();
    for (const CurvePtr& line : found.lines) {
      out["branches"].push_back(as_json(line, size, samples));
      length += out["branches"].back()["length"].get<double>();
    }
    out["length"] = length;
    out["points"] = ordered_json::array();
    out["coincident"] = false;
    out["complete"] = found.complete;
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("'{}': {}", name, error.what()));
  }
  return out;
}

}  // namespace

bool is_solid_without_faces(const render::Entity& entity) {
  return std::holds_alternative<geometry::ShapePtr>(entity) || std::holds_alternative<geometry::MeshPtr>(entity);
}

ordered_json section_of_solid(const std::string& name, const render::Entity& entity, const std::string& plane,
                              int samples) {
  const std::vector<double> p = parse_numbers(plane, 6, "--section");
  Asked asked;
  asked.through = {p[0], p[1], p[2]}, asked.normal = {p[3], p[4], p[5]};
  if (!(glm::length(asked.normal) > 0)) throw UsageError("--section: the plane's normal has no length");
  asked.view.direction_or_eye = glm::normalize(asked.normal);
  asked.section = true;
  ordered_json out = answer(name, "section", plane, entity, asked, samples);
  put_plane_coordinates(out, asked.through, asked.normal);
  return out;
}

ordered_json silhouette_of_solid(const std::string& name, const render::Entity& entity, const std::string& view,
                                 const render::Camera* camera, int samples) {
  Asked asked;
  asked.view = view_asked(view, camera);
  return answer(name, "silhouette", view, entity, asked, samples);
}

}  // namespace lekalo::command
