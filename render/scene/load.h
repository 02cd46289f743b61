// A scene file as a model, in one call.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "render/scene/diagnostics.h"
#include "render/scene/model.h"

namespace lekalo::render {

struct LoadOptions {
  std::vector<std::pair<std::string, std::string>> set_parameters;  // --set NAME=VALUE
  std::vector<std::filesystem::path> includes;
};

struct LoadedScene {
  std::shared_ptr<const Model> model;
  std::vector<std::string> defaults_taken;
  std::vector<std::filesystem::path> files;  // everything that was read, for --watch
  uint64_t hash = 0;                         // of all texts and --set values
};

// Throws SceneError with all errors of the scene.
LoadedScene load_scene(const std::filesystem::path& path, const LoadOptions& options = {});

}  // namespace lekalo::render
