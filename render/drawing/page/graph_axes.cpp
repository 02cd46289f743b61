#include "render/drawing/page/graph_axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/drawing/annotations/annotations.h"
#include "render/drawing/page/legend.h"
#include "render/model/numbers.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// Millimetres.
constexpr double kTick = 1.2;         // outwards, of the marks
constexpr double kFromTick = 0.9;     // to their numbers
constexpr double kFromNumbers = 1.2;  // to the axis's name
constexpr double kPerTick = 14;       // of an axis, for each mark of `auto`
constexpr size_t kFewTicks = 3;       // so many of `auto` are wished for, nearer to one another if need be
constexpr double kBetweenNumbers = 2.5;
constexpr int kDigits = 6;          // of the numbers, more where they differ only there
constexpr double kLine = 0.5;       // for the width of lines at the edge of a graph
constexpr double kFromEdge = 0.35;  // of texts from the page's
constexpr double kNearEnd = 0.02;   // of a range: texts so near to its end need room beyond it
constexpr double kAtEnd = 1e-6;     // of a range, beyond it: still its end
constexpr double kLegendFree = 3, kLegendBorder = 1.5;

// What the picture of a graph shows.
struct Ranges {
  Interval x, y;
};
Ranges ranges_of(const Camera& camera) {
  const Vec3 upper = camera.ray(0, 0).origin, lower = camera.ray(camera.width(), camera.height()).origin;
  return {{upper.x, lower.x}, {lower.y, upper.y}};
}

struct KnotMarks {
  double t = 0;
  int multiplicity = 1;
  std::string text;
};

class Axes {
 public:
  Axes(const View& view, const std::vector<LegendEntry>& entries) : view_(view), ranges_(ranges_of(view.camera)) {
    const auto& axes = view.model.drawing.axes;
    if (axes) {
      style_ = axes->style;
      if (axes->x) x_ticks_ = ticks(*axes->x, ranges_.x, view.width(), "x");
      if (axes->y) y_ticks_ = ticks(*axes->y, ranges_.y, view.height(), "y");
    }
    for (const Annotation& one : view.model.drawing.annotations)
      if (one.type == "knots") add_knots(one);
    if (const auto& legend = view.model.drawing.legend; legend && !entries.empty())
      legend_.emplace(
          *legend, entries,
          is_inside(*legend) ? Vec2(view.width(), view.height()) - 2 * kLegendFree : view.room.size() - 2 * free());
  }

  Insets insets() const {
    Insets room = taken();
    if (has_title()) {
      const SheetText title = title_text(view_.model);
      room.top += kTitleOff + title.ascent + title.descent;
    }
    for (double* side : {&room.left, &room.right, &room.top, &room.bottom})
      if (*side > kLine) *side += free();
    const std::string side = legend_ ? view_.model.drawing.legend->side : "";
    if (side == "left" || side == "right") room.least.y = legend_->size().y + 2 * free();
    if (side == "above" || side == "below") room.least.x = legend_->size().x + 2 * free();
    return room;
  }

  GraphWork draw(const LabelObstacles& obstacles) {
    const auto& axes = view_.model.drawing.axes;
    if (axes) draw_axes(*axes);
    draw_knots();
    if (legend_) draw_legend(obstacles);
    if (has_title()) {
      SheetText title = title_text(view_.model);
      const double x = 0.5 * (view_.at.x + right() - title.width);
      const double y = view_.at.y - taken().top - kTitleOff - title.descent;
      put(std::move(title), {x, y}, "title");
    }
    return std::move(work_);
  }

 private:
  using Tick = std::pair<double, SheetText>;

  // Without a margin the page's edge would touch the texts.
  double free() const { return std::max(0.0, kFromEdge - view_.model.paper.margin); }

  // Views that are no graphs have theirs above what they show.
  bool has_title() const { return view_.camera.is_graph() && !view_.model.drawing.title.empty(); }

