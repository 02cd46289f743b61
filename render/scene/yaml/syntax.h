// The subset of YAML that scene files are written in, checked before yaml-cpp sees the text.
//
// Two reasons. The library's messages ("end of map not found") do not name what people do wrong: tabs, colours without
// quotes, TeX in double quotes, commas of functions in lists. And the library (0.7) recurses on nesting, loops on
// inputs such as a lone ',', joins lines silently, and reads '?' inside brackets as a key. What passes here is plain:
// block maps and lists, flow maps and lists, scalars on one line, block texts ('|', '>'). It is parsed the same way by
// any YAML reader. Time is linear, memory is one small record a nesting level.
//
//   not in the subset                             because
//   anchors, aliases, tags, merge keys,           nothing in a scene needs them, aliases expand without bound
//   directives, several documents, '? ' keys
//   plain and quoted scalars over several lines   a forgotten quote or colon would swallow the next lines
//   'a: 1' inside [ ]                             reads as a list of maps, is always a slip
//   tabs outside quotes, comments and brackets    YAML forbids them in indentation, editors hide them
#pragma once

#include <cstddef>
#include <memory>

#include "render/scene/values/diagnostics.h"

namespace lekalo::render {

struct ReadLimits {
  int depth = 64;                      ///< nested maps and lists
  std::size_t nodes = 5'000'000;       ///< scalars, lists and maps together
  std::size_t bytes = 64'000'000;      ///< of a scene with all that it includes; bulk data belongs in tables
  std::size_t included_files = 1'000;  ///< files of one scene
  int include_depth = 16;
};

/// Reports the first syntax error of `file` and all values that are missing or null. False if there was a syntax error:
/// then the text must not be parsed.
bool check_syntax(const std::shared_ptr<const SourceFile>& file, const ReadLimits& limits, Diagnostics& diagnostics);

}  // namespace lekalo::render
