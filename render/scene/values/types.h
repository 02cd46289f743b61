// All types that scene files can name, from the families' lists.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/describe.h"
#include "render/scene/values/value.h"

namespace lekalo::render {

using geometry::Category;
using geometry::TypeDeclaration;

const std::vector<TypeDeclaration>& all_types();

// The type of this name, of one of these categories if there is such, else of any: geometry names are unique, but
// `classic` is both a material and an integrator. Null if there is none.
const TypeDeclaration* find_type(std::string_view name, std::span<const Category> preferred = {});

// Names of the types of these categories, sorted.
std::vector<std::string> type_names(std::span<const Category> categories);

// For a word that others use (`cube`), or a bare one that exists for several kinds (`cylinder`): the types that it may
// mean (`box`; `cylinder_surface`, ...), those of the wanted categories if there are any.
std::vector<std::string> types_meant_by(std::string_view word, std::span<const Category> wanted);

// For a word where a thing is wanted: what is written with it, "{ type: dielectric, glass: BK7 }", "... or ..."; empty
// if it is a choice of no type of these categories.
std::string maps_with_word(std::string_view word, std::span<const Category> wanted);

// The types of these categories that have all fields of a map.
std::vector<std::string> types_with_fields_of(const Value& map, std::span<const Category> wanted);

// "a curve", "a surface or a body": for messages.
std::string describe(std::span<const Category> categories);

// Points, curves, surfaces, bodies, meshes and groups: what the section `geometry` holds.
std::span<const Category> geometry_categories();
bool is_geometry(Category category);

// The section in which things of this category have names, or null: textures, annotations and others are written where
// they are used.
const char* section_of(Category category);

// Whether a map of these fields may have `let`: it holds formulas of variables.
bool takes_abbreviations(const std::vector<geometry::Field>& fields);

// Categories of a single type, which is never written: styles, objects, panels.
bool is_implicit(Category category);

// The type of a camera without `type`.
inline const char* default_camera_type(const Value& map) {
  return map.find("from") || map.find("field_of_view") ? "perspective" : "parallel";
}
// The type of a map without `type`, or empty where it must be written.
std::string default_type(Category category, const Value& map);

// Fields that every type of a category has beside its own.
std::vector<geometry::Field> common_fields(Category category);

// Names of the helpers that `show` of an object offers for this type.
std::vector<std::string> helpers_of(const TypeDeclaration& type);
std::vector<std::string> helpers_of(Category category);

}  // namespace lekalo::render
