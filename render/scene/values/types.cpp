#include "render/scene/values/types.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "render/scene/values/synonyms.h"

namespace lekalo::render {

std::vector<TypeDeclaration> file_types();
std::vector<TypeDeclaration> external_types();
std::vector<TypeDeclaration> material_types();
std::vector<TypeDeclaration> texture_types();
std::vector<TypeDeclaration> light_types();
std::vector<TypeDeclaration> camera_types();
std::vector<TypeDeclaration> integrator_types();
std::vector<TypeDeclaration> helper_types();
std::vector<TypeDeclaration> annotation_types();
std::vector<TypeDeclaration> quantity_types();
TypeDeclaration group_type();
TypeDeclaration object_type();
TypeDeclaration style_type();
TypeDeclaration panel_type();

namespace {
std::vector<TypeDeclaration> scene_types() { return {group_type(), object_type(), style_type(), panel_type()}; }
}  // namespace

const std::vector<TypeDeclaration>& all_types() {
  static const std::vector<TypeDeclaration> types = [] {
    std::vector<TypeDeclaration> all = geometry::geometry_types();
    for (auto family : {file_types, external_types, scene_types, material_types, texture_types, light_types,
                        camera_types, integrator_types, helper_types, annotation_types, quantity_types}) {
      std::vector<TypeDeclaration> some = family();
      all.insert(all.end(), std::make_move_iterator(some.begin()), std::make_move_iterator(some.end()));
    }
    return all;
  }();
  return types;
}

const TypeDeclaration* find_type(std::string_view name, std::span<const Category> preferred) {
  const TypeDeclaration* any = nullptr;
  for (const TypeDeclaration& type : all_types()) {
    if (type.name != name) continue;
    if (std::find(preferred.begin(), preferred.end(), type.category) != preferred.end()) return &type;
    any = &type;
  }
  return any;
}

std::vector<std::string> type_names(std::span<const Category> categories) {
  std::vector<std::string> names;
  for (const TypeDeclaration& type : all_types())
    if (std::find(categories.begin(), categories.end(), type.category) != categories.end()) names.push_back(type.name);
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> types_meant_by(std::string_view word, std::span<const Category> wanted) {
  std::vector<std::string> fitting, others;
  const auto add = [&](const TypeDeclaration& type) {
    const bool fits = std::find(wanted.begin(), wanted.end(), type.category) != wanted.end();
    (fits ? fitting : others).push_back(type.name);
  };
  for (const std::string_view name : types_called(word))
    for (const TypeDeclaration& type : all_types())
      if (type.name == name) add(type);
  // By its ending alone, where nothing that fits is known by its meaning.
  if (fitting.empty())
    for (const TypeDeclaration& type : all_types())
      for (const std::string_view suffix : {"_curve", "_surface", "_body", "_light", "_mesh"})
        if (type.name.size() == word.size() + suffix.size() && type.name.starts_with(word) &&
            type.name.ends_with(suffix))
          add(type);
  std::vector<std::string>& names = fitting.empty() ? others : fitting;
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

std::string maps_with_word(std::string_view word, std::span<const Category> wanted) {
  std::string maps;
  const bool style = std::find(wanted.begin(), wanted.end(), Category::style) != wanted.end();
  if (style && word == "dashed") return "{ dash: [1.5 mm, 0.75 mm] }";
  if (style && word == "dotted") return "{ dash: [0.3 mm, 0.8 mm] }";
  for (const TypeDeclaration& type : all_types()) {
    if (std::find(wanted.begin(), wanted.end(), type.category) == wanted.end()) continue;
    for (const geometry::Field& field : type.fields) {
      if (field.type.kind != geometry::Kind::choice) continue;
      const std::vector<std::string>& choices = field.type.choices;
      const auto meant = std::find_if(choices.begin(), choices.end(), [&](const std::string& choice) {
        return choice == word || choice == "N-" + std::string(word);  // glasses of catalogues: N-BK7
      });
      if (meant == choices.end()) continue;
      maps += maps.empty() ? "" : " or ";
      maps += is_implicit(type.category) ? fmt::format("{{ {}: {} }}", field.name, *meant)
                                         : fmt::format("{{ type: {}, {}: {} }}", type.name, field.name, *meant);
    }
  }
  return maps;
}

std::vector<std::string> types_with_fields_of(const Value& map, std::span<const Category> wanted) {
  std::vector<std::string> names;
  for (const TypeDeclaration& type : all_types()) {
    if (std::find(wanted.begin(), wanted.end(), type.category) == wanted.end()) continue;
    const auto has = [](const std::vector<geometry::Field>& fields, const std::string& name) {
      return std::any_of(fields.begin(), fields.end(),
                         [&](const geometry::Field& field) { return field.name == name; });
    };
    const std::vector<geometry::Field> common = common_fields(type.category);
    if (std::all_of(map.entries.begin(), map.entries.end(), [&](const Entry& entry) {
          return has(type.fields, entry.key.name) || has(common, entry.key.name) || entry.key.name == "repeat";
        }))
      names.push_back(type.name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string describe(std::span<const Category> categories) {
  std::string text;
  for (size_t i = 0; i < categories.size(); ++i) {
    if (i > 0) text += i + 1 == categories.size() ? " or " : ", ";
    const std::string_view name = geometry::name(categories[i]);
    text += std::string_view("aeiou").find(name.front()) != std::string_view::npos ? "an " : "a ";
    text += name;
  }
  return text;
}

std::span<const Category> geometry_categories() {
  static constexpr Category all[] = {Category::curve, Category::surface, Category::body, Category::mesh,
                                     Category::shape, Category::group,   Category::point};
  return all;
}

bool is_geometry(Category category) {
  const auto all = geometry_categories();
  return std::find(all.begin(), all.end(), category) != all.end();
}

const char* section_of(Category category) {
  if (is_geometry(category)) return "geometry";
  if (category == Category::material) return "materials";
  if (category == Category::light) return "lights";
  if (category == Category::style) return "styles";
  if (category == Category::panel) return "panels";
  return nullptr;
}

bool takes_abbreviations(const std::vector<geometry::Field>& fields) {
  return std::any_of(fields.begin(), fields.end(), [](const geometry::Field& field) {
    using geometry::Kind;
    const bool is_formula = field.type.kind == Kind::formula || field.type.kind == Kind::formulas;
    return is_formula && !field.type.variables.empty();
  });
}

bool is_implicit(Category category) {
  return category == Category::style || category == Category::object || category == Category::panel;
}

std::string default_type(Category category, const Value& map) {
  if (is_implicit(category)) return std::string(geometry::name(category));
  if (category == Category::integrator) return "classic";
  if (category == Category::camera) return default_camera_type(map);
  return {};
}

std::vector<geometry::Field> common_fields(Category category) {
  using geometry::boolean, geometry::new_name, geometry::transform;
  std::vector<geometry::Field> fields;
  if (is_geometry(category))
    fields.push_back({"transform", transform(), "steps in the order in which they happen, world axes", false, {}});
  if (category == Category::surface)
    fields.push_back({"reversed", boolean(), "turn the normal to the other side", false, "false"});
  if (section_of(category))
    fields.push_back({"like", new_name(), "copy the fields of this thing; those given here override them", false, {}});
  return fields;
}

std::vector<std::string> helpers_of(Category category) {
  if (category == Category::curve)
    return {"comb",     "frames",    "osculating_circle", "evolute", "tangents", "normal_lines",
            "features", "hodograph", "direction",         "colored", "jumps"};
  if (category == Category::surface)
    return {"normals",  "curvature_lines",      "asymptotic_lines",  "contour_lines",    "isophotes",
            "umbilics", "principal_directions", "principal_circles", "dupin_indicatrix", "tangent_plane",
            "hedgehog", "reflections",          "tool_axis_field"};
  if (category == Category::body)
    return {"curvature_lines", "asymptotic_lines", "contour_lines", "isophotes", "reflections"};
  return {};
}

std::vector<std::string> helpers_of(const TypeDeclaration& type) {
  std::vector<std::string> all = type.helpers, common = helpers_of(type.category);
  all.insert(all.end(), common.begin(), common.end());
  // What can be done with control points.
  if (type.category == Category::curve && std::find(all.begin(), all.end(), "control_polygon") != all.end())
    all.insert(all.end(), {"insertion", "elevation", "hulls", "moved_point", "crossings"});
  return all;
}

}  // namespace lekalo::render
