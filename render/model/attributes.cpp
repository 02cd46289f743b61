#include "render/model/attributes.h"

#include <algorithm>
#include <set>
#include <utility>

#include "render/model/length_unit.h"

namespace lekalo::render {

using geometry::Body;

const std::vector<UsualAttribute>& usual_attributes() {
  constexpr double kInfinity = geometry::kInfinity;
  static const std::vector<UsualAttribute> all = {
      {"density", "kg/m^3", "mass of a cubic metre", 0, kInfinity},
      {"elastic_modulus", "Pa", "Young's modulus", 0, kInfinity},
      {"shear_modulus", "Pa", "shear modulus", 0, kInfinity},
      {"poisson_ratio", "", "Poisson's ratio", -1, 0.5},
      {"yield_strength", "Pa", "stress at which it begins to flow", 0, kInfinity},
      {"temperature", "°C", "temperature", -273.15, kInfinity},
      {"thermal_conductivity", "W/(m K)", "thermal conductivity", 0, kInfinity},
      {"heat_capacity", "J/(kg K)", "specific heat", 0, kInfinity},
      {"thermal_expansion", "1/K", "coefficient of linear expansion", -kInfinity, kInfinity},
      {"electrical_conductivity", "S/m", "electrical conductivity", 0, kInfinity},
      {"friction", "", "coefficient of friction", 0, kInfinity},
      {"transparency", "", "share of the light that passes straight through; the rest falls on its material", 0, 1}};
  return all;
}

std::string unit_of_attribute(const std::string& name) {
  for (const UsualAttribute& usual : usual_attributes())
    if (usual.name == name) return usual.unit;
  return {};
}

std::string title_of_attribute(const std::string& name) {
  std::string title = name;
  std::replace(title.begin(), title.end(), '_', ' ');
  const std::string unit = unit_of_attribute(name);
  return unit.empty() ? title : title + ", " + unit;
}

void AttributeTable::add(const NamedElement& element, const ElementAttributes& said) {
  ElementAttributes& known = elements_[element.id];
  if (known.name.empty()) known.name = element.name;
  for (const auto& [name, value] : said.numbers) known.numbers[name] = value;
  if (!said.material) return;
  known.material = said.material;
  known.material_name = said.material_name;
}

void AttributeTable::copy(const void* from, const void* to) {
  std::vector<std::pair<ElementId, ElementAttributes>> copies;
  for (const auto& [id, said] : elements_)
    if (id.thing == from) copies.push_back({{to, id.kind, id.index}, said});
  elements_.insert(copies.begin(), copies.end());
}

bool AttributeTable::speaks_of(const void* thing) const {
  const auto first = elements_.lower_bound(ElementId{thing});
  return first != elements_.end() && first->first.thing == thing;
}

const ElementAttributes* AttributeTable::own(const ElementId& id) const {
  const auto found = elements_.find(id);
  return found == elements_.end() ? nullptr : &found->second;
}

std::vector<std::string> AttributeTable::names() const {
  std::set<std::string> all;
  for (const auto& [id, said] : elements_)
    for (const auto& [name, value] : said.numbers) all.insert(name);
  return {all.begin(), all.end()};
}

std::optional<Attribute> AttributeTable::of(const ElementId& id, const std::string& name, const Body* body) const {
  if (const ElementAttributes* said = own(id))
    if (const auto found = said->numbers.find(name); found != said->numbers.end())
      return Attribute{found->second, said->name};
  if (id.kind == ElementId::Kind::whole) return std::nullopt;
  const auto of_whole = [&] { return of(ElementId{id.thing}, name); };
  if (id.kind == ElementId::Kind::face || !body) return of_whole();
  std::optional<Attribute> common;
  for (const int face : geometry::faces_beside(*body, id.index)) {
    const auto one = of(ElementId{id.thing, ElementId::Kind::face, face}, name);
    if (!one || (common && common->value != one->value)) return of_whole();
    if (!common) common = one;
  }
  return common ? common : of_whole();
}

std::map<std::string, Attribute> AttributeTable::of(const ElementId& id, const Body* body) const {
  std::map<std::string, Attribute> all;
  for (const std::string& name : names())
    if (const auto found = of(id, name, body)) all[name] = *found;
  return all;
}

std::optional<double> metres_of(const std::string& unit) {
  const auto millimetres = unit.empty() ? std::optional(1000.0) : millimetres_of(unit);
  return millimetres ? std::optional(*millimetres / 1000) : std::nullopt;
}

}  // namespace lekalo::render
