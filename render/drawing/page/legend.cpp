#include "render/drawing/page/legend.h"

#include <algorithm>

#include "render/model/placed_objects.h"

namespace lekalo::render {

namespace {

// Millimetres.
constexpr double kSample = 7, kSampleToText = 1.5;
constexpr double kBetweenRows = 1.5, kBetweenColumns = 6;
constexpr double kLargestShare = 0.75;  // of the width, that a legend of several columns takes from the picture

size_t divided_up(size_t count, size_t by) { return (count + by - 1) / by; }

}  // namespace

std::vector<LegendEntry> legend_of(const std::vector<Object>& objects) {
  std::vector<LegendEntry> entries;
  PlacedObjects(objects, [](const Object& object) {
    return !object.legend.empty();
  }).visit([&](const Object& object, const geometry::Affine&, int) {
    entries.push_back({object.legend, {}, {}});
  });
  return entries;
}

bool is_inside(const Legend& legend) { return legend.side.find(' ') != std::string::npos; }

LegendTable::LegendTable(const Legend& legend, const std::vector<LegendEntry>& entries, const Vec2& most)
    : legend_(legend), entries_(entries), across_(legend.side == "above" || legend.side == "below") {
  for (const LegendEntry& entry : entries) texts_.push_back(text_in(legend.style, entry.text));
  for (const SheetText& text : texts_) entry_height_ = std::max(entry_height_, text.ascent + text.descent);
  if (texts_.empty()) return;
  if (legend.title) title_ = text_in(legend.style, legend.title->text());
  const size_t count = texts_.size();
  if (across_) {
    for (size_t columns = count; columns > 0; --columns)
      if (arrange(columns); size().x <= most.x) break;
  } else {
    arrange(1);
    for (size_t columns = 2; columns <= count && size().y > most.y; ++columns) {
      const size_t before = columns_;
      if (arrange(columns); size().x <= kLargestShare * most.x) continue;
      arrange(before);
      break;
    }
  }
}

// Rows as few as these columns allow, then columns as few as these rows do.
void LegendTable::arrange(size_t columns) {
  rows_ = divided_up(texts_.size(), columns);
  columns_ = divided_up(texts_.size(), rows_);
}

double LegendTable::width_of_column(size_t column) const {
  double width = 0;
  for (size_t row = 0; row < rows_; ++row)
    if (const size_t k = entry(row, column); k < texts_.size()) width = std::max(width, texts_[k].width);
  return kSample + kSampleToText + width;
}

double LegendTable::title_height() const { return title_ ? title_->ascent + title_->descent + kBetweenRows : 0; }

Vec2 LegendTable::size() const {
  if (empty()) return Vec2(0);
  double width = -kBetweenColumns;
  for (size_t column = 0; column < columns_; ++column) width += width_of_column(column) + kBetweenColumns;
  return {std::max(width, title_ ? title_->width : 0.0),
          title_height() + static_cast<double>(rows_) * (entry_height_ + kBetweenRows) - kBetweenRows};
}

std::vector<SheetItem> LegendTable::draw(const Vec2& at, const View& view, std::vector<Label>& labels) const {
  const auto put = [&](SheetText text, const Vec2& begin) {
    Label label;
    label.text = std::move(text);
    label.text.at = begin;
    label.side = "here";
    label.kind = "legend";
    labels.push_back(std::move(label));
  };
  std::vector<SheetItem> samples;
  if (title_) put(*title_, {at.x, at.y + title_->ascent});
  double x = at.x;
  for (size_t column = 0; column < columns_; ++column) {
    for (size_t row = 0; row < rows_; ++row) {
      const size_t k = entry(row, column);
      if (k >= texts_.size()) continue;
      const double middle =
          at.y + title_height() + static_cast<double>(row) * (entry_height_ + kBetweenRows) + 0.5 * entry_height_;
      if (entries_[k].line)
        samples.emplace_back(drawn(straight_path({{x, middle}, {x + kSample, middle}}), *entries_[k].line));
      if (entries_[k].mark)
        for (SheetItem& item : drawn_mark(*entries_[k].mark, {x + 0.5 * kSample, middle}, 1, view))
          samples.push_back(std::move(item));
      put(texts_[k], {x + kSample + kSampleToText, middle + 0.5 * (texts_[k].ascent - texts_[k].descent)});
    }
    x += width_of_column(column) + kBetweenColumns;
  }
  return samples;
}

}  // namespace lekalo::render
