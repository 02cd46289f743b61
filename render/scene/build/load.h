// A scene file as a model, in one call.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "render/model/model.h"
#include "render/scene/build/constraint_report.h"
#include "render/scene/build/external_note.h"
#include "render/scene/values/diagnostics.h"
#include "render/scene/yaml/include.h"

namespace lekalo::render {

struct LoadOptions {
  std::vector<ParameterSetting> set_parameters;
  std::vector<std::filesystem::path> includes;
  bool allow_external = false;  // the scene may run code from outside the program
  // Filled with every file that was read, also if the scene has errors: what to watch for changes.
  std::vector<std::filesystem::path>* files_read = nullptr;
};

struct LoadedScene {
  std::shared_ptr<Model> model;
  std::vector<DefaultTaken> defaults_taken;
  std::vector<ExternalNote> external_notes;
  std::shared_ptr<const ConstraintReport> constraints;  // null without the section
  std::vector<std::filesystem::path> files;             // all that were read
  uint64_t hash = 0;                                    // of all texts, data files and --set values
};

// Throws SceneError with all errors of the scene.
LoadedScene load_scene(const std::filesystem::path& path, const LoadOptions& options = {});

}  // namespace lekalo::render