  // Of the room around the graph, by what stands there, below its title.
  Insets taken() const {
    Insets room;
    const auto& axes = view_.model.drawing.axes;
    if (axes && axes->x) {
      room.bottom = kTick;
      if (!x_ticks_.empty()) room.bottom += below_marks();
      // Half of the last number stands beyond the axis.
      for (const double at : {ranges_.x.lo, ranges_.x.hi})
        for (const auto& [value, text] : x_ticks_)
          if (std::abs(value - at) < kNearEnd * ranges_.x.width())
            (at == ranges_.x.lo ? room.left : room.right) = 0.5 * text.width;
    }
    if (has_knot_texts()) room.bottom += kFromNumbers + knot_text_height();
    if (axes && axes->x && !name(axes->x).empty()) {
      const SheetText text = name_text(axes->x);
      room.bottom += kFromNumbers + text.ascent + text.descent;
    }
    if (axes && axes->y) {
      double left = kTick;
      if (!y_ticks_.empty()) left += kFromTick + width_of(y_ticks_);
      if (!name(axes->y).empty()) left += kFromNumbers + name_height(axes->y);
      room.left = std::max(room.left, left);
      room.top = std::max(room.top, 0.5 * height_of(y_ticks_));
      room.bottom = std::max(room.bottom, 0.5 * height_of(y_ticks_));
    }
    // Half of a text at an end of the axis stands beyond it.
    for (const KnotMarks& one : knots_) {
      if (one.text.empty()) continue;
      const double half = 0.5 * text_in(knot_style_, one.text).width;
      if (std::abs(one.t - ranges_.x.lo) < kNearEnd * ranges_.x.width()) room.left = std::max(room.left, half);
      if (std::abs(one.t - ranges_.x.hi) < kNearEnd * ranges_.x.width()) room.right = std::max(room.right, half);
    }
    // Marks of a multiple knot stand on one another below the axis.
    const Insets legend = legend_room();
    room.left += legend.left, room.right += legend.right, room.top += legend.top, room.bottom += legend.bottom;
    // Lines are as wide as they are.
    room.right = std::max(room.right, kLine), room.top = std::max(room.top, kLine);
    return room;
  }

  std::vector<Tick> ticks(const GraphAxis& axis, const Interval& range, double length, const char* name) {
    if (axis.ticks == "auto") return automatic_ticks(range, length, *name == 'x');
    std::vector<double> inside;
    std::vector<Tick> named;
    const double slack = kAtEnd * range.width();
    const std::vector<double> values = axis.ticks.empty() ? axis.tick_values : std::vector<double>();
    for (size_t k = 0; k < values.size(); ++k)
      if (const double value = values[k]; value >= range.lo - slack && value <= range.hi + slack) {
        inside.push_back(value);
        if (!axis.texts.empty()) named.emplace_back(value, text_in(style_, axis.texts[k].text()));
      } else {
        work_.left_out.push_back(fmt::format("the tick {:.9g} of the {} axis, which shows {:.9g} to {:.9g}", value,
                                             name, range.lo, range.hi));
      }
    std::vector<Tick> result = axis.texts.empty() ? with_numbers(inside) : std::move(named);
    if (const size_t room = with_room(result, range, length, *name == 'x'); room < result.size())
      work_.covered.push_back(fmt::format(
          "the texts at the ticks of the {} axis cover one another: of {} have room {}; fewer `ticks`, or a "
          "larger page",
          name, result.size(), room));
    return result;
  }

  // How many of the texts stand clear of the one before.
  static size_t with_room(std::vector<Tick> ticks, const Interval& range, double length, bool across) {
    const auto by_value = [](const Tick& a, const Tick& b) { return a.first < b.first; };
    std::sort(ticks.begin(), ticks.end(), by_value);
    size_t count = 0;
    double end = -kInfinity;
    for (const auto& [value, text] : ticks) {
      const double at = (value - range.lo) / range.width() * length, half = 0.5 * (across ? text.width : text.ascent);
      if (text.width > 0 && at - half < end) continue;
      if (text.width > 0) end = at + half;
      ++count;
    }
    return count;
  }

