// Areas of a drawing under its lines (`ground: fill`): flat, in two tones, with a gradient, hatched. Their outlines are
// those of what is seen, as exact as the lines.
#pragma once

#include "render/drawing/view.h"
#include "render/drawing/visibility/hidden_lines.h"

namespace lekalo::render {

struct Fills {
  std::vector<SheetItem> items;
  int open = 0;  // loops that do not close: a border is missing there
};

// `lines` with the borders of fills (LineWork::fills), `one_faces` those of the same line work. No outline is farther
// than `tolerance` pixels from its curve.
Fills fills_of(const World& world, const View& view, const VisibleLines& lines, const OneFaces& one_faces,
               double tolerance);

}  // namespace lekalo::render
