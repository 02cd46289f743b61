// Texts of drawings laid out: runs of characters in their places, bars, roots and accents as lines.
//
// Sizes and distances follow The TeXbook, appendix G, simplified: scripts have 0.7 of the size and 0.5 within scripts,
// superscripts stand 0.4 em high, subscripts 0.2 em low; signs between terms keep 2/9 em, relations 5/18 em.
#pragma once

#include <string_view>

#include "render/drawing/sheet.h"

namespace lekalo::render {

// `family`: serif, sans or mono. `size`: millimetres of an em. The text must be one that tex.h reads; `at` is the
// origin. Throws std::runtime_error if a font is missing.
SheetText laid_out(std::string_view tex, std::string_view family, double size);

// Where a text stands on the sheet, or the part of it between two shares of its width; at an angle, the box about it.
SheetBox box_of(const SheetText& text, double from = 0, double to = 1);

}  // namespace lekalo::render
