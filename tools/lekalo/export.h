// What the formats of `lekalo export` share.
#pragma once

#include <string>
#include <vector>

#include "command.h"

namespace lekalo::command {

struct ExportOptions {
  SceneOptions scene;
  std::vector<std::string> names;
  std::string format, output;
  double sag = 0;  // 0: the objects' own
  bool quiet = false;
};

// The scene as glTF: `format` is gltf, glb, or html, a page with the model and its viewer.
int export_gltf(const ExportOptions& options, const std::string& format, const std::string& output);

// Paths of cutters as cutter location data, in the words of APT.
int export_cldata(const ExportOptions& options, const std::string& output);

}  // namespace lekalo::command
