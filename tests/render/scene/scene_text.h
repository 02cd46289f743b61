// Scenes written in tests: built from a text, with what was said about it.
#pragma once

#include <string>

#include "render/scene/build/builder.h"
#include "render/scene/yaml/data_path.h"

namespace lekalo::render {

struct BuiltText {
  Model model;
  std::vector<std::string> defaults;
  std::string said;   // "line:column message" of each error, one a line, in the order of the text
  std::string hints;  // the hints of the same errors, one a line
};

// Builds `lekalo: 1`, then the text, which therefore begins in line 2.
inline BuiltText build_text(const std::string& text) {
  Diagnostics diagnostics;
  const SceneDescription scene = read_scene(make_source("test.yaml", "lekalo: 1\n" + text), {}, diagnostics);
  BuiltText result;
  Builder builder(scene, {.search_path = data_folders()}, diagnostics);
  result.model = builder.build();
  for (const DefaultTaken& one : builder.defaults_taken()) result.defaults.push_back(one.text);
  for (const Diagnostic& d : diagnostics.sorted()) {
    result.said += std::to_string(d.place.line) + ":" + std::to_string(d.place.column) + " " + d.message + "\n";
    result.hints += d.hint + "\n";
  }
  return result;
}

}  // namespace lekalo::render
