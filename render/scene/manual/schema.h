// JSON Schema (draft 2020-12) of scene files, made from the declarations of types and sections: completion, hover
// descriptions and squiggles of editors. It accepts every scene that the reader accepts; formulas, names and references
// are texts to it, so that the reader's own checks remain the last word.
#pragma once

#include <string>

namespace lekalo::render {

// The schema, indented, with a line break at the end.
std::string scene_schema();
// The same for regression suites.
std::string suite_schema();

}  // namespace lekalo::render
