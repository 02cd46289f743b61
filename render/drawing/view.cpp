#include "render/drawing/view.h"

#include "render/drawing/text/text_layout.h"

namespace lekalo::render {

namespace {

// Half the width of an arrow's head for its length: 20 degrees between its sides (ISO 129-1).
constexpr double kHeadSlope = 0.176;
constexpr double kMinHead = 3;  // half widths of its line: heads of thick lines are to be seen

}  // namespace

Path straight_path(std::initializer_list<Vec2> points, bool closed) {
  Path path;
  path.from = *points.begin();
  for (const Vec2* p = points.begin() + 1; p != points.end(); ++p) path.steps.push_back(line_to(*p));
  path.closed = closed;
  return path;
}

SheetPath drawn(Path path, const LineLook& pen) {
  SheetPath result;
  result.parts.push_back(std::move(path));
  result.pen = pen;
  return result;
}

SheetPath arrow_head(const Vec2& tip, const Vec2& way, double length, const LineLook& pen) {
  const Vec2 across(-way.y, way.x), back = tip - length * way;
  const double half = std::max(kHeadSlope * length, kMinHead * pen.half_width);
  SheetPath head;
  head.parts.push_back(straight_path({tip, back + half * across, back - half * across}, true));
  head.brush = Brush{pen.color, pen.opacity};
  return head;
}

double shortened_by(double arrow_length) { return 0.7 * arrow_length; }

std::vector<SheetItem> drawn_mark(const Mark& mark, const Vec2& at, double opacity, const View& view) {
  if (!(opacity > 0)) return {};
  const double r = mark.radius;
  LineLook pen = mark.line;
  pen.opacity = opacity;
  pen.dash.clear();
  const Brush brush{mark.fill.value_or(mark.line.color), opacity};
  const auto path = [&](std::initializer_list<Vec2> corners, bool closed) {
    Path result;
    for (const Vec2& corner : corners)
      if (corners.begin() == &corner)
        result.from = at + r * corner;
      else
        result.steps.push_back(line_to(at + r * corner));
    result.closed = closed;
    return result;
  };
  SheetPath sign;
  const auto filled = [&](std::initializer_list<Vec2> corners) {
    sign.parts = {path(corners, true)};
    sign.brush = brush;
  };
  const auto round = [&] {
    sign.parts = {{at + Vec2(r, 0), arcs_to({at, {r, 0}, {0, r}}, 0, geometry::kTwoPi), true}};
  };
  switch (mark.sign) {
    case Mark::Sign::dot:
    case Mark::Sign::ball:
      round();
      sign.brush = brush;
      break;
    case Mark::Sign::circle:
      round();
      sign.brush = Brush{mark.fill.value_or(rgb(view.model.drawing.paper)), opacity};
      sign.pen = pen;
      break;
    case Mark::Sign::cross:
      sign.parts = {path({{-0.7, -0.7}, {0.7, 0.7}}, false), path({{-0.7, 0.7}, {0.7, -0.7}}, false)};
      sign.pen = pen;
      break;
    case Mark::Sign::plus:
      sign.parts = {path({{-1, 0}, {1, 0}}, false), path({{0, -1}, {0, 1}}, false)};
      sign.pen = pen;
      break;
    case Mark::Sign::square:
      filled({{-0.8, -0.8}, {0.8, -0.8}, {0.8, 0.8}, {-0.8, 0.8}});
      break;
    case Mark::Sign::triangle:
      filled({{0, -1}, {0.87, 0.5}, {-0.87, 0.5}});
      break;
    case Mark::Sign::diamond:
      filled({{0, -1}, {1, 0}, {0, 1}, {-1, 0}});
      break;
  }
  return {sign};
}

SheetText text_in(const Style& style, const std::string& tex) {
  SheetText text = laid_out(tex, style.font, style.text_size);
  text.brush = {rgb(style.color), style.opacity};
  return text;
}

}  // namespace lekalo::render
