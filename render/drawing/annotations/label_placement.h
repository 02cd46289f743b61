// Where texts stand: beside what they speak of, clear of lines, signs and one another.
//
// Each text has places around its point, eight directions at a few distances. The place of least cost is taken: what
// covers another text costs most, then what lies outside of the paper, then lines and signs under the text, then
// distance; texts with a side of their own have one place. A place may have lines of its own, which no text should
// cover and which should not seem to continue another. After the first choice all texts choose again, some times, given
// the others' places; at last those with lines to which one other is an obstacle choose together with it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "render/drawing/sheet.h"

namespace lekalo::render {

using LabelLine = std::pair<Vec2, Vec2>;

constexpr double kTextBorder = 0.35;  // millimetres around a text that are its own

// A place for a text: beside a point, on its `side`; `here`: the beginning of its baseline.
struct LabelSpot {
  Vec2 at{0};
  std::string side;
  double distance = 0;
  std::vector<LabelLine> lines;  // drawn with a text that stands there
  double border = kTextBorder;
};

// A text that wants a place; lengths in millimetres on the sheet.
struct Label {
  SheetText text;
  Vec2 at{0};                    // what it speaks of
  std::string side;              // above left, ...: its place; empty: any; `here`: text.at is decided already
  double distance = 0.6;         // from the point to the text
  std::vector<LabelSpot> spots;  // if any, these are its places, the best liked first, where no side is given
  std::vector<LabelLine> lines;  // those of its place, by `pen`
  LineLook pen;
  std::optional<LineLook> leader;  // a line from the text to the point: the text may stand farther off
  std::optional<Brush> box;        // behind the text
  std::string kind = "label", object;
  bool on_page = false;  // the scene says where on the page
};

struct LabelObstacles {
  std::vector<LabelLine> segments;             // lines
  std::vector<std::pair<Vec2, double>> discs;  // signs: centre, radius
  double width = 0, height = 0;                // of the paper
};

// Whether no line or sign is in the box.
bool is_free(const SheetBox& box, const LabelObstacles& obstacles);

// Decides text.at of all labels, and their lines.
void place_labels(std::vector<Label>& labels, const LabelObstacles& obstacles);

// Upper left corner of the box of a text of so much beside a point, and the unit direction for a side.
Vec2 direction_of_side(std::string_view side);

// The label with its box and leader as they are drawn. Its place must be decided.
SheetGroup drawn_label(const Label& label);

}  // namespace lekalo::render
