// Drawings as SVG 1.1, written by ourselves: lengths in millimetres, one path for each piece of a line, grouped by
// object and kind, with classes for a style sheet; texts as text, with the characters of the fonts that they need.
#pragma once

#include <string>

#include "render/drawing/sheet.h"

namespace lekalo::render {

struct SvgOptions {
  bool outlines = false;  // texts as outlines of their characters in place of text
};

// The file's text, the same for the same drawing.
std::string svg_of(const Sheet& sheet, const SvgOptions& options = {});

}  // namespace lekalo::render
