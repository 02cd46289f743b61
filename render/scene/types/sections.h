// The fields of the sections of a scene file that are not types: declared like those of types, so that reading, schema
// and manual come from one place.
#pragma once

#include <string>
#include <vector>

#include "geometry/describe.h"

namespace lekalo::render {

struct SectionDeclaration {
  enum class Shape {
    fields,   // one map of the declared fields
    named,    // a map of named things, each built by a type of `categories`
    list,     // a list of maps of the declared fields
    things,   // a list of things, each built by a type of `categories`
    one_of,   // one thing built by a type of `categories`
    numbers,  // names and formulas
    free      // read elsewhere (include)
  };
  std::string name;
  std::string description;
  Shape shape = Shape::fields;
  std::vector<geometry::Field> fields;
  std::vector<geometry::Category> categories;
};

// In the order of the manual.
const std::vector<SectionDeclaration>& sections();
const SectionDeclaration& section_declaration(std::string_view name);

}  // namespace lekalo::render
