// From a loaded scene to a drawing file: what draw and make share.
#pragma once

#include "render/scene/load.h"

namespace lekalo::command {

struct DrawSettings {
  bool quiet = false;
  bool stats = false;
};

// Whether drawings of this kind of file are made.
bool is_drawn(const std::string& path);

// Writes the drawing of the model; `outputs` all satisfy is_drawn(). Throws ImageError.
void draw_files(const std::shared_ptr<const render::Model>& model, const std::vector<std::string>& outputs,
                const DrawSettings& settings);

}  // namespace lekalo::command