  std::vector<Tick> with_numbers(const std::vector<double>& values) const {
    std::vector<Tick> result;
    const std::vector<std::string> texts = numbers_of_scale(values, kDigits);
    for (size_t k = 0; k < values.size(); ++k) result.emplace_back(values[k], text_in(style_, texts[k]));
    return result;
  }

  // Of finer steps if there are few, as long as their numbers stand apart.
  std::vector<Tick> automatic_ticks(const Interval& range, double length, bool across) const {
    double count = length / kPerTick;
    std::vector<Tick> result = with_numbers(round_values(range, count));
    while (result.size() < kFewTicks && count < length) {
      count *= 1.3;
      std::vector<Tick> finer = with_numbers(round_values(range, count));
      if (finer.size() < 2) continue;
      const double apart = (finer[1].first - finer[0].first) / range.width() * length;
      if (apart < kBetweenNumbers + (across ? width_of(finer) : height_of(finer))) break;
      result = std::move(finer);
    }
    return result;
  }

  static double height_of(const std::vector<Tick>& ticks) {
    double height = 0;
    for (const auto& [value, text] : ticks) height = std::max(height, text.ascent);
    return height;
  }
  static double width_of(const std::vector<Tick>& ticks) {
    double width = 0;
    for (const auto& [value, text] : ticks) width = std::max(width, text.width);
    return width;
  }
  // Of the texts at the marks of the x axis; numbers reach no lower than their baseline, fractions do.
  double below_marks() const {
    double depth = 0;
    if (!view_.model.drawing.axes->x->texts.empty())
      for (const auto& [value, text] : x_ticks_) depth = std::max(depth, text.descent);
    return kFromTick + height_of(x_ticks_) + depth;
  }
  static std::string name(const std::optional<GraphAxis>& axis) { return axis ? axis->label.text() : std::string(); }
  SheetText name_text(const std::optional<GraphAxis>& axis) const { return text_in(style_, name(axis)); }
  double name_height(const std::optional<GraphAxis>& axis) const {
    const SheetText text = name_text(axis);
    return text.ascent + text.descent;
  }

  double x_at(double value) const { return view_.at.x + (value - ranges_.x.lo) / ranges_.x.width() * view_.width(); }
  double y_at(double value) const { return view_.at.y + (ranges_.y.hi - value) / ranges_.y.width() * view_.height(); }
  double bottom() const { return view_.at.y + view_.height(); }
  double right() const { return view_.at.x + view_.width(); }

  void put(SheetText text, const Vec2& at, const char* kind, double alignment = 0.5) {
    text.at = at;
    text.alignment = alignment;
    Label label;
    label.text = std::move(text);
    label.side = "here";
    label.kind = kind;
    work_.labels.push_back(std::move(label));
  }

  void draw_axes(const GraphAxes& axes) {
    const LineLook pen = drawn_look(axes.style), grid = drawn_look(axes.grid_style);
    std::vector<SheetItem> lines, grids;
    const auto line = [](std::vector<SheetItem>& list, const Vec2& a, const Vec2& b, const LineLook& look) {
      list.push_back(drawn(straight_path({a, b}), look));
    };
    if (axes.x) {
      line(lines, {view_.at.x, bottom()}, {right(), bottom()}, pen);
      for (const auto& [value, text] : x_ticks_) {
        const double x = x_at(value);
        line(lines, {x, bottom()}, {x, bottom() + kTick}, pen);
        if (axes.x->grid) line(grids, {x, view_.at.y}, {x, bottom()}, grid);
        put(text, {x - 0.5 * text.width, bottom() + kTick + kFromTick + height_of(x_ticks_)}, "tick");
      }
      if (!name(axes.x).empty()) {
        const SheetText text = name_text(axes.x);
        double y = bottom() + kTick + kFromNumbers + text.ascent;
        if (!x_ticks_.empty()) y += below_marks();
        if (has_knot_texts()) y += kFromNumbers + knot_text_height();
        put(text, {0.5 * (view_.at.x + right()) - 0.5 * text.width, y}, "axis");
      }
    }
    if (axes.y) {
      line(lines, {view_.at.x, bottom()}, {view_.at.x, view_.at.y}, pen);
      for (const auto& [value, text] : y_ticks_) {
        const double y = y_at(value);
        line(lines, {view_.at.x, y}, {view_.at.x - kTick, y}, pen);
        if (axes.y->grid) line(grids, {view_.at.x, y}, {right(), y}, grid);
        put(text, {view_.at.x - kTick - kFromTick - text.width, y + 0.5 * text.ascent}, "tick", 1);
      }
      if (!name(axes.y).empty()) {
        // Upwards along the axis.
        SheetText text = name_text(axes.y);
        text.angle = 0.5 * kPi;
        double x = view_.at.x - kTick - kFromNumbers - text.descent;
        if (!y_ticks_.empty()) x -= kFromTick + width_of(y_ticks_);
        put(text, {x, 0.5 * (view_.at.y + bottom()) + 0.5 * text.width}, "axis");
      }
    }
    work_.under.push_back(SheetGroup{"grid", "", {}, {}, std::move(grids)});
    work_.over.push_back(SheetGroup{"axes", "", {}, {}, std::move(lines)});
  }

