// What must hold for every input of the reader, however broken: shared by the fuzzer and the test over its corpus.
#pragma once

#include <string>
#include <string_view>

#include "render/scene/yaml/include.h"

namespace lekalo::render {

// A plain scalar must be the very text at its place: yaml-cpp must not have joined lines or cut anything.
inline std::string violation(const Value& value) {
  if (value.is_scalar() && !value.quoted && !value.invalid) {
    const Place whole = value.place_of(0, value.text.size());
    const std::string_view line = value.place.file->line(value.place.line);
    if (line.find(value.text) == std::string_view::npos || value.text.empty() || whole.length != value.place.length)
      return "the plain scalar '" + value.text + "' is not what stands at its place";
  }
  for (const Value& item : value.items)
    if (std::string found = violation(item); !found.empty()) return found;
  for (const Entry& entry : value.entries)
    if (std::string found = violation(entry.value); !found.empty()) return found;
  return {};
}

// Reads `text` as a scene without includes. Returns what is wrong with the reader's behaviour, or nothing.
inline std::string check_reader(std::string text) {
  ReadOptions options;
  options.limits.included_files = 0;
  options.set_parameters = {{"a", "1"}};
  Diagnostics diagnostics;
  const SceneDescription scene = read_scene(make_source("fuzz.yaml", std::move(text)), options, diagnostics);
  const std::string shown = diagnostics.text();
  // Said where yaml-cpp refuses what the recognizer let through.
  for (const Diagnostic& d : diagnostics.sorted())
    if (d.message == "this cannot be read as YAML") return shown;
  if (diagnostics.has_errors() == shown.empty()) return "errors without a message, or the reverse";
  if (!scene.root.is_map()) return "the root is no map";
  if (scene.root.invalid && !diagnostics.has_errors()) return "invalid without an error";
  return violation(scene.root);
}

}  // namespace lekalo::render
