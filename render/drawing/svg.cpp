#include "render/drawing/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/drawing/paths.h"
#include "render/image/display.h"

namespace lekalo::render {

namespace {

constexpr double kFitted = 0.01;  // pixels

// Millimetres with four decimals: a ten-thousandth of what is seen.
std::string number(double x) {
  std::string text = fmt::format("{:.4f}", x);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '&')
      result += "&amp;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

std::string color_text(const Spectrum& color) {
  const auto byte = [](double linear) {
    return static_cast<int>(std::lround(255 * std::clamp(srgb_encode(linear), 0.0, 1.0)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(color[0]), byte(color[1]), byte(color[2]));
}

class Writer {
 public:
  Writer(const VisibleLines& drawing, const Model& model, const std::vector<std::string>& names)
      : drawing_(drawing), model_(model), names_(names), scale_(millimetres_of_pixel(model)) {}

  std::string write() {
    const double width = model_.film.width * scale_, height = model_.film.height * scale_;
    text_ += "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    text_ += fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"{0}mm\" height=\"{1}mm\" viewBox=\"0 0 {0} "
        "{1}\">\n",
        number(width), number(height));
    if (!model_.title.empty()) text_ += fmt::format("<title>{}</title>\n", escaped(model_.title));
    text_ += fmt::format("<rect class=\"paper\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n", number(width),
                         number(height), color_text(rgb(model_.drawing.paper)));
    text_ += "<g fill=\"none\" stroke-linejoin=\"round\">\n";
    // What is hidden lies under what is seen.
    for (const bool hidden : {true, false}) write_lines(hidden);
    for (const VisibleMark& mark : drawing_.marks) write_mark(mark);
    text_ += "</g>\n</svg>\n";
    return std::move(text_);
  }

 private:
  void write_lines(bool hidden) {
    std::string group;
    for (const VisibleLine& line : drawing_.lines) {
      const LineLook* look = hidden ? line.stroke.hidden ? &*line.stroke.hidden : nullptr : &line.stroke.look;
      if (!look) continue;
      std::vector<double> breaks;
      for (const geometry::CurvePiece& piece : line.stroke.curve->pieces()) breaks.push_back(piece.domain.lo);
      for (const VisiblePiece& piece : line.pieces) {
        if ((piece.layers > 0) != hidden) continue;
        const std::string name =
            fmt::format("{} {}{}", names_[line.stroke.object], line.stroke.kind, hidden ? " hidden" : "");
        if (name != group) {
          close(group);
          group = name;
          text_ += fmt::format("<g class=\"{}{}\" data-object=\"{}\">\n", line.stroke.kind, hidden ? " hidden" : "",
                               escaped(names_[line.stroke.object]));
        }
        text_ += fmt::format("<path d=\"{}\" {}/>\n", data_of(fitted_path(*line.curve, piece.t, breaks, kFitted)),
                             attributes(*look));
      }
    }
    close(group);
  }
  void close(std::string& group) {
    if (!group.empty()) text_ += "</g>\n";
    group.clear();
  }

  std::string point(const Vec2& p) const { return fmt::format("{} {}", number(p.x * scale_), number(p.y * scale_)); }

  std::string data_of(const Path& path) const {
    std::string data = fmt::format("M{}", point(path.from));
    for (const PathStep& step : path.steps)
      data += step.straight ? fmt::format(" L{}", point(step.to))
                            : fmt::format(" C{} {} {}", point(step.first), point(step.second), point(step.to));
    if (path.closed) data += " Z";
    return data;
  }

  static std::string attributes(const LineLook& look) {
    std::string text =
        fmt::format("stroke=\"{}\" stroke-width=\"{}\"", color_text(look.color), number(2 * look.half_width));
    if (look.opacity < 1) text += fmt::format(" stroke-opacity=\"{}\"", number(look.opacity));
    if (!look.dash.empty()) {
      std::string dash;
      for (const double length : look.dash) dash += fmt::format("{}{}", dash.empty() ? "" : " ", number(length));
      text += fmt::format(" stroke-dasharray=\"{}\"", dash);
    }
    if (look.cap == LineLook::Cap::round) text += " stroke-linecap=\"round\"";
    if (look.cap == LineLook::Cap::square) text += " stroke-linecap=\"square\"";
    return text;
  }

  void write_mark(const VisibleMark& visible) {
    const Mark& mark = visible.mark;
    const double opacity = visible.layers > 0 ? mark.hidden_opacity.value_or(0) : mark.line.opacity;
    if (!(opacity > 0)) return;
    const Vec2 at = visible.place * scale_;
    const double r = mark.radius;
    const std::string color = color_text(mark.line.color);
    const std::string fill = mark.fill ? color_text(*mark.fill) : color;
    const auto lines = [&](const std::string& first, const std::string& second) {
      return fmt::format("<path class=\"mark\" d=\"{} {}\" {}/>\n", first, second, attributes(mark.line));
    };
    const auto path = [&](std::initializer_list<Vec2> points, bool closed) {
      std::string data;
      for (const Vec2& p : points)
        data += fmt::format("{}{} {}", data.empty() ? "M" : " L", number(at.x + r * p.x), number(at.y + r * p.y));
      if (closed) data += " Z";
      return data;
    };
    const auto filled = [&](const std::string& data) {
      return fmt::format("<path class=\"mark\" d=\"{}\" fill=\"{}\" fill-opacity=\"{}\"/>\n", data, fill,
                         number(opacity));
    };
    switch (mark.sign) {
      case Mark::Sign::dot:
      case Mark::Sign::ball:
        text_ += fmt::format("<circle class=\"mark\" cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\" fill-opacity=\"{}\"/>\n",
                             number(at.x), number(at.y), number(r), fill, number(opacity));
        break;
      case Mark::Sign::circle:
        text_ += fmt::format("<circle class=\"mark\" cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\" {}/>\n", number(at.x),
                             number(at.y), number(r), mark.fill ? fill : color_text(rgb(model_.drawing.paper)),
                             attributes(mark.line));
        break;
      case Mark::Sign::cross:
        text_ += lines(path({{-0.7, -0.7}, {0.7, 0.7}}, false), path({{-0.7, 0.7}, {0.7, -0.7}}, false));
        break;
      case Mark::Sign::plus:
        text_ += lines(path({{-1, 0}, {1, 0}}, false), path({{0, -1}, {0, 1}}, false));
        break;
      case Mark::Sign::square:
        text_ += filled(path({{-0.8, -0.8}, {0.8, -0.8}, {0.8, 0.8}, {-0.8, 0.8}}, true));
        break;
      case Mark::Sign::triangle:
        text_ += filled(path({{0, -1}, {0.87, 0.5}, {-0.87, 0.5}}, true));
        break;
      case Mark::Sign::diamond:
        text_ += filled(path({{0, -1}, {1, 0}, {0, 1}, {-1, 0}}, true));
        break;
    }
  }

  const VisibleLines& drawing_;
  const Model& model_;
  const std::vector<std::string>& names_;
  double scale_;  // millimetres of a pixel
  std::string text_;
};

}  // namespace

std::string svg_of(const VisibleLines& drawing, const Model& model, const std::vector<std::string>& object_names) {
  return Writer(drawing, model, object_names).write();
}

}  // namespace lekalo::render
