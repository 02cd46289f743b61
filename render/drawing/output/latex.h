// A drawing whose texts LaTeX sets: the drawing without them, and a file that puts it into a picture with the texts
// over it, in the fonts of the document that says \input{figure.tex}. It needs the packages graphicx and color (or
// xcolor), and for Cyrillic texts a font encoding that has it (\usepackage[T2A,T1]{fontenc}).
#pragma once

#include <string>
#include <string_view>

#include "render/drawing/sheet.h"

namespace lekalo::render {

// What the file begins with.
inline constexpr std::string_view kOverlayMagic = "% Texts of ";

Sheet without_texts(const Sheet& sheet);

// The file; `drawing` is the name by which LaTeX finds the drawing. The picture is as wide as the sheet, or as
// \lekalowidth if the document has set that.
std::string latex_overlay(const Sheet& sheet, const std::string& drawing);

}  // namespace lekalo::render
