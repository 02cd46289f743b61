#include "render/scene/types.h"

#include <algorithm>
#include <iterator>

namespace lekalo::render {

std::vector<TypeDeclaration> file_types();
std::vector<TypeDeclaration> material_types();
std::vector<TypeDeclaration> texture_types();
std::vector<TypeDeclaration> light_types();
std::vector<TypeDeclaration> camera_types();
std::vector<TypeDeclaration> integrator_types();

const std::vector<TypeDeclaration>& all_types() {
  static const std::vector<TypeDeclaration> types = [] {
    std::vector<TypeDeclaration> all = geometry::geometry_types();
    for (auto family : {file_types, material_types, texture_types, light_types, camera_types, integrator_types}) {
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
  for (const TypeDeclaration& type : all_types()) {
    // The ball is the sphere's body.
    bool meant = word == "sphere" && type.name == "ball";
    for (const std::string_view suffix : {"_curve", "_surface", "_body", "_light", "_mesh"})
      meant = meant || (type.name.size() == word.size() + suffix.size() && type.name.starts_with(word) &&
                        type.name.ends_with(suffix));
    if (!meant) continue;
    const bool fits = std::find(wanted.begin(), wanted.end(), type.category) != wanted.end();
    (fits ? fitting : others).push_back(type.name);
  }
  std::vector<std::string>& names = fitting.empty() ? others : fitting;
  std::sort(names.begin(), names.end());
  return names;
}

std::string describe(std::span<const Category> categories) {
  std::string text;
  for (size_t i = 0; i < categories.size(); ++i) {
    if (i > 0) text += i + 1 == categories.size() ? " or " : ", ";
    text += categories[i] == Category::integrator || categories[i] == Category::annotation ? "an " : "a ";
    text += geometry::name(categories[i]);
  }
  return text;
}

}  // namespace lekalo::render
