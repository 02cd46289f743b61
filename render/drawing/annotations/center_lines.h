// Centre lines of what is round (ISO 128-2): the axes of cylinders, cones, tori and surfaces of revolution that go all
// round, a cross where they are seen from their end.
#pragma once

#include "render/drawing/annotations/annotations.h"

namespace lekalo::render {

// In the style of the drawing's choice; nothing where it has none.
void add_center_lines(const View& view, LineWork& work, PageWork& page);

}  // namespace lekalo::render
