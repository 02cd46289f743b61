// Drawings as SVG 1.1, written by ourselves: lengths in millimetres, one path for each piece of a line, grouped by
// object and kind, with classes for a style sheet.
#pragma once

#include <string>

#include "render/drawing/visible_lines.h"

namespace lekalo::render {

// The file's text, the same for the same drawing.
std::string svg_of(const VisibleLines& drawing, const Model& model, const std::vector<std::string>& object_names);

}  // namespace lekalo::render
