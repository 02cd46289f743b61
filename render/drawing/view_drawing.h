// One view of a figure, from its world to its lines, signs and texts on the sheet.
#pragma once

#include <functional>
#include <memory>

#include "render/drawing/annotations/label_placement.h"
#include "render/drawing/figure_sheet.h"
#include "render/drawing/view.h"
#include "render/lines/strokes.h"

namespace lekalo::render {

class ViewDrawing {
 public:
  // The options and the figure must stay. `clipped`: nothing is drawn outside of the view.
  ViewDrawing(std::shared_ptr<const Model> model, const View& view, bool clipped, const FigureOptions& options,
              Figure& figure);
  ~ViewDrawing();
  ViewDrawing(const ViewDrawing&) = delete;
  ViewDrawing& operator=(const ViewDrawing&) = delete;

  // In this order. What takes long keeps to the view itself: the lines of several views may be found, and seen, side by
  // side.
  void find_lines(SolidLines* solids);  // of solids other views may know lines
  void annotate();
  Label* title();  // null: none, or that of a graph
  void see(const std::function<void(double)>& progress);
  void draw();

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

// Adds what is not there yet.
void add_once(std::string what, std::vector<std::string>& all);

}  // namespace lekalo::render
