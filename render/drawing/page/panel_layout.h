// Where the panels of a page stand.
//
// Rows from the top, columns from the left; what a panel shows is centred in its row and column, so that views of one
// object from several sides stand in line. Around it is the room that its dimensions and labels take. With a scale all
// panels are drawn at it, and the page must hold them; without, each is as large as its share of the page.
#pragma once

#include <string>
#include <vector>

#include "render/cameras/framed_content.h"
#include "render/drawing/sheet.h"
#include "render/model/model.h"

namespace lekalo::render {

// What the objects, and the points of which annotations speak, take of a picture whose pixels have so many millimetres:
// it grows with the scene. And what the annotations take with them.
// `shown`: the model's objects.
SheetBox shown_box(const Model& model, const FramedContent& shown, const Camera& camera, double millimetres);
SheetBox annotated_box(const Model& model, const FramedContent& shown, const Camera& camera, double millimetres);

// Above what the view's title stands: the circle of a detail, else what the objects show. Empty where that is nothing.
SheetBox box_under_title(const Model& model, const FramedContent& shown, const Camera& camera, double millimetres);

// A camera that frames the scene so that its annotations have room too: `size` is that of the picture in millimetres,
// whose height is made to fit where it is automatic. The model's own camera where they have.
CameraPtr camera_with_room(const Model& model, Vec2& size, bool auto_height, double millimetres);

struct PlacedPanel {
  std::string name;
  Model model;  // with the panel's camera, objects and drawing, without panels
  Vec2 at{0};   // upper left corner on the sheet, millimetres
  Vec2 size{0};
};

struct PanelLayout {
  double width = 0, height = 0;  // of the sheet
  std::vector<PlacedPanel> panels;
};

// Throws SceneError: something does not fit on the paper.
[[noreturn]] void does_not_fit(const Place& place, std::string message, std::string hint);

// The page for messages: the sides that the scene gives.
std::string page_in_words(const Paper& paper, double width, double height);

// `only`: the name of one panel, which gets a sheet of its own; empty: all. Throws SceneError where they do not fit,
// with what would.
PanelLayout panel_layout(const Model& model, const std::string& only);

}  // namespace lekalo::render
