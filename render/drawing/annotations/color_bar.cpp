#include "render/drawing/annotations/color_bar.h"

#include <algorithm>
#include <cmath>

#include "render/drawing/annotations/page_shapes.h"
#include "render/model/color_scale.h"

namespace lekalo::render {

using namespace geometry;

namespace {

constexpr int kStops = 33;     // of the gradient
constexpr double kTick = 0.8;  // millimetres

// The multiples of 1, 2 or 5 times a power of ten in the range, about `count` of them.
std::vector<double> round_numbers(const Interval& range, int count) {
  const double wanted = range.width() / std::max(1, count), power = std::pow(10, std::floor(std::log10(wanted)));
  const double part = wanted / power, step = power * (part > std::sqrt(50.0)   ? 10
                                                      : part > std::sqrt(10.0) ? 5
                                                      : part > std::sqrt(2.0)  ? 2
                                                                               : 1);
  std::vector<double> numbers;
  for (double k = std::ceil(range.lo / step - 1e-9); k <= range.hi / step + 1e-9; ++k) numbers.push_back(k * step);
  return numbers;
}

}  // namespace

void add_color_bar(AnnotationWork& work) {
  const Fields& f = work.fields();
  const Interval range = f.has("range") ? f.range("range") : curve_range(*f.curve("of"), f.text("by"));
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
  for (int k = 0; k < kStops; ++k) {
    const double part = k / (kStops - 1.0);
    bar.gradient->stops.push_back({part, rgb(color_at(f.text("colors"), part))});
  }
  std::vector<SheetItem> items{bar};
  const ParameterValues& asked = f.get<ParameterValues>("ticks");
  for (const double tick : asked.count > 0 ? round_numbers(range, asked.count) : asked.values) {
    const double part = (tick - range.lo) / range.width();
    items.emplace_back(drawn(straight_path({at(part, 0), at(part, kTick)}), work.look()));
    Label number = work.page_label(dimension_number(tick), at(part, kTick));
    number.on_page = true;
    number.side = lies ? "below" : "right";
    number.distance = 0.4;
    work.add(std::move(number));
  }
  work.shape(std::move(items));
  if (!f.has("label")) return;
  Label label = work.page_label(work.words("label"),
                                lies ? corner + Vec2(size.x, -0.5 * size.y) : corner + Vec2(0.5 * size.x, -size.y));
  label.on_page = true;
  label.side = lies ? "right" : "above";
  label.distance = 1;
  work.add(std::move(label));
}

}  // namespace lekalo::render
