// Where the panels of a page stand.
//
// Rows from the top, columns from the left; what a panel shows is centred in its row and column, so that views of one
// object from several sides stand in line. Around it is the room that its dimensions and labels take. With a scale all
// panels are drawn at it, and the page must hold them; without, each is as large as its share of the page.
#pragma once

#include <string>
#include <vector>

#include "render/scene/model.h"

namespace lekalo::render {

struct PlacedPanel {
  Model model;  // with the panel's camera, objects and drawing, without panels
  Vec2 at{0};   // upper left corner on the sheet, millimetres
  Vec2 size{0};
};

struct PanelLayout {
  double width = 0, height = 0;  // of the sheet
  std::vector<PlacedPanel> panels;
};

// `only`: the name of one panel, which gets a sheet of its own; empty: all. Throws std::runtime_error where they do not
// fit, with what would.
PanelLayout panel_layout(const Model& model, const std::string& only);

}  // namespace lekalo::render
