#include "render/drawing/output/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "render/drawing/output/cairo_output.h"
#include "render/drawing/output/element_names.h"
#include "render/drawing/text/fonts.h"
#include "render/image/display.h"
#include "render/scene/values/characters.h"

namespace lekalo::render {

namespace {

// Millimetres with four decimals: a ten-thousandth of what is seen.
std::string number(double x) {
  std::string text = fmt::format("{:.4f}", x);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string point(const Vec2& p) { return fmt::format("{} {}", number(p.x), number(p.y)); }

std::string color_text(const Spectrum& color) {
  const auto byte = [](double linear) {
    return static_cast<int>(std::lround(255 * std::clamp(srgb_encode(linear), 0.0, 1.0)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(color[0]), byte(color[1]), byte(color[2]));
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t three = 0;
    for (size_t k = 0; k < 3; ++k)
      three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (size_t k = 0; k < 4; ++k) result += i + k <= bytes.size() ? kDigits[three >> (18 - 6 * k) & 63] : '=';
  }
  return result;
}

std::string step_text(const PathStep& step) {
  switch (step.kind) {
    case PathStep::Kind::line:
      return fmt::format(" L{}", point(step.to));
    case PathStep::Kind::curve:
      return fmt::format(" C{} {} {}", point(step.first), point(step.second), point(step.to));
    case PathStep::Kind::arc: {
      const Vec2 &x = step.ellipse.x, &y = step.ellipse.y;
      const bool clockwise = (x.x * y.y - x.y * y.x) * (step.end - step.begin) > 0;  // as seen: y downwards
      const double rx = glm::length(x), ry = glm::length(y);
      const bool round = std::abs(rx - ry) < 1e-5;
      return fmt::format(" A{} {} {} 0 {} {}", number(rx), number(ry),
                         round ? "0" : number(std::atan2(x.y, x.x) * 180 / geometry::kPi), clockwise ? 1 : 0,
                         point(step.to));
    }
  }
  return {};
}

// Behind what is there already.
void append(std::string& data, const Path& path) {
  data += fmt::format("{}M{}", data.empty() ? "" : " ", point(path.from));
  for (const PathStep& step : path.steps) data += step_text(step);
  if (path.closed) data += " Z";
}

class Writer {
 public:
  Writer(const Sheet& sheet, const SvgOptions& options) : sheet_(sheet), options_(options) {}

  std::string write() {
    std::string body;
    std::swap(text_, body);
    items(sheet_.items);
    std::swap(text_, body);
    text_ += "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    text_ += fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" version=\"1.1\" "
        "width=\"{0}mm\" height=\"{1}mm\" viewBox=\"{2} {0} {1}\">\n",
        number(sheet_.width), number(sheet_.height), point(sheet_.corner));
    if (!sheet_.title.empty()) text_ += fmt::format("<title>{}</title>\n", xml_text(sheet_.title));
    write_fonts();
    text_ += definitions_;
    text_ += fmt::format("<rect class=\"paper\"{} width=\"{}\" height=\"{}\" fill=\"{}\"/>\n", paper_corner(),
                         number(sheet_.width), number(sheet_.height), color_text(sheet_.paper));
    text_ += "<g fill=\"none\" stroke-linejoin=\"round\">\n" + body + "</g>\n</svg>\n";
    return std::move(text_);
  }

 private:
  void items(const std::vector<SheetItem>& list) {
    for (const SheetItem& item : list) std::visit([&](const auto& one) { write(one); }, item);
  }

  std::string paper_corner() const {
    const Vec2& at = sheet_.corner;
    return at == Vec2(0) ? std::string() : fmt::format(" x=\"{}\" y=\"{}\"", number(at.x), number(at.y));
  }

  // Of what stands in a group without being one.
  std::string next_id() {
    const std::string id = names_.next();
    return id.empty() ? id : fmt::format(" id=\"{}\"", id);
  }

  static std::string clip_shape(const SheetGroup& group) {
    const Vec2 &lo = *group.clip_at, &size = group.clip_size;
    if (!group.clip_is_round)
      return fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>", number(lo.x), number(lo.y),
                         number(size.x), number(size.y));
    const Vec2 center = lo + 0.5 * size;
    return fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\"/>", number(center.x), number(center.y),
                       number(0.5 * size.x));
  }

  void write(const SheetGroup& group) {
    if (group.items.empty()) return;
    const ElementNames::Within within(names_, group);
    text_ += fmt::format("<g id=\"{}\" class=\"{}\"", within.name(), xml_text(group.kind));
    if (!group.object.empty()) text_ += fmt::format(" data-object=\"{}\"", xml_text(group.object));
    if (group.clip_at) {
      const std::string clip = names_.unique("clip");
      definitions_ += fmt::format("<clipPath id=\"{}\">{}</clipPath>\n", clip, clip_shape(group));
      text_ += fmt::format(" clip-path=\"url(#{})\"", clip);
    }
    text_ += ">\n";
    items(group.items);
    text_ += "</g>\n";
  }

