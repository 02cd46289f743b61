// The legend of a drawing: a title, and a table of samples with texts.
#pragma once

#include <vector>

#include "render/drawing/annotations/label_placement.h"
#include "render/drawing/view.h"

namespace lekalo::render {

class LegendTable {
 public:
  // Above and below a picture the entries stand side by side, in as many rows as they need to be no wider than `most`;
  // else one below another, in as many columns as they need to be no higher, if these leave the picture a
  // quarter of the width. What has no room even so is larger.
  LegendTable(const Legend& legend, const std::vector<LegendEntry>& entries, const Vec2& most);

  bool empty() const { return texts_.empty(); }
  Vec2 size() const;
  // Its upper left corner there; the texts, in their places, join the labels.
  std::vector<SheetItem> draw(const Vec2& at, const View& view, std::vector<Label>& labels) const;

 private:
  size_t entry(size_t row, size_t column) const { return across_ ? row * columns_ + column : column * rows_ + row; }
  void arrange(size_t columns);
  double width_of_column(size_t column) const;
  double title_height() const;

  const Legend& legend_;
  const std::vector<LegendEntry>& entries_;
  bool across_;
  std::vector<SheetText> texts_;
  std::optional<SheetText> title_;
  double entry_height_ = 0;
  size_t rows_ = 0, columns_ = 0;
};

// The texts of the legend of these objects.
std::vector<LegendEntry> legend_of(const std::vector<Object>& objects);

// Whether a legend stands beside the picture (above, below, left, right) or within it.
bool is_inside(const Legend& legend);

}  // namespace lekalo::render
