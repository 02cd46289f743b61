// The sections of a scene file, made into a Model, and the defaults that make three lines a good picture.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/expression/nearest_name.h"
#include "render/cameras/cameras.h"
#include "render/model/objects.h"
#include "render/model/section_faces.h"
#include "render/scene/build/builder.h"
#include "render/scene/types/panels.h"
#include "render/scene/types/sections.h"
#include "render/scene/values/scalars.h"
#include "render/scene/values/words.h"

namespace lekalo::render {

using Shape = SectionDeclaration::Shape;

namespace {

// The section with a field of this name, if there is just one.
std::string section_that_takes(std::string_view field) {
  std::string found;
  for (const SectionDeclaration& declared : sections())
    for (const Field& one : declared.fields)
      if (one.name == field) {
        if (!found.empty()) return {};
        found = declared.name;
      }
  return found;
}

std::vector<std::string> section_names() {
  std::vector<std::string> names;
  for (const SectionDeclaration& declared : sections()) names.push_back(declared.name);
  return names;
}

// Sections that stand in the scene under a name much like theirs, by what they are meant to be. They are read as that,
// so that an error in a section's name is not followed by one for every name in it.
std::map<std::string, const Value*, std::less<>> misspelt_sections(const Value& root) {
  std::map<std::string, const Value*, std::less<>> result;
  const std::vector<std::string> known = section_names();
  for (const Entry& entry : root.entries) {
    const auto meant = geometry::nearest_name(entry.key.name, known);
    if (meant && !root.find(*meant)) result.emplace(*meant, &entry.value);
  }
  return result;
}

}  // namespace

Builder::Builder(const SceneDescription& scene, const BuildOptions& options, Diagnostics& diagnostics)
    : scene_(scene),
      options_(options),
      diagnostics_(diagnostics),
      misspelt_sections_(misspelt_sections(scene.root)),
      parameters_(section("parameters"), diagnostics) {
  merge_styles();
  parameters_.measure_by([this](const Value& map) { return measured(map); });
}

// To measure a thing is no use of it: it is shown all the same. It is measured as it is named, whatever it is for.
std::optional<MeasuredQuantity> Builder::measured(const Value& map) {
  static const Category wanted[] = {Category::quantity};
  const bool uses = std::exchange(names_use_, false), in_geometry = std::exchange(in_geometry_, false);
  std::optional<MeasuredQuantity> found;
  if (const auto built = build_typed(map, {}, wanted)) {
    const auto* of_element = std::any_cast<QuantityOfElement>(&built->value);
    found = of_element ? quantity_of_element(*of_element, map) : std::any_cast<MeasuredQuantity>(built->value);
  }
  names_use_ = uses;
  in_geometry_ = in_geometry;
  return found;
}

Model Builder::build() {
  Model model;
  if (!scene_.files.empty()) model.source = scene_.files.front()->name;
  check_sections();
  for (const SectionDeclaration& declared : sections())
    if (declared.shape == Shape::named) declare_section(declared.name.c_str());
  solve_constraints();
  model.parameters = parameters_.all();
  if (const Value* info = section("info"); info && info->is_map()) {
    const auto fields = read_fields(section_declaration("info").fields, *info, {}, "'info'");
    if (fields && fields->has("title")) model.title = fields->text("title");
    if (fields && fields->has("unit")) model.unit = fields->text("unit");
  }
  if (const Value* list = section("objects")) {
    if (auto objects = build_objects(*list)) model.objects = *std::move(objects);
  } else {
    default_objects(model);
  }
  fill_materials(model.objects);
  build_named(model);
  attributes();
  build_lights(model);
  build_camera(model);
  build_drawing(model);
  build_outputs(model);
  return model;
}

// Unknown sections, and those that are not what their declaration says.
void Builder::check_sections() {
  const std::vector<std::string> known = section_names();
  for (const Entry& entry : scene_.root.entries) {
    const auto found = std::find(known.begin(), known.end(), entry.key.name);
    if (found == known.end()) {
      const std::string meant = suggestion(entry.key.name, known);
      const std::string holder = section_that_takes(entry.key.name);
      diagnostics_.error(entry.key.place, fmt::format("unknown section '{}'{}", entry.key.name, meant),
                         !meant.empty() ? ""
                         : !holder.empty()
                             ? fmt::format("it belongs inside another: {}: {{ {}: ... }}", holder, entry.key.name)
                             : "sections are " + listed(known));
      continue;
    }
    const Shape shape = section_declaration(entry.key.name).shape;
    if ((shape == Shape::fields || shape == Shape::numbers) && !entry.value.is_map() && !entry.value.invalid)
      diagnostics_.error(entry.value.place,
                         fmt::format("'{}' is a map of fields, found {}", entry.key.name, kind_name(entry.value)),
                         fmt::format("write {}: {{ name: value, ... }}", entry.key.name));
  }
}

void Builder::visit_named(const char* section, Category category,
                          const std::function<void(const std::string&, const Built&)>& visit) {
  const std::span<const Category> wanted = is_geometry(category) ? geometry_categories() : std::span(&category, 1);
  for (auto& [name, thing] : sections_[section])
    for (NamedThing::Member& one : thing.members)
      if (const Built* built = member(thing, one, wanted))
        visit(one.name.empty() ? name : name + "." + one.name, *built);
}

// Everything that is named is built, so that errors in unused things are reported too.
void Builder::build_named(Model& model) {
  visit_named("geometry", Category::curve, [&](const std::string& name, const Built& built) {
    Entity entity = entity_of(built.value);
    if (auto* group = std::get_if<GroupPtr>(&entity)) *group = in_material(*group, default_material());
    model.geometry[name] = std::move(entity);
  });
  visit_named("materials", Category::material, [&](const std::string& name, const Built& built) {
    model.materials[name] = std::any_cast<MaterialPtr>(built.value);
  });
  visit_named("styles", Category::style, [&](const std::string& name, const Built& built) {
    Style& style = model.styles[name] = complete(std::any_cast<const StyleChanges&>(built.value));
    style.name = name;
  });
}

MaterialPtr Builder::default_material() {
  if (!default_material_) {
    const Category wanted[] = {Category::material};
    const auto built = build_typed(
        default_value("{ type: classic, color: '#b9c3cd', ambient: 1, diffuse: 1, specular: 0.1, exponent: 30 }"), {},
        wanted);
    if (built) default_material_ = std::any_cast<MaterialPtr>(built->value);
  }
  return default_material_;
}

// Objects without a material get that of their shape's attributes, else the neutral one; the members of a group without
// one get that of the object.
void Builder::fill_materials(std::vector<Object>& objects) {
  for (Object& object : objects) {
    if (!object.material) object.material = material_of_shape(before_section(object));
    if (!object.material) object.material = default_material();
    if (auto* group = std::get_if<GroupPtr>(&object.shape)) *group = in_material(*group, object.material);
    dress(object);
    put_boundary_for_caps(object);
  }
}

// The group with `material` for its members that have none; one for all objects that show it so, which keeps them
// instances.
GroupPtr Builder::in_material(const GroupPtr& group, const MaterialPtr& material) {
  GroupPtr& result = groups_in_material_[{group.get(), material.get()}];
  if (result) return result;
  auto filled = std::make_shared<Group>(*group);
  for (Object& member : filled->objects) {
    if (!member.material) member.material = material_of_shape(before_section(member));
    if (!member.material) member.material = material;
    if (auto* inner = std::get_if<GroupPtr>(&member.shape)) *inner = in_material(*inner, member.material);
    dress(member);
    put_boundary_for_caps(member);
  }
  kept_groups_.push_back(group);
  groups_in_material_[{filled.get(), material.get()}] = filled;
  return groups_in_material_[{group.get(), material.get()}] = std::move(filled);
}

std::optional<std::vector<Object>> Builder::build_objects(const Value& list) {
  static const Category wanted[] = {Category::object};
  std::vector<Object> objects;
  const bool good = refer_each(list, {}, wanted, [&](std::any one) {
    auto& some = std::any_cast<Objects&>(one);
    objects.insert(objects.end(), std::make_move_iterator(some.begin()), std::make_move_iterator(some.end()));
  });
  return good ? std::optional(std::move(objects)) : std::nullopt;
}

// No objects: every entity that nothing else uses.
void Builder::default_objects(Model& model) {
  visit_named("geometry", Category::curve, [](const std::string&, const Built&) {});  // finds out what is used
  for (auto& [name, thing] : sections_["geometry"]) {
    if (thing.used) continue;
    for (NamedThing::Member& one : thing.members) {
      if (one.state != NamedThing::Member::State::known) continue;
      Object object;
      object.name = one.name.empty() ? name : name + "." + one.name;
      object.shape = entity_of(one.built.value);
      try {
        render::check_size(object);
      } catch (const geometry::FieldError& error) {
        diagnostics_.error(thing.entry->key.place, error.what(), error.hint);
      }
      model.objects.push_back(std::move(object));
    }
  }
  if (!model.objects.empty())
    defaults_.push_back({DefaultTaken::Of::objects, "every entity is shown in a neutral material"});
}

}  // namespace lekalo::render
