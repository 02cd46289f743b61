// A drawing whose texts LaTeX sets: the drawing without them, and a file that puts it into a picture with the texts
// over it, in the fonts of the document that says \input{figure.tex}. It needs the packages graphicx, color (or
// xcolor), amsmath and amssymb, and for Cyrillic texts a font encoding that has it (\usepackage[T2A,T1]{fontenc}).
#pragma once

#include <string>
#include <string_view>

#include "render/drawing/sheet.h"

namespace lekalo::render {

// What the file begins with.
inline constexpr std::string_view kOverlayMagic = "% Texts of ";

// A label as LaTeX sets it alike, by the rules of latex_overlay().
std::string latex_text(std::string_view label);
// The macro that latex_text() uses for letters that only some encodings of fonts have, and the preamble's line for
// them; empty where the texts have no such letters.
std::string letters_macro(std::string_view texts);
std::string letters_packages(std::string_view texts);
// The points of a text's size in LaTeX: a font size and, with it, a distance of lines.
std::string latex_font_size(const SheetText& text);
// A name of a file between braces, in a form that TeX reads as it is.
std::string file_for_latex(const std::string& name);

Sheet without_texts(const Sheet& sheet);

// Whether LaTeX can be told of a file with this name: without control characters and # % $ \ { } ".
bool latex_takes_file(std::string_view name);

// The file; `drawing` is the name by which LaTeX finds the drawing. The picture is as wide as the sheet, or as
// \lekalowidth if the document has set that. LaTeX shows what the other outputs show: `a_b` outside of formulas is no
// subscript. Throws std::invalid_argument for characters that LaTeX's fonts do not have, and for a name that it does
// not take.
std::string latex_overlay(const Sheet& sheet, const std::string& drawing);

}  // namespace lekalo::render
