// Drawings as TikZ pictures, for documents that want to change them: one \path for each piece of a line, with styles
// that the document may set, texts as nodes in the document's fonts, coordinates in millimetres from the lower left
// corner.
//
//   \path[lekalo/look-1,lekalo/silhouette,lekalo/hidden,lekalo/name=ring-silhouette-hidden-2] (3,4) .. controls ... ;
//
// look-1 is how the scene says it; lekalo/hidden and the like are empty, and win, if the document sets them:
// \tikzset{lekalo/hidden/.style={densely dotted}}; so does lekalo/ring-silhouette-hidden-2.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "render/drawing/sheet.h"

namespace lekalo::render {

// What a fragment and a document of its own begin with.
inline constexpr std::string_view kTikzMagic = "% TikZ picture by Lekalo";

struct TikzDrawing {
  std::string text;
  // What TikZ has no paths for: PNG files beside the text.
  struct Picture {
    std::string file, bytes;
  };
  std::vector<Picture> pictures;
};

// `stem`: how the names of picture files begin. A fragment needs \usepackage{tikz,amsmath,amssymb}, and for Cyrillic
// texts a font encoding that has it; `standalone` is a document of one page. The picture is as wide as the sheet, or as
// \lekalowidth if the document has set that. Throws std::invalid_argument as latex_overlay() does.
TikzDrawing tikz_of(const Sheet& sheet, const std::string& stem, bool standalone);

}  // namespace lekalo::render
