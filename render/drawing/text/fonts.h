// The fonts of drawings: Computer Modern Unicode by name, for signs that it lacks DejaVu, never what a system would
// choose. Extents do not depend on a resolution.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "render/drawing/sheet.h"

namespace lekalo::render {

// Extents of characters on a line, in em, y upwards from the baseline.
struct TextExtent {
  double advance = 0;                                // to where the next run begins
  double left = 0, right = 0, below = 0, above = 0;  // of the ink
};

// serif, sans or mono.
std::string font_family(std::string_view kind);

// The characters cut into runs that one font has each: `font`, or one of those that have more signs. Throws
// std::runtime_error if a font is not installed (with the package's name), or none has a character.
struct FontRun {
  Font font;
  std::string text;
};
std::vector<FontRun> font_runs(const Font& font, std::string_view text);

// Of a run of one font.
TextExtent text_extent(const Font& font, const std::string& text);

// A font file with nothing but these characters (UTF-8), for embedding.
std::string font_subset(const Font& font, std::string_view characters);

}  // namespace lekalo::render
