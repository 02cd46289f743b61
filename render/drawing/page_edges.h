// Texts that the page's edges cut off.
#pragma once

#include <string>

#include "render/drawing/label_placement.h"

namespace lekalo::render {

// For a text in its place: by how much it goes over the edges of a page of this size, and what gives it room. Empty for
// one that is on the page.
std::string over_the_edge(const Label& label, const Vec2& page, double margin);

}  // namespace lekalo::render
