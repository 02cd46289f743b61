#include "render/scene/values/synonyms.h"

#include <algorithm>

namespace lekalo::render {

namespace {

struct Synonym {
  std::string_view word;
  std::vector<std::string_view> names;
};

const std::vector<Synonym>& types() {
  static const std::vector<Synonym> all{
      {"line", {"segment"}},
      {"line_segment", {"segment"}},
      {"polygonal_chain", {"polyline"}},
      {"arc", {"circular_arc"}},
      {"spline", {"nurbs_curve", "nurbs_surface"}},
      {"bspline", {"nurbs_curve", "nurbs_surface"}},
      {"b_spline", {"nurbs_curve", "nurbs_surface"}},
      {"bspline_curve", {"nurbs_curve"}},
      {"bspline_surface", {"nurbs_surface"}},
      {"nurbs", {"nurbs_curve", "nurbs_surface"}},
      {"function", {"formula_curve", "formula_surface"}},
      {"function_curve", {"formula_curve"}},
      {"function_plot", {"formula_curve"}},
      {"parametric", {"formula_curve", "formula_surface"}},
      {"parametric_curve", {"formula_curve"}},
      {"parametric_surface", {"formula_surface"}},
      {"implicit_surface", {"implicit"}},
      {"isosurface", {"implicit"}},
      {"hyperboloid", {"hyperboloid_one_sheet", "hyperboloid_two_sheets"}},
      {"paraboloid", {"elliptic_paraboloid", "hyperbolic_paraboloid"}},
      {"saddle", {"hyperbolic_paraboloid"}},
      {"cube", {"box"}},
      {"cuboid", {"box"}},
      {"block", {"box"}},
      {"sphere", {"ball", "sphere_surface"}},
      {"sphere_body", {"ball"}},
      {"frustum", {"cone_body"}},
      {"extrude", {"extrusion_body", "extrusion_surface"}},
      {"linear_extrude", {"extrusion_body", "extrusion_surface"}},
      {"revolve", {"revolution_body", "revolution_surface"}},
      {"rotate_extrude", {"revolution_body", "revolution_surface"}},
      {"lathe", {"revolution_body", "revolution_surface"}},
      {"fuse", {"union"}},
      {"unite", {"union"}},
      {"add", {"union"}},
      {"merge", {"union"}},
      {"cut", {"difference", "cut_body"}},
      {"subtract", {"difference"}},
      {"subtraction", {"difference"}},
      {"common", {"intersection"}},
      {"intersect", {"intersection"}},
      {"round", {"fillet_body", "rounded_corners"}},
      {"bevel", {"chamfer_body"}},
      {"metal", {"conductor"}},
      {"glass", {"dielectric"}},
      {"matte", {"diffuse"}},
      {"text", {"label"}},
      {"dimension", {"linear_dimension"}},
      {"orthographic", {"parallel"}},
      {"orthogonal", {"parallel"}},
      {"isometric", {"parallel"}},
      {"pinhole", {"perspective"}},
      {"directional_light", {"distant_light"}},
      {"area_light", {"rectangle_light", "disc_light"}},
  };
  return all;
}

const std::vector<Synonym>& fields() {
  static const std::vector<Synonym> all{
      {"position", {"from", "center", "at"}},
      {"location", {"from", "center", "at"}},
      {"origin", {"from", "center"}},
      {"eye", {"from"}},
      {"look_from", {"from"}},
      {"start", {"from"}},
      {"end", {"to"}},
      {"look_at", {"at"}},
      {"target", {"at", "to"}},
      {"fov", {"field_of_view"}},
      {"fovy", {"field_of_view"}},
      {"vertices", {"points"}},
      {"control_points", {"points"}},
      {"poles", {"points"}},
      {"r", {"radius"}},
      {"rounding", {"radius"}},
      {"color", {"reflectance", "albedo"}},
      {"label", {"text"}},
      {"text", {"label"}},
      {"tool", {"minus"}},
      {"subtract", {"minus"}},
  };
  return all;
}

std::span<const std::string_view> found_in(const std::vector<Synonym>& table, std::string_view word) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const Synonym& one) { return one.word == word; });
  return found == table.end() ? std::span<const std::string_view>() : std::span(found->names);
}

}  // namespace

std::span<const std::string_view> types_called(std::string_view word) { return found_in(types(), word); }

std::string_view field_called(std::string_view word, const std::vector<std::string>& known) {
  for (const std::string_view name : found_in(fields(), word))
    if (std::find(known.begin(), known.end(), name) != known.end()) return name;
  return {};
}

}  // namespace lekalo::render
