// From the files of a scene to one map of sections: versions, includes, merging, --set.
//
//   include: studio/softbox.yaml
//   include: [studio/paper.yaml, { file: bolt.yaml, as: b1, set: { length: 2*h } }]
//
// A file is looked for beside the file that names it, then in the search path (the shipped scenes). Merging:
//
//   geometry materials lights styles panels   union; a name given twice is an error, except the names of built-in
//   styles,
//                                             which merge key by key
//   parameters                                union; the including file overrides, `set` overrides that for one
//   inclusion,
//                                             --set overrides all; two included files that give the same one are an
//                                             error
//   objects outputs, drawing: annotations     lists append, included entries first; a single entry is a list of one
//   everything else                           merges key by key, the including file wins, then the later included one;
//                                             of a camera `view` takes the place of `from` and `at`, `from` that of
//                                             `view`, `frame` and `margin`, another `type` that of everything
//
// `as: PREFIX` gives every name that the included file defines in a named section the prefix and a dot: `head` becomes
// `b1.head`. Inside the included file the names stay as written, since each of its values keeps the prefix as
// `place.file->scope`: a name used there is looked up as `b1.name`, then as `name` (find_named). So a `set` formula,
// which stands in the including file, speaks of the names of that file. A file that reaches a scene on two ways, with
// the same prefix and without `set`, is read once.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/scene/values/diagnostics.h"
#include "render/scene/values/value.h"
#include "render/scene/yaml/reader.h"

namespace lekalo::render {

/// What the first key of a file says it is: `lekalo: 1` or `lekalo_suite: 1`.
enum class FileKind { scene, suite };

/// Everything that the files of a scene say, as written. `root` has neither `include` nor the values overridden by
/// others; it is invalid if nothing could be read. `files` are all that were read, the main one first.
struct SceneDescription {
  FileKind kind = FileKind::scene;
  Value root;
  std::vector<std::shared_ptr<const SourceFile>> files;
};

/// A value given to a parameter from outside the scene.
struct ParameterSetting {
  std::string name, value;
  std::string option = {};  ///< as messages show it, beginning with `--`; empty: --set NAME=VALUE
};

struct ReadOptions {
  std::vector<std::filesystem::path> search_path;  ///< folders of shipped scene files
  std::vector<ParameterSetting> set_parameters;    ///< in order
  std::vector<std::filesystem::path> includes;     ///< included after those of the main file
  ReadLimits limits;
};

/// Reads a scene or a suite with all that it includes. A suite is returned as written: its `include` keys stand inside
/// its tests and are handed to this function as `includes` of their scenes. Problems go to `diagnostics`; a main file
/// that cannot be opened is reported with Diagnostics::unreadable().
SceneDescription read_scene(const std::filesystem::path& path, const ReadOptions& options, Diagnostics& diagnostics);
/// The same for a text in memory; what it includes is looked for beside `file->path`.
SceneDescription read_scene(const std::shared_ptr<const SourceFile>& file, const ReadOptions& options,
                            Diagnostics& diagnostics);

/// The file that `name` means in a scene text: absolute, beside `from`, or in the search path; nothing if none of these
/// exists.
std::optional<std::filesystem::path> find_input(const SourceFile& from, std::string_view name,
                                                const std::vector<std::filesystem::path>& search_path);

/// The entry of a named section that `name` means in a text with this scope, and what remains behind it: the longest
/// dotted beginning of `name` that is an entry, the innermost scope first. `hole.3.side` finds `hole` with member
/// `3.side`. Without an entry: null.
struct Named {
  const Entry* entry = nullptr;
  std::string_view member;
};
Named find_named(const Value& section, std::string_view name, std::string_view scope);

/// Reads a whole file. Nothing if it cannot be read or is longer than `limit` bytes; then `reason` says why.
/// With `regular` only regular files are read, so that no pipe or device can block or never end.
std::optional<std::string> read_file(const std::filesystem::path& path, std::size_t limit, bool regular,
                                     std::string& reason);

}  // namespace lekalo::render
