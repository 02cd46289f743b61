// From a loaded scene to a drawing file: what draw and make share.
#pragma once

#include "render/scene/build/load.h"

namespace lekalo::command {

struct DrawSettings {
  bool quiet = false;
  bool stats = false;
  bool latex = false;       // texts in a file of their own, for LaTeX
  bool outlines = false;    // texts of svg files as outlines
  bool standalone = false;  // TikZ pictures as documents of their own
  int threads = 0;          // 0: all cores
};

// Whether drawings of this kind of file are made: svg, pdf, png, dxf, tikz, tex.
bool is_drawn(const std::string& path);

// Writes the drawing of the model; `outputs` all satisfy is_drawn(). Throws ImageError, and
// SceneError where something does not fit.
void draw_files(const std::shared_ptr<const render::Model>& model, const std::vector<render::OutputFile>& outputs,
                const DrawSettings& settings);

}  // namespace lekalo::command
