// What a scene says of an element beside its shape, and the mass of what has a density.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "command.h"
#include "geometry/bodies/topology/selection.h"
#include "measure.h"
#include "render/model/objects.h"

namespace lekalo::command {

namespace {

using geometry::Body;
using geometry::Element;
using render::AttributeTable;
using render::ElementAttributes;
using render::ElementId;
using Kind = render::ElementId::Kind;

struct FoundElement {
  ElementId id;
  geometry::BodyPtr body;  // of faces and edges
};

// A thing by its name, or part.end, part.edge.3: a face or edge of one.
FoundElement element_called(const render::LoadedScene& scene, const std::string& name) {
  const auto& geometry = scene.model->geometry;
  if (const auto whole = geometry.find(name); whole != geometry.end()) return {{render::identity(whole->second)}, {}};
  for (size_t dot = name.rfind('.'); dot != std::string::npos && dot > 0; dot = name.rfind('.', dot - 1)) {
    const auto whole = geometry.find(name.substr(0, dot));
    if (whole == geometry.end()) continue;
    const render::Entity boundary = by_boundary(whole->second);
    const auto* body = std::get_if<geometry::BodyPtr>(&boundary);
    if (!body) break;
    const void* thing = render::identity(whole->second);
    const std::string part = name.substr(dot + 1);
    for (const auto& [element, kind] : {std::pair(Element::face, Kind::face), std::pair(Element::edge, Kind::edge)})
      if (const auto found = called(**body, element, part); found.size() == 1) return {{thing, kind, found[0]}, *body};
    break;
  }
  return {};
}

ordered_json as_json(const std::string& name, const render::Attribute& attribute) {
  ordered_json row{{"value", attribute.value}};
  if (const std::string unit = render::unit_of_attribute(name); !unit.empty()) row["unit"] = unit;
  row["of"] = attribute.of;
  return row;
}

// The material of the element, or of the thing that it belongs to.
void put_material(ordered_json& out, const AttributeTable& table, const ElementId& id) {
  for (const ElementId& one : {id, ElementId{id.thing}}) {
    const ElementAttributes* said = table.own(one);
    if (!said || !said->material || said->material_name.empty()) continue;
    out["material"] = {{"value", said->material_name}, {"of", said->name}};
    return;
  }
}

}  // namespace

void put_attributes(ordered_json& out, const render::SceneWithAttributes& scene, const std::string& name) {
  const FoundElement element = element_called(scene, name);
  if (!element.id.thing) return;
  ordered_json all = ordered_json::object();
  for (const auto& [key, attribute] : scene.attributes.of(element.id, element.body.get()))
    all[key] = as_json(key, attribute);
  put_material(all, scene.attributes, element.id);
  if (all.empty()) return;
  out["attributes"] = all;
  if (!all.contains("density") || !out.contains("volume") || !(out["volume"].get<double>() > 0)) return;
  const auto metre = render::metres_of(scene.model->unit);
  if (!metre) {
    out["without_mass"] = fmt::format("'{}' (info.unit) is no known unit of length", scene.model->unit);
    return;
  }
  const double to_mass = all["density"]["value"].get<double>() * std::pow(*metre, 3);
  const double to_inertia = to_mass * std::pow(*metre, 2);
  out["mass"] = to_mass * out["volume"].get<double>();
  out["mass_error"] = to_mass * out["volume_error"].get<double>();
  if (!out.contains("inertia")) return;
  ordered_json inertia = out["inertia"], moments = out["principal_moments"];
  for (ordered_json& row : inertia)
    for (ordered_json& one : row) one = to_inertia * one.get<double>();
  for (ordered_json& one : moments) one = to_inertia * one.get<double>();
  out["mass_inertia"] = inertia;
  out["mass_inertia_error"] = to_inertia * out["inertia_error"].get<double>();
  out["mass_principal_moments"] = moments;
}

void print_attributes(const ordered_json& attributes) {
  fmt::print("attributes\n");
  for (const auto& [name, row] : attributes.items()) {
    const ordered_json& value = row["value"];
    std::string text = value.is_string() ? value.get<std::string>() : digits(value.get<double>());
    if (row.contains("unit")) text += " " + row["unit"].get<std::string>();
    fmt::print("  {:<16} {}   of {}\n", name, text, row["of"].get<std::string>());
  }
}

ordered_json attributes_of_elements(const render::SceneWithAttributes& scene) {
  ordered_json rows = ordered_json::array();
  for (const auto& [id, said] : scene.attributes.elements()) {
    ordered_json row{{"of", said.name},
                     {"kind", id.kind == Kind::face   ? "face"
                              : id.kind == Kind::edge ? "edge"
                                                      : "thing"}};
    for (const auto& [name, value] : said.numbers) row["attributes"][name] = as_json(name, {value, said.name});
    if (!said.material_name.empty()) row["attributes"]["material"] = {{"value", said.material_name}};
    rows.push_back(std::move(row));
  }
  std::sort(rows.begin(), rows.end(), [](const ordered_json& a, const ordered_json& b) { return a["of"] < b["of"]; });
  // A solid that is put together and its boundary have the same elements.
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

}  // namespace lekalo::command
