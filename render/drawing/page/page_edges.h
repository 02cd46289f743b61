// Texts that the page's edges cut off, and legends that go beyond their panels.
#pragma once

#include <string>

#include "render/drawing/annotations/label_placement.h"

namespace lekalo::render {

// What a text must not go beyond.
struct PageEdges {
  const char* name;  // page or panel
  SheetBox box;
  double margin;
};

// For a text in its place: by how much it goes over the edges, and what gives it room. Empty for one that does not.
std::string over_the_edge(const Label& label, const PageEdges& edges);

}  // namespace lekalo::render
