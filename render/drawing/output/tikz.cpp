#include "render/drawing/output/tikz.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>
#include <stdexcept>
#include <utility>

#include "render/drawing/output/cairo_output.h"
#include "render/drawing/output/element_names.h"
#include "render/drawing/output/latex.h"
#include "render/image/display.h"

namespace lekalo::render {

namespace {

// As near as those of PDF files, in millimetres.
constexpr double kArcTolerance = 1e-4;
// Longer lines are broken.
constexpr size_t kLineLength = 110;

// Four decimals: in millimetres a ten-thousandth of what is seen.
std::string number(double x) {
  std::string text = fmt::format("{:.4f}", x);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::array<std::string, 3> channels_of(const Spectrum& color) {
  std::array<std::string, 3> result;
  for (int k = 0; k < 3; ++k) result[static_cast<size_t>(k)] = number(std::clamp(srgb_encode(color[k]), 0.0, 1.0));
  return result;
}

std::string color_text(const Spectrum& color) {
  const auto [red, green, blue] = channels_of(color);
  return fmt::format("{{rgb,1:red,{};green,{};blue,{}}}", red, green, blue);
}

std::string pen_text(const LineLook& pen) {
  std::string text = fmt::format("draw={},line width={}mm", color_text(pen.color), number(2 * pen.half_width));
  if (pen.opacity < 1) text += fmt::format(",draw opacity={}", number(pen.opacity));
  if (!pen.dash.empty()) {
    // A list of odd length is drawn and left out in turn.
    std::string dash;
    for (size_t i = 0; i < pen.dash.size() * (pen.dash.size() % 2 + 1); ++i)
      dash += fmt::format("{}{} {}mm", i ? " " : "", i % 2 ? "off" : "on", number(pen.dash[i % pen.dash.size()]));
    text += fmt::format(",dash pattern={}", dash);
  }
  if (pen.cap == LineLook::Cap::round) text += ",line cap=round";
  if (pen.cap == LineLook::Cap::square) text += ",line cap=rect";
  if (pen.join == LineLook::Join::miter) text += ",line join=miter";
  if (pen.join == LineLook::Join::bevel) text += ",line join=bevel";
  return text;
}

std::string brush_text(const Brush& brush) {
  std::string text = fmt::format("fill={},even odd rule", color_text(brush.color));
  if (brush.opacity < 1) text += fmt::format(",fill opacity={}", number(brush.opacity));
  return text;
}

class Writer {
 public:
  Writer(const Sheet& sheet, std::string stem) : sheet_(sheet), stem_(std::move(stem)) {}

  TikzDrawing write(bool standalone) {
    items(sheet_.items);
    TikzDrawing result;
    result.pictures = std::move(pictures_);
    const std::string packages = letters_packages(texts_);
    result.text = fmt::format(
        "{}{}\n", kTikzMagic,
        standalone ? ""
                   : fmt::format(". In the document: \\usepackage{{tikz,amsmath,amssymb}}{}{}, then \\input this file.",
                                 packages.empty() ? "" : " and ", packages));
    result.text +=
        "% \\tikzset{lekalo/hidden/.style={...}} before it changes all lines of a kind, lekalo/NAME/.style one path;\n"
        "% \\def\\lekalowidth{120mm} makes the drawing, not its texts and line widths, larger or smaller.\n";
    if (standalone)
      result.text +=
          fmt::format("\\documentclass{{standalone}}\n\\usepackage{{tikz,amsmath,amssymb}}\n{}\\begin{{document}}%\n",
                      packages.empty() ? "" : packages + "\n");
    result.text += "\\begingroup%\n" + letters_macro(texts_) + styles() + picture() + "\\endgroup%\n";
    if (standalone) result.text += "\\end{document}\n";
    return result;
  }

 private:
  std::string place(const Vec2& p) const {
    return fmt::format("({},{})", number(p.x - sheet_.corner.x), number(sheet_.height - (p.y - sheet_.corner.y)));
  }

  // Styles of classes and names are the document's, where it has them.
  std::string styles() const {
    std::string text =
        "\\pgfkeysifdefined{/tikz/lekalo/name/.@cmd}{}{\\tikzset{lekalo/name/.style={lekalo/#1/.try}}}%\n";
    text += "\\def\\lekaloclass#1{\\pgfkeysifdefined{/tikz/lekalo/#1/.@cmd}{}{\\tikzset{lekalo/#1/.style={}}}}%\n";
    for (const std::string& name : classes_) text += fmt::format("\\lekaloclass{{{}}}%\n", name);
    for (size_t i = 0; i < looks_.size(); ++i)
      text += fmt::format("\\tikzset{{lekalo/look-{}/.style={{{}}}}}%\n", i + 1, looks_[i]);
    return text;
  }

  std::string picture() const {
    const std::string page = fmt::format("(0,0) rectangle ({},{})", number(sheet_.width), number(sheet_.height));
    const bool white = sheet_.paper[0] >= 1 && sheet_.paper[1] >= 1 && sheet_.paper[2] >= 1;
    return fmt::format(
        "\\ifx\\lekalowidth\\undefined\\setlength{{\\unitlength}}{{1mm}}%\n"
        "\\else\\setlength{{\\unitlength}}{{\\lekalowidth}}\\setlength{{\\unitlength}}{{{:.8f}\\unitlength}}\\fi%\n"
        "\\begin{{tikzpicture}}[x=\\unitlength,y=\\unitlength,line join=round,line cap=butt,"
        "every node/.style={{inner sep=0pt,outer sep=0pt}}]%\n"
        "\\path[use as bounding box{}] {};\n\\begin{{scope}}\n\\clip {};\n{}\\end{{scope}}\n{}\\end{{tikzpicture}}%\n",
        1 / sheet_.width, white ? "" : ",fill=" + color_text(sheet_.paper), page, page, body_, texts_);
  }

  void items(const std::vector<SheetItem>& list) {
    for (const SheetItem& item : list) std::visit([&](const auto& one) { write(one); }, item);
  }

  void write(const SheetGroup& group) {
    if (group.items.empty()) return;
    const ElementNames::Within within(names_, group);
    const std::string outer = std::exchange(within_, class_options(group.kind));
    if (group.clip_at) {
      const Vec2 &lo = *group.clip_at, hi = lo + group.clip_size;
      body_ += group.clip_is_round ? fmt::format("\\begin{{scope}}\n\\clip {} circle[radius={}];\n",
                                                 place(0.5 * (lo + hi)), number(0.5 * group.clip_size.x))
                                   : fmt::format("\\begin{{scope}}\n\\clip {} rectangle {};\n", place(lo), place(hi));
    }
    items(group.items);
    if (group.clip_at) body_ += "\\end{scope}\n";
    within_ = outer;
  }

  // "silhouette hidden": lekalo/silhouette,lekalo/hidden.
  std::string class_options(const std::string& kind) {
    std::string options;
    for (size_t begin = 0; begin < kind.size();) {
      const size_t end = std::min(kind.find(' ', begin), kind.size());
      const std::string name = name_token(std::string_view(kind).substr(begin, end - begin));
      begin = end + 1;
      if (name.empty()) continue;
      classes_.insert(name);
      options += fmt::format(",lekalo/{}", name);
    }
    return options;
  }

  std::string look(const std::string& options) {
    const auto found = std::find(looks_.begin(), looks_.end(), options);
    const auto index = found - looks_.begin() + 1;
    if (found == looks_.end()) looks_.push_back(options);
    return fmt::format("lekalo/look-{}", index);
  }

  // Behind the look, so that it wins.
  std::string class_and_name() {
    const std::string name = names_.next();
    return within_ + (name.empty() ? "" : ",lekalo/name=" + name);
  }

  std::string path_text(const std::vector<Path>& parts) const {
    std::string text;
    size_t line = 0;  // where it begins
    const auto append = [&](const std::string& word) {
      if (text.size() - line + word.size() > kLineLength) text += "\n  ", line = text.size();
      text += " " + word;
    };
    for (const Path& given : parts) {
      const Path part = without_arcs(given, kArcTolerance);
      if (part.steps.empty()) continue;
      append(place(part.from));
      // The last side of a polygon is drawn by "cycle".
      const PathStep& last = part.steps.back();
      const bool is_side =
          part.closed && part.steps.size() > 1 && last.kind == PathStep::Kind::line && last.to == part.from;
      for (const PathStep& step : std::span(part.steps).first(part.steps.size() - (is_side ? 1 : 0)))
        append(step.kind == PathStep::Kind::line
                   ? fmt::format("-- {}", place(step.to))
                   : fmt::format(".. controls {} and {} .. {}", place(step.first), place(step.second), place(step.to)));
      if (part.closed) append("-- cycle");
    }
    return text;
  }

  void write(const SheetPath& path) {
    const std::string data = path_text(path.parts), options = class_and_name();
    if (data.empty()) return;
    if (path.gradient && !path.brush) body_ += shading_text(*path.gradient, data);
    std::string looks;
    if (path.brush) looks = brush_text(*path.brush);
    if (path.pen) looks += fmt::format("{}{}", looks.empty() ? "" : ",", pen_text(*path.pen));
    if (looks.empty()) return;
    body_ += fmt::format("\\path[{}{}]{};\n", look(looks), options, data);
  }

  // Colours over all of the page, cut at the path. Stops before 0 and behind 1 keep the colours of the ends.
  std::string shading_text(const Gradient& gradient, const std::string& data) {
    const double length = glm::length(gradient.to - gradient.from);
    const double far = 2 * (sheet_.width + sheet_.height) + length;
    const double begin = gradient.radial ? 0 : far;
    std::string colors;
    const auto add = [&](double at, const Spectrum& color) {
      const auto [red, green, blue] = channels_of(color);
      colors += fmt::format("{}rgb({}mm)=({},{},{})", colors.empty() ? "" : ";", number(at), red, green, blue);
    };
    // PGF takes the first stop for 0.
    if (begin + gradient.stops.front().offset * length > 0) add(0, gradient.stops.front().color);
    for (const Gradient::Stop& stop : gradient.stops) add(begin + stop.offset * length, stop.color);
    add(begin + length + far, gradient.stops.back().color);
    const std::string name = fmt::format("lekalo-{}", ++shadings_);
    const std::string declared =
        gradient.radial
            ? fmt::format("\\pgfdeclareradialshading{{{}}}{{\\pgfpointorigin}}{{{}}}", name, colors)
            : fmt::format("\\pgfdeclarehorizontalshading{{{}}}{{{}mm}}{{{}}}", name, number(2 * far), colors);
    const Vec2 d = gradient.to - gradient.from;
    const double angle = gradient.radial ? 0 : std::atan2(-d.y, d.x) * 180 / geometry::kPi;
    const Vec2 at = gradient.radial ? gradient.from : (gradient.from + gradient.to) / 2.0;
    return fmt::format(
        "\\begin{{scope}}[even odd rule]\n\\clip{};\n{}\n\\node[rotate={}] at {} "
        "{{\\pgfuseshading{{{}}}}};\n\\end{{scope}}\n",
        data, declared, number(angle), place(at), name);
  }

  void write(const SheetText& text) {
    const std::string options = class_and_name();
    const Vec2 along(std::cos(text.angle), -std::sin(text.angle));
    const Vec2 at = text.at + text.alignment * text.width * along;
    const Vec2 on_page = at - sheet_.corner;
    if (!(on_page.x >= 0 && on_page.y >= 0 && on_page.x <= sheet_.width && on_page.y <= sheet_.height)) return;
    std::string look_text = fmt::format("text={}", color_text(text.brush.color));
    if (text.brush.opacity < 1) look_text += fmt::format(",text opacity={}", number(text.brush.opacity));
    look_text += fmt::format(",font={}", latex_font_size(text));
    const char* anchor = text.alignment < 0.25 ? "base west" : text.alignment > 0.75 ? "base east" : "base";
    texts_ += fmt::format("\\node[{}{},anchor={}{}] at {} {{{}}};\n", look(look_text), options, anchor,
                          text.angle != 0 ? fmt::format(",rotate={}", number(text.angle * 180 / geometry::kPi)) : "",
                          place(at), latex_text(text.tex));
  }

  void write(const SheetPicture& picture) {
    names_.next();
    const std::string file = fmt::format("{}-{}.png", stem_, pictures_.size() + 1);
    body_ += fmt::format(
        "\\node[anchor=north west] at {} {{\\includegraphics[width={}\\unitlength,height={}\\unitlength]{{{}}}}};\n",
        place(picture.at), number(picture.width), number(picture.height), file_for_latex(file));
    pictures_.push_back({file, png_bytes(*picture.picture)});
  }

  const Sheet& sheet_;
  std::string stem_;
  std::string body_, texts_, within_;
  std::vector<std::string> looks_;
  std::set<std::string> classes_;
  ElementNames names_;
  std::vector<TikzDrawing::Picture> pictures_;
  int shadings_ = 0;
};

}  // namespace

TikzDrawing tikz_of(const Sheet& sheet, const std::string& stem, bool standalone) {
  demand_finite(sheet);
  if (!latex_takes_file(stem)) throw std::invalid_argument(fmt::format("LaTeX takes no file called '{}'", stem));
  return Writer(sheet, stem).write(standalone);
}

}  // namespace lekalo::render