  void write(const SheetPath& path) {
    std::string data;
    for (const Path& part : path.parts) append(data, part);
    text_ += fmt::format("<path{} d=\"{}\"", next_id(), data);
    if (path.brush) {
      text_ += fmt::format(" fill=\"{}\"", color_text(path.brush->color));
      if (path.brush->opacity < 1) text_ += fmt::format(" fill-opacity=\"{}\"", number(path.brush->opacity));
    } else if (path.gradient) {
      text_ += fmt::format(" fill=\"url(#{})\"", define(*path.gradient));
    }
    if ((path.brush || path.gradient) && path.parts.size() > 1) text_ += " fill-rule=\"evenodd\"";
    if (path.pen) text_ += pen_text(*path.pen);
    text_ += "/>\n";
  }

  std::string define(const Gradient& gradient) {
    const std::string id = names_.unique("gradient");
    const char* const kind = gradient.radial ? "radialGradient" : "linearGradient";
    definitions_ += fmt::format("<{} id=\"{}\" gradientUnits=\"userSpaceOnUse\"", kind, id);
    const Vec2 &a = gradient.from, &b = gradient.to;
    definitions_ += gradient.radial ? fmt::format(" cx=\"{}\" cy=\"{}\" r=\"{}\">", number(a.x), number(a.y),
                                                  number(glm::length(b - a)))
                                    : fmt::format(" x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\">", number(a.x), number(a.y),
                                                  number(b.x), number(b.y));
    for (const Gradient::Stop& stop : gradient.stops)
      definitions_ +=
          fmt::format("<stop offset=\"{}\" stop-color=\"{}\"/>", number(stop.offset), color_text(stop.color));
    definitions_ += fmt::format("</{}>\n", kind);
    return id;
  }

  static std::string pen_text(const LineLook& pen) {
    std::string text =
        fmt::format(" stroke=\"{}\" stroke-width=\"{}\"", color_text(pen.color), number(2 * pen.half_width));
    if (pen.opacity < 1) text += fmt::format(" stroke-opacity=\"{}\"", number(pen.opacity));
    if (!pen.dash.empty()) {
      std::string dash;
      for (const double length : pen.dash) dash += fmt::format("{}{}", dash.empty() ? "" : " ", number(length));
      text += fmt::format(" stroke-dasharray=\"{}\"", dash);
    }
    if (pen.cap == LineLook::Cap::round) text += " stroke-linecap=\"round\"";
    if (pen.cap == LineLook::Cap::square) text += " stroke-linecap=\"square\"";
    if (pen.join == LineLook::Join::miter) text += " stroke-linejoin=\"miter\"";
    if (pen.join == LineLook::Join::bevel) text += " stroke-linejoin=\"bevel\"";
    return text;
  }

  void write(const SheetText& text) {
    const std::string color = color_text(text.brush.color);
    const std::string opacity =
        text.brush.opacity < 1 ? fmt::format(" opacity=\"{}\"", number(text.brush.opacity)) : std::string();
    text_ += fmt::format("<g{} transform=\"translate({})", next_id(), point(text.at));
    if (text.angle != 0) text_ += fmt::format(" rotate({})", number(-text.angle * 180 / geometry::kPi));
    text_ += fmt::format("\"{}>", opacity);
    if (options_.outlines) {
      std::string data;
      for (const TextRun& run : text.runs)
        for (const Path& outline : text_outlines(run)) append(data, outline);
      if (!data.empty()) text_ += fmt::format("<path d=\"{}\" fill=\"{}\"/>", data, color);
    } else if (!text.runs.empty()) {
      text_ += fmt::format("<text fill=\"{}\" xml:space=\"preserve\">", color);
      for (const TextRun& run : text.runs) {
        used_[run.font] += run.text;
        text_ += fmt::format("<tspan x=\"{}\" y=\"{}\" font-family=\"{}\" font-size=\"{}\"{}{}>{}</tspan>",
                             number(run.at.x), number(run.at.y), xml_text(run.font.family), number(run.size),
                             run.font.italic ? " font-style=\"italic\"" : "",
                             run.font.bold ? " font-weight=\"bold\"" : "", xml_text(run.text));
      }
      text_ += "</text>";
    }
    std::string strokes;
    for (const Path& stroke : text.strokes) append(strokes, stroke);
    if (!strokes.empty())
      text_ +=
          fmt::format("<path d=\"{}\" stroke=\"{}\" stroke-width=\"{}\"/>", strokes, color, number(text.stroke_width));
    text_ += "</g>\n";
  }

  void write(const SheetPicture& picture) {
    text_ += fmt::format(
        "<image{} x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" "
        "xlink:href=\"data:image/png;base64,{}\"/>\n",
        next_id(), number(picture.at.x), number(picture.at.y), number(picture.width), number(picture.height),
        base64(png_bytes(*picture.picture)));
  }

  void write_fonts() {
    if (used_.empty()) return;
    text_ += "<style>\n";
    for (const auto& [font, characters] : used_)
      text_ += fmt::format(
          "@font-face {{ font-family: \"{}\"; font-style: {}; font-weight: {}; src: "
          "url(data:font/ttf;base64,{}); }}\n",
          font.family, font.italic ? "italic" : "normal", font.bold ? "bold" : "normal",
          base64(font_subset(font, characters)));
    text_ += "</style>\n";
  }

  const Sheet& sheet_;
  const SvgOptions& options_;
  std::string text_, definitions_;
  std::map<Font, std::string> used_;  // characters
  ElementNames names_;
};

}  // namespace

std::string svg_of(const Sheet& sheet, const SvgOptions& options) {
  demand_finite(sheet);
  return Writer(sheet, options).write();
}

}  // namespace lekalo::render
