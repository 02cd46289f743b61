// Axes of graphs with marks, numbers, names and grids, and the legend of a drawing: how much room they take around the
// picture, and their lines and texts.
#pragma once

#include "render/drawing/annotations/label_placement.h"
#include "render/drawing/view.h"

namespace lekalo::render {

// Free room around a picture, millimetres.
struct Insets {
  double left = 0, right = 0, top = 0, bottom = 0;
  Vec2 least{0};  // picture beside which the legend has room
};

// The room that axes, knots and legend take beside a picture of this view. `entries`: of the legend.
Insets insets_of(const View& view, const std::vector<LegendEntry>& entries);

struct GraphWork {
  std::vector<SheetItem> under, over;  // the lines: grids; axes and the legend
  std::vector<Label> labels;           // texts, all in their places
  std::vector<std::string> left_out;   // ticks outside of the range, in words
  std::vector<std::string> covered;    // by the legend, in words
};

// Of the view in its place. A legend in a corner where there are lines takes one that is free.
GraphWork graph_axes(const View& view, const std::vector<LegendEntry>& entries, const LabelObstacles& obstacles);

// Round values of a range, about `count` of them: steps of 1, 2 or 5 times a power of ten.
std::vector<double> round_values(const geometry::Interval& range, double count);

}  // namespace lekalo::render