  // ---------------------------------------------------------------- knots

  void add_knots(const Annotation& annotation) {
    const Fields& f = annotation.values;
    const auto form = f.curve("of")->as_nurbs();
    if (!form) return;
    knot_style_ = annotation.style;
    knot_marker_ = f.text("marker");
    stacked_ = f.text("multiplicity") == "stacked";
    knot_texts_inside_ = f.has("side") && f.text("side").starts_with("above");
    for (size_t i = 0; i < form->knots.size();) {
      size_t last = i;
      while (last + 1 < form->knots.size() && form->knots[last + 1] == form->knots[i]) ++last;
      KnotMarks marks{form->knots[i], static_cast<int>(last - i) + 1, {}};
      if (f.has("label")) {
        const auto& words = f.get<TextTemplate>("label");
        const auto text = [&](size_t k) {
          const double index = static_cast<double>(k);
          return words.text(std::span(&index, 1));
        };
        marks.text = text(i);
        if (last > i) {
          marks.text += last == i + 1 ? "," : "–";
          marks.text += text(last);
        }
      }
      knots_.push_back(std::move(marks));
      i = last + 1;
    }
  }

  bool has_knot_texts() const {
    return !knot_texts_inside_ &&
           std::any_of(knots_.begin(), knots_.end(), [](const KnotMarks& one) { return !one.text.empty(); });
  }
  double knot_text_height() const {
    double height = 0;
    for (const KnotMarks& one : knots_)
      if (!one.text.empty()) {
        const SheetText text = text_in(knot_style_, one.text);
        height = std::max(height, text.ascent + text.descent);
      }
    return height;
  }

  void draw_knots() {
    if (knots_.empty()) return;
    std::vector<SheetItem> signs;
    Mark mark;
    mark.sign = *mark_sign(knot_marker_);
    mark.radius = 0.5 * knot_style_.marker_size;
    mark.line = drawn_look(knot_style_);
    for (const KnotMarks& one : knots_) {
      if (!ranges_.x.contains(one.t)) continue;
      const double x = x_at(one.t);
      for (int k = 0; k < (stacked_ ? one.multiplicity : 1); ++k)
        for (SheetItem& item : drawn_mark(mark, {x, bottom() - 1.3 * knot_style_.marker_size * k}, 1, view_))
          signs.push_back(std::move(item));
      if (one.text.empty()) continue;
      const SheetText text = text_in(knot_style_, one.text);
      double y = bottom() + kTick + kFromNumbers + text.ascent;
      if (!x_ticks_.empty()) y += below_marks();
      if (knot_texts_inside_) y = bottom() - kFromNumbers - text.descent;
      put(text, {x - 0.5 * text.width, y}, "knots");
    }
    work_.over.push_back(SheetGroup{"knots", "", {}, {}, std::move(signs)});
  }

  // ---------------------------------------------------------------- legend

