// Texts that the page's edges cut off.
#pragma once

#include <string>

#include "render/drawing/label_placement.h"
#include "render/drawing/panel_layout.h"

namespace lekalo::render {

// Where a text stands on the sheet; of one at an angle the box about it.
SheetBox box_of(const SheetText& text);

// For a text in its place: by how much it goes over the edges of a page of this size, and what gives it room. Empty for
// one that is on the page.
std::string over_the_edge(const Label& label, const Vec2& page, double margin);

}  // namespace lekalo::render
