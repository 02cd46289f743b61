// The section `attributes`: what is said of bodies and their faces and edges, of surfaces, curves, shapes and meshes.
//
//   { of: part, density: 7850, material: steel }
//   { of: part.top, temperature: 80 }        a face, by name
//   { of: { of: part, extreme: z }, ... }    or by conditions
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/bodies/booleans/solid_boundary.h"
#include "geometry/expression/nearest_name.h"
#include "geometry/queries/measures/mass_properties.h"
#include "render/materials/materials.h"
#include "render/model/face_materials.h"
#include "render/model/section_faces.h"
#include "render/scene/build/builder.h"
#include "render/scene/types/sections.h"
#include "render/scene/values/words.h"

namespace lekalo::render {

using geometry::BodyPtr;
using geometry::Element;
using Kind = ElementId::Kind;

namespace {

constexpr size_t kMaxNames = 5;  // in hints

std::vector<std::string> usual_names() {
  std::vector<std::string> names;
  for (const Field& field : section_declaration("attributes").fields) names.push_back(field.name);
  return names;
}

// What clear air is: light goes through and nothing comes back.
MaterialPtr clear() {
  ClassicLook look;
  look.ambient = look.diffuse = 0.0;
  look.transmission = 1.0;
  static const MaterialPtr material = make_material(look);
  return material;
}

MaterialPtr made_transparent(const MaterialPtr& material, double transparency) {
  if (transparency == 0) return material;
  return transparency == 1 ? clear() : make_material(Mix{material, clear(), transparency});
}

NamedElement element_of_body(const void* thing, const BodyPtr& body, Element element, int index,
                             const std::string& whole) {
  const Kind kind = element == Element::face ? Kind::face : Kind::edge;
  return {{thing, kind, index}, whole + "." + geometry::name_of(*body, element, index), body};
}

}  // namespace

const AttributeTable& Builder::attributes() {
  if (attributes_) return *attributes_;
  attributes_ = std::make_shared<AttributeTable>();
  const Value* list = section("attributes");
  if (!list) return *attributes_;
  // To say something of a thing is no use of it, and what is said is said of things as they are named.
  const bool uses = std::exchange(names_use_, false), in_geometry = std::exchange(in_geometry_, false);
  each_item(*list, {}, [&](const Value& item, const Counters& counters) { read_attributes(item, counters); });
  names_use_ = uses;
  in_geometry_ = in_geometry;
  return *attributes_;
}

void Builder::read_attributes(const Value& map, const Counters& counters) {
  const Value* of = map.is_map() ? map.find("of") : nullptr;
  if (!of) {
    if (!map.invalid)
      diagnostics_.error(map.place, "'attributes' is a list of maps, each with 'of': the elements that it speaks of",
                         "write - { of: part, density: 7850 }");
    return;
  }
  ElementAttributes said;
  const bool good = read_numbers_of(map, counters, said);
  const auto elements = elements_of(*of, counters);
  if (!good || !elements) return;
  if (said.numbers.empty() && !said.material) {
    diagnostics_.error(map.place, "this says nothing of its elements",
                       "density: 7850, temperature: 20, material: NAME");
    return;
  }
  for (const NamedElement& element : *elements) attributes_->add(element, said);
}

// The usual quantities as they are declared; any other name is a number without a unit.
bool Builder::read_numbers_of(const Value& map, const Counters& counters, ElementAttributes& into) {
  const std::vector<std::string> usual = usual_names();
  std::vector<std::string> others{"repeat"};
  bool good = true;
  for (const Entry& entry : map.entries) {
    const std::string& name = entry.key.name;
    if (name == "repeat" || std::find(usual.begin(), usual.end(), name) != usual.end()) continue;
    others.push_back(name);
    if (const auto meant = geometry::nearest_name(name, usual)) {
      diagnostics_.error(entry.key.place, fmt::format("unknown attribute '{}' (did you mean '{}'?)", name, *meant),
                         "a quantity of your own needs a name that is less like it");
      good = false;
    } else if (const auto number = parameters_.number(entry.value, counters)) {
      into.numbers[name] = *number;
    } else {
      good = false;
    }
  }
  std::vector<Field> declared = section_declaration("attributes").fields;
  std::erase_if(declared, [](const Field& field) { return field.name == "of"; });
  others.emplace_back("of");
  const auto fields = read_fields(declared, map, counters, "'attributes'", others);
  if (!fields) return false;
  for (const Field& field : declared)
    if (fields->has(field.name) && field.name != "material") into.numbers[field.name] = fields->number(field.name);
  if (!fields->has("material")) return good;
  into.material = fields->get<MaterialPtr>("material");
  if (const Value* material = map.find("material"); material->is_scalar()) into.material_name = material->text;
  return good;
}

std::optional<std::vector<NamedElement>> Builder::elements_of(const Value& value, const Counters& counters) {
  std::vector<NamedElement> all;
  bool good = true;
  each_item(value, counters, [&](const Value& written, const Counters& inner) {
    const auto some = elements_of_item(written, inner);
    good = good && some;
    if (some) all.insert(all.end(), some->begin(), some->end());
  });
  return good ? std::optional(std::move(all)) : std::nullopt;
}

std::optional<std::vector<NamedElement>> Builder::elements_of_item(const Value& written, const Counters& counters) {
  const Value& item = with_counters(written, counters);
  if (item.invalid) return std::nullopt;
  if (item.is_map() && !is_selector(item)) {
    diagnostics_.error(item.place, "attributes are those of named things", "give it a name in 'geometry'");
    return std::nullopt;
  }
  return item.is_map() ? elements_selected(item, counters) : elements_named(item);
}

// The entry of the thing, or of its family, that an item of `of` names; null: none.
const Entry* Builder::thing_named(const Value& written, const Counters& counters) {
  const Value& item = with_counters(written, counters);
  const Value* of = is_selector(item) ? item.find("of") : nullptr;
  const Value& name = of ? with_counters(*of, counters) : item;
  const Value* things = section("geometry");
  if (!name.is_scalar() || name.invalid || !things || !things->is_map()) return nullptr;
  return find_named(*things, name.text, name.place.file ? name.place.file->scope : "").entry;
}

// A body, or the boundary of a solid that is put together.
std::optional<BodyPtr> Builder::faces_of(const Built& whole, const Value& asked) {
  static const Category bodies[] = {Category::body};
  const auto fitting = as_wanted(whole, asked, bodies);
  if (!fitting) return std::nullopt;
  if (const auto* body = std::any_cast<BodyPtr>(&fitting->value)) return *body;
  diagnostics_.error(asked.place,
                     fmt::format("this is {}: it has no faces and edges of its own", describe({&whole.category, 1})));
  return std::nullopt;
}

std::optional<std::vector<NamedElement>> Builder::elements_named(const Value& name) {
  const auto parts = parts_named(name, geometry_categories());
  if (!parts) return std::nullopt;
  std::vector<NamedElement> all;
  for (const NamedPart& one : *parts) {
    const Built& whole = one.member->built;
    const std::string& family = one.thing->entry->key.name;
    const std::string full = one.member->name.empty() ? family : family + "." + one.member->name;
    const void* thing = identity(entity_of(whole.value));
    if (!thing || whole.category == Category::group) {
      diagnostics_.error(name.place,
                         fmt::format("'{}' is {}: it carries no attributes", full, describe({&whole.category, 1})),
                         "they are those of bodies, their faces and edges, of surfaces, curves, shapes and meshes");
      return std::nullopt;
    }
    if (one.part.empty()) {
      all.push_back({{thing}, full, {}});
      continue;
    }
    const auto body = faces_of(whole, name);
    if (!body) return std::nullopt;
    std::vector<int> found = geometry::called(**body, Element::face, one.part);
    const Element element = found.empty() ? Element::edge : Element::face;
    if (found.empty()) found = geometry::called(**body, Element::edge, one.part);
    if (found.empty()) {
      const std::vector<std::string> names = geometry::names_of(**body, Element::face);
      diagnostics_.error(name.place,
                         fmt::format("'{}' has no face or edge '{}'{}", full, one.part, suggestion(one.part, names)),
                         "the nearest are " + listed(geometry::nearest_names(one.part, names, kMaxNames)));
      return std::nullopt;
    }
    for (const int index : found) all.push_back(element_of_body(thing, *body, element, index, full));
  }
  return all;
}

// Faces, unless the conditions speak of edges.
std::optional<std::vector<NamedElement>> Builder::elements_selected(const Value& map, const Counters& counters) {
  static const Category solids[] = {Category::body, Category::shape};
  const Value& of = with_counters(*map.find("of"), counters);
  if (!of.is_scalar() || of.invalid) {
    if (!of.invalid)
      diagnostics_.error(of.place, "attributes are those of named things", "give the body a name in 'geometry'");
    return std::nullopt;
  }
  const auto whole = refer(of, counters, solids);
  const auto body = whole ? faces_of(*whole, of) : std::nullopt;
  const auto selector = read_selector(map, counters);
  if (!body || !selector) return std::nullopt;
  if (map.find("vertex")) {
    diagnostics_.error(map.place, "vertices carry no attributes", "say it of a face or an edge");
    return std::nullopt;
  }
  const Element element = map.find("edge") || map.find("between") ? Element::edge : Element::face;
  const auto found = attempt(map, "selector", [&] { return geometry::select(**body, element, *selector); });
  if (!found) return std::nullopt;
  if (found->empty()) {
    diagnostics_.error(map.place, "nothing of the body is like that",
                       "'lekalo measure --topology' lists its faces, edges and vertices");
    return std::nullopt;
  }
  const void* thing = identity(entity_of(whole->value));
  std::vector<NamedElement> all;
  for (const int index : *found) all.push_back(element_of_body(thing, *body, element, index, of.text));
  return all;
}

MaterialPtr Builder::material_of_shape(const Entity& shape) {
  const ElementAttributes* said = attributes().own({identity(shape)});
  return said ? said->material : nullptr;
}

void Builder::dress(Object& object) {
  const AttributeTable& table = attributes();
  const Entity shape = before_section(object);
  const void* thing = identity(shape);
  if (!table.speaks_of(thing)) return;
  const auto transparent = [&](const MaterialPtr& material, const ElementId& id) {
    const auto found = table.of(id, "transparency");
    try {
      return found ? made_transparent(material, found->value) : material;
    } catch (const std::invalid_argument& error) {
      diagnostics_.error(section("attributes")->place,
                         fmt::format("the transparency of '{}': {}", found->of, error.what()),
                         "leave it out where the material is clear by itself");
      return material;
    }
  };
  const MaterialPtr plain = object.material;
  std::map<int, MaterialPtr> of_faces;
  bool has_faces = false;
  for (auto at = table.elements().lower_bound(ElementId{thing, Kind::face}); at != table.elements().end(); ++at) {
    const auto& [id, said] = *at;
    if (id.thing != thing || id.kind != Kind::face) break;
    has_faces = true;
    if (said.material || said.numbers.contains("transparency"))
      of_faces[id.index] = transparent(said.material ? said.material : plain, id);
  }
  object.material = transparent(plain, {thing});
  if (object.back_material)
    object.back_material = object.back_material == plain ? object.material : transparent(object.back_material, {thing});
  if (!of_faces.empty()) object.material = std::make_shared<FaceMaterials>(object.material, std::move(of_faces));
  // The faces that are numbered are those of its boundary.
  if (const auto* solid = std::get_if<geometry::ShapePtr>(&shape); solid && has_faces) {
    const BodyPtr boundary = geometry::boundary_of(*solid);
    attributes_->copy(thing, boundary.get());
    put_before_section(object, boundary);
  }
  renumber_face_materials(object);
}

// One number of one thing and its faces and edges: what else is said may be of things that are built with this number.
std::optional<AttributeTable> Builder::said_of(const Entry* thing, const std::string& name) {
  AttributeTable table;
  bool good = true;
  each_item(*section("attributes"), {}, [&](const Value& item, const Counters& counters) {
    const Value* of = item.is_map() ? item.find("of") : nullptr;
    if (!of || !item.find(name)) return;
    Value only = item;
    std::erase_if(only.entries, [&](const Entry& entry) { return entry.key.name != name; });
    each_item(*of, counters, [&](const Value& one, const Counters& inner) {
      if (thing_named(one, inner) != thing) return;
      ElementAttributes said;
      const auto elements = elements_of_item(one, inner);
      good = elements && read_numbers_of(only, counters, said) && good;
      if (good)
        for (const NamedElement& element : *elements) table.add(element, said);
    });
  });
  return good ? std::optional(std::move(table)) : std::nullopt;
}

// Every name of a number that the section gives.
std::vector<std::string> Builder::names_of_attributes() {
  std::set<std::string> names;
  each_item(*section("attributes"), {}, [&](const Value& item, const Counters&) {
    for (const Entry& entry : item.entries) names.insert(entry.key.name);
  });
  for (const char* other : {"of", "repeat", "material"}) names.erase(other);
  return {names.begin(), names.end()};
}

std::optional<MeasuredQuantity> Builder::quantity_of_element(const QuantityOfElement& asked, const Value& map) {
  const Value& of = *map.find("of");
  if (!section("attributes")) {
    diagnostics_.error(map.place, "the scene says no attributes", "attributes: [{ of: part, density: 7850 }]");
    return std::nullopt;
  }
  const auto elements = elements_of(of, {});
  if (!elements) return std::nullopt;
  if (elements->size() != 1) {
    std::vector<std::string> names;
    for (const NamedElement& one : *elements) names.push_back(one.name);
    diagnostics_.error(of.place, fmt::format("{} things are meant by this; one is wanted here", names.size()),
                       names.empty() ? "" : "they are " + listed(names, kMaxNames));
    return std::nullopt;
  }
  const NamedElement& element = elements->front();
  const std::string name = asked.body ? "density" : asked.attribute;
  const auto table = said_of(thing_named(of, {}), name);
  if (!table) return std::nullopt;
  const auto found = table->of(element.id, name, element.body.get());
  if (!found) {
    const std::vector<std::string> names = names_of_attributes();
    const Value* place = map.find("name");
    diagnostics_.error(place ? place->place : of.place,
                       fmt::format("'{}' has no attribute '{}'{}", element.name, name, suggestion(name, names)),
                       names.empty() ? "" : "the scene's attributes are " + listed(names));
    return std::nullopt;
  }
  if (!asked.body) return MeasuredQuantity{found->value};
  const Value* info = section("info");
  const Value* unit = info && info->is_map() ? info->find("unit") : nullptr;
  const auto metres = metres_of(unit ? unit->text : "");
  if (!metres) {
    diagnostics_.error(unit->place,
                       fmt::format("a mass needs a unit of length, and '{}' is none that is known", unit->text),
                       "mm, cm, m, in, ft, ...");
    return std::nullopt;
  }
  return MeasuredQuantity{found->value * geometry::measure(*asked.body).volume.value * std::pow(*metres, 3)};
}

}  // namespace lekalo::render