  Insets legend_room() const {
    Insets room;
    if (!legend_) return room;
    const std::string& side = view_.model.drawing.legend->side;
    const Vec2 size = legend_->size();
    if (side == "right") room.right = size.x + kLegendFree;
    if (side == "left") room.left = size.x + kLegendFree;
    if (side == "above") room.top = size.y + kLegendFree;
    if (side == "below") room.bottom = size.y + kLegendFree;
    return room;
  }

  Vec2 place_of_legend(std::string_view side) const {
    const Vec2 size = legend_->size(),
               middle(0.5 * (view_.at.x + right() - size.x), 0.5 * (view_.at.y + bottom() - size.y));
    const Insets room = taken();
    Vec2 at(view_.at.x + kLegendFree, view_.at.y + kLegendFree);
    if (side == "right") at = {right() + room.right - size.x, middle.y};
    if (side == "left") at = {view_.at.x - room.left, middle.y};
    if (side == "above") at = {middle.x, view_.at.y - room.top};
    if (side == "below") at = {middle.x, bottom() + room.bottom - size.y};
    if (side.ends_with(" right")) at.x = right() - kLegendFree - size.x;
    if (side.starts_with("below ")) at.y = bottom() - kLegendFree - size.y;
    // Larger than the graph, it still stays in its place on the page.
    const Vec2 before(room.left, room.top), after(room.right, room.bottom);
    return glm::max(view_.at - before, glm::min(at, Vec2(right(), bottom()) + after - size));
  }
  // With a free border.
  SheetBox ground_of_legend(const Vec2& at) const { return {at - kLegendBorder, at + legend_->size() + kLegendBorder}; }

  // In the corner that the scene says, or else the first that is free, if one is.
  Vec2 place_in_corner(const std::string& corner, const LabelObstacles& obstacles) {
    for (const char* side : {corner.c_str(), "above right", "above left", "below left", "below right"})
      if (const Vec2 at = place_of_legend(side); is_free(ground_of_legend(at), obstacles)) return at;
    work_.covered.emplace_back(
        "the legend covers lines, which run through all corners; a `side` beside the picture has room for it");
    return place_of_legend(corner);
  }

  void draw_legend(const LabelObstacles& obstacles) {
    const Legend& legend = *view_.model.drawing.legend;
    const Vec2 at = is_inside(legend) ? place_in_corner(legend.side, obstacles) : place_of_legend(legend.side);
    std::vector<SheetItem> samples;
    if (is_inside(legend)) {
      // Over the grid of a graph.
      const auto [lo, hi] = ground_of_legend(at);
      SheetPath ground;
      ground.parts = {straight_path({lo, {hi.x, lo.y}, hi, {lo.x, hi.y}}, true)};
      ground.brush = Brush{legend.style.fill ? rgb(*legend.style.fill) : rgb(view_.model.drawing.paper), 1};
      samples.emplace_back(std::move(ground));
    }
    for (SheetItem& item : legend_->draw(at, view_, work_.labels)) samples.push_back(std::move(item));
    work_.over.push_back(SheetGroup{"legend", "", {}, {}, std::move(samples)});
  }

  const View& view_;
  Ranges ranges_;
  Style style_;
  std::vector<Tick> x_ticks_, y_ticks_;
  std::vector<KnotMarks> knots_;
  Style knot_style_;
  std::string knot_marker_;
  bool stacked_ = true, knot_texts_inside_ = false;
  std::optional<LegendTable> legend_;
  GraphWork work_;
};

}  // namespace

Insets insets_of(const View& view, const std::vector<LegendEntry>& entries) { return Axes(view, entries).insets(); }

GraphWork graph_axes(const View& view, const std::vector<LegendEntry>& entries, const LabelObstacles& obstacles) {
  return Axes(view, entries).draw(obstacles);
}

std::vector<double> round_values(const Interval& range, double count) {
  const double rough = range.width() / std::max(count, 1.0);
  const double power = std::pow(10, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0})
    if (factor * power >= 0.999 * rough) step = factor * power;
  std::vector<double> values;
  const double slack = kAtEnd * range.width() / step;
  for (double k = std::ceil(range.lo / step - slack); k <= range.hi / step + slack; ++k) values.push_back(k * step);
  return values;
}

}  // namespace lekalo::render
