#include "render/scene/build/load.h"

#include <limits>

#include "render/scene/build/builder.h"
#include "render/scene/build/scene_attributes.h"
#include "render/scene/yaml/data_path.h"

namespace lekalo::render {

namespace {

// FNV-1a, 64 bits: identifies a scene for --resume.
void mix(uint64_t& hash, std::string_view text) {
  for (const char c : text) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 1099511628211u;
  }
  hash ^= 255;
  hash *= 1099511628211u;
}

// `attributes`: filled, unless null.
LoadedScene load(const std::filesystem::path& path, const LoadOptions& options, AttributeTable* attributes) {
  Diagnostics diagnostics;
  ReadOptions read;
  read.search_path = data_folders();
  read.set_parameters = options.set_parameters;
  read.includes = options.includes;
  const SceneDescription scene = read_scene(path, read, diagnostics);
  LoadedScene result;
  result.hash = 14695981039346656037u;
  for (const auto& file : scene.files) {
    if (options.files_read && !file->path.empty()) options.files_read->push_back(file->path);
    if (!file->path.empty()) result.files.push_back(file->path);
    mix(result.hash, file->text);
  }
  for (const ParameterSetting& setting : options.set_parameters) {
    mix(result.hash, setting.name);
    mix(result.hash, setting.value);
  }
  if (scene.root.invalid) throw SceneError(diagnostics);
  if (scene.kind != FileKind::scene) {
    diagnostics.error(scene.root.place, "this is a regression suite, not a scene", "run it with: lekalo test");
    throw SceneError(diagnostics);
  }
  BuildOptions build;
  build.search_path = read.search_path;
  build.allow_external = options.allow_external;
  Builder builder(scene, build, diagnostics);
  result.model = std::make_shared<Model>(builder.build());
  const std::vector<std::filesystem::path>& data = builder.files_named();
  if (options.files_read) options.files_read->insert(options.files_read->end(), data.begin(), data.end());
  result.files.insert(result.files.end(), data.begin(), data.end());
  if (diagnostics.has_errors()) throw SceneError(diagnostics);
  for (const std::filesystem::path& file : data) {
    std::string reason;
    if (const auto bytes = read_file(file, std::numeric_limits<std::uint32_t>::max(), true, reason))
      mix(result.hash, *bytes);
  }
  result.external_notes = builder.external_notes();
  result.constraints = builder.constraints();
  result.defaults_taken = builder.defaults_taken();
  if (attributes) *attributes = builder.attributes();
  return result;
}

}  // namespace

LoadedScene load_scene(const std::filesystem::path& path, const LoadOptions& options) {
  return load(path, options, nullptr);
}

SceneWithAttributes load_with_attributes(const std::filesystem::path& path, const LoadOptions& options) {
  SceneWithAttributes result;
  static_cast<LoadedScene&>(result) = load(path, options, &result.attributes);
  return result;
}

}  // namespace lekalo::render
