// What scene files may say, in words: made from the declarations of types and sections, for `lekalo types`, the
// schema's descriptions and the pages of docs/reference.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "render/scene/values/types.h"

namespace lekalo::render {

// A map of this type with all that it needs, in one line: "{ type: circle, radius: 1 }".
std::string example_of(const TypeDeclaration& type);

// What `let` is, which types with formulas of variables take.
inline constexpr const char* kLetDescription =
    "names for parts of the formulas, each a formula of their variables and the names before it: { w: sqrt(1 + t^2) }";

// Categories that have types, in the order of the manual, and the name of a category's page ("curves").
const std::vector<Category>& categories_of_manual();
std::string plural(Category category);

// All types by category, one line each; all about one type.
std::string list_of_types();
std::string description_of(const TypeDeclaration& type);

// All about one section of scene files; empty if there is none of this name.
std::string description_of_section(std::string_view name);

// How formulas are written, and all their functions.
std::string description_of_formulas();

// How `repeat` is written, and what it makes.
std::string description_of_repeat();

// A built-in style with its values; empty if there is none of this name.
std::string description_of_style(std::string_view name);

// The pages of the reference: file name and Markdown text.
std::vector<std::pair<std::string, std::string>> reference_pages();

}  // namespace lekalo::render
