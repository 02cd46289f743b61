#include "render/drawing/output/latex.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/image/display.h"

namespace lekalo::render {

namespace {

std::vector<SheetItem> kept(const std::vector<SheetItem>& items) {
  std::vector<SheetItem> result;
  for (const SheetItem& item : items) {
    if (std::holds_alternative<SheetText>(item)) continue;
    if (const auto* group = std::get_if<SheetGroup>(&item)) {
      SheetGroup copy = *group;
      copy.items = kept(group->items);
      if (!copy.items.empty()) result.push_back(std::move(copy));
    } else {
      result.push_back(item);
    }
  }
  return result;
}

// What TeX does not take as it stands.
std::string for_latex(const std::string& text) {
  std::string result;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\' && i + 1 < text.size()) {
      result += text[i];
      result += text[++i];
    } else if (text[i] == '%' || text[i] == '#' || text[i] == '&') {
      result += '\\';
      result += text[i];
    } else if (text.compare(i, 3, "⌀") == 0) {
      result += "{\\O}";
      i += 2;
    } else if (text.compare(i, 3, "−") == 0) {
      result += "\\ensuremath{-}";
      i += 2;
    } else if (text.compare(i, 2, "×") == 0) {
      result += "\\ensuremath{\\times}";
      i += 1;
    } else if (text.compare(i, 2, "°") == 0) {
      result += "\\ensuremath{^\\circ}";
      i += 1;
    } else {
      result += text[i];
    }
  }
  return result;
}

void add_texts(const std::vector<SheetItem>& items, const Sheet& sheet, std::string& result) {
  for (const SheetItem& item : items) {
    if (const auto* group = std::get_if<SheetGroup>(&item)) add_texts(group->items, sheet, result);
    const auto* text = std::get_if<SheetText>(&item);
    if (!text) continue;
    const Vec2 along(std::cos(text->angle), -std::sin(text->angle));
    const Vec2 at = text->at + text->alignment * text->width * along - sheet.corner;
    if (!(at.x >= 0 && at.y >= 0 && at.x <= sheet.width && at.y <= sheet.height)) continue;
    // What is not opaque is as on white paper: LaTeX's colours know nothing else.
    const auto encoded = [&](int k) {
      return std::clamp(1 + text->brush.opacity * (srgb_encode(text->brush.color[k]) - 1), 0.0, 1.0);
    };
    const char* side = text->alignment < 0.25 ? "lb" : text->alignment > 0.75 ? "rb" : "b";
    std::string box = fmt::format("\\makebox(0,0)[{}]{{\\smash{{{}}}}}", side, for_latex(text->tex));
    if (text->angle != 0) box = fmt::format("\\rotatebox{{{:.4f}}}{{{}}}", text->angle * 180 / geometry::kPi, box);
    // The points of scenes are those of PostScript; LaTeX has its fonts at whole ones of its own, by a 270th smaller.
    const double points = std::round(text->size / 25.4 * 72 * 100) / 100;
    result += fmt::format(
        "  \\put({:.6f},{:.6f}){{\\color[rgb]{{{:.4f},{:.4f},{:.4f}}}\\fontsize{{{:.3f}}}{{{:.3f}}}\\selectfont "
        "{}}}%\n",
        at.x / sheet.width, (sheet.height - at.y) / sheet.width, encoded(0), encoded(1), encoded(2), points,
        1.2 * points, box);
  }
}

}  // namespace

Sheet without_texts(const Sheet& sheet) {
  Sheet result = sheet;
  result.items = kept(sheet.items);
  return result;
}

std::string latex_overlay(const Sheet& sheet, const std::string& drawing) {
  std::string text = fmt::format(
      "% Texts of {0}, set by LaTeX. In the document: \\usepackage{{graphicx,color}}, then \\input this file.\n"
      "% \\def\\lekalowidth{{120mm}} before it makes the drawing, not its texts, larger or smaller.\n"
      "\\begingroup%\n"
      "\\ifx\\lekalowidth\\undefined\\setlength{{\\unitlength}}{{{1:.4f}mm}}%\n"
      "\\else\\setlength{{\\unitlength}}{{\\lekalowidth}}\\fi%\n"
      "\\begin{{picture}}(1,{2:.6f})%\n"
      "  \\put(0,0){{\\includegraphics[width=\\unitlength]{{{0}}}}}%\n",
      drawing, sheet.width, sheet.height / sheet.width);
  add_texts(sheet.items, sheet, text);
  return text + "\\end{picture}%\n\\endgroup%\n";
}

}  // namespace lekalo::render
