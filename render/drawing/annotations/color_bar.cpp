#include "render/drawing/annotations/color_bar.h"

#include <algorithm>
#include <cmath>

#include "render/drawing/annotations/page_shapes.h"
#include "render/model/color_scale.h"
#include "render/model/numbers.h"

namespace lekalo::render {

using namespace geometry;

namespace {

constexpr int kStops = 33;     // of the gradient
constexpr double kTick = 0.8;  // millimetres
constexpr int kDigits = 3;     // of the numbers, more where they differ only there

// Its own numbers, those of a curve, or those of the ground, which a trial of the page does not know yet.
PictureScale scale_of(const AnnotationWork& work) {
  const Fields& f = work.fields();
  if (!f.has("range") && !f.has("of"))
    return work.view().scale.value_or(PictureScale{{0, 1}, "viridis", {}, false, {}});
  return {f.has("range") ? f.range("range") : curve_range(*f.curve("of"), f.text("by"), f.text("colors")),
          f.text("colors"),
          {},
          false,
          {}};
}

// Even steps; of bands a pair about each level.
std::vector<Gradient::Stop> stops_of(const PictureScale& scale) {
  std::vector<Gradient::Stop> stops;
  const auto add = [&](double part, double at) {
    stops.push_back(
        {part, rgb(color_at(scale.colors, place_on_scale(scale, scale.range.lo + at * scale.range.width())))});
  };
  if (!scale.bands) {
    for (int k = 0; k < kStops; ++k) add(k / (kStops - 1.0), k / (kStops - 1.0));
    return stops;
  }
  std::vector<double> ends{0};
  for (const double level : scale.levels)
    if (const double part = (level - scale.range.lo) / scale.range.width(); part > 1e-9 && part < 1 - 1e-9)
      ends.push_back(part);
  ends.push_back(1);
  for (size_t k = 0; k + 1 < ends.size(); ++k)
    for (const double end : {ends[k], ends[k + 1]}) add(end, 0.5 * (ends[k] + ends[k + 1]));
  return stops;
}

std::vector<double> ticks_of(const PictureScale& scale, const Fields& f) {
  const ParameterValues& asked = f.get<ParameterValues>("ticks");
  std::vector<double> ticks = asked.count == 0 ? asked.values : round_numbers(scale.range, asked.count);
  std::erase_if(ticks, [&](double tick) { return !scale.range.contains(tick); });
  return ticks;
}

}  // namespace

void add_color_bar(AnnotationWork& work) {
  const Fields& f = work.fields();
  const PictureScale scale = scale_of(work);
  const Interval& range = scale.range;
  const Vec2 corner = work.place(f.get<Anchor>("at")), size(f.number("width"), f.number("height"));
  const bool lies = size.x > size.y;
  // A place beside the bar: from its beginning, and off its right or lower side.
  const auto at = [&](double part, double off) {
    return corner + (lies ? Vec2(part * size.x, off) : Vec2(size.x + off, -part * size.y));
  };
  SheetPath bar;
  bar.parts.push_back(straight_path(
      {corner, corner + Vec2(size.x, 0), corner + Vec2(size.x, -size.y), corner + Vec2(0, -size.y)}, true));
  bar.pen = work.look();
  bar.gradient = Gradient{false, corner, corner + (lies ? Vec2(size.x, 0) : Vec2(0, -size.y)), {}};
  bar.gradient->stops = stops_of(scale);
  std::vector<SheetItem> items{bar};
  const std::vector<double> ticks = ticks_of(scale, f);
  const std::vector<std::string> numbers = numbers_of_scale(ticks, kDigits);
  for (size_t k = 0; k < ticks.size(); ++k) {
    const double part = (ticks[k] - range.lo) / range.width();
    items.emplace_back(drawn(straight_path({at(part, 0), at(part, kTick)}), work.look()));
    Label number = work.page_label(numbers[k], at(part, kTick));
    number.on_page = true;
    number.side = lies ? "below" : "right";
    number.distance = 0.4;
    work.add(std::move(number));
  }
  work.shape(std::move(items));
  const std::string words = f.has("label") ? work.words("label") : scale.title;
  if (words.empty()) return;
  Label label =
      work.page_label(words, lies ? corner + Vec2(size.x, -0.5 * size.y) : corner + Vec2(0.5 * size.x, -size.y));
  label.on_page = true;
  label.side = lies ? "right" : "above";
  label.distance = 1;
  work.add(std::move(label));
}

}  // namespace lekalo::render
