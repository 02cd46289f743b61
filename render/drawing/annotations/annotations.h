// The annotations of a drawing: those in space join its lines and points, so that what covers them is known; those on
// the page (dimensions, braces, leaders) become paths and texts.
#pragma once

#include "render/drawing/annotations/label_placement.h"
#include "render/drawing/view.h"

namespace lekalo::render {

// What stands on the page.
struct PageWork {
  std::vector<SheetItem> shapes;
  std::vector<Label> labels;
  std::vector<Vec3> anchors;  // points in space that the annotations speak of, those of the lines in space too
  std::vector<Vec2> reach;    // places of lines in space whose size is one on the page
};

// Adds the annotations of the view's model. What is at points behind the eye is left out, and named in
// work.left_out.
void add_annotations(const View& view, LineWork& work, PageWork& page);

constexpr double kTitleOff = 3;  // millimetres between a view and its title
SheetText title_text(const Model& model);

// Adds the title of the view's model above `under`, and above all that the annotations say there. A graph's is one of
// its axes' texts.
void add_title(const View& view, SheetBox under, PageWork& page);

}  // namespace lekalo::render
