#include "render/drawing/output/latex.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "render/image/display.h"
#include "render/model/tex.h"
#include "render/scene/values/characters.h"

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

// Signs that the formulas of labels have no command for.
constexpr std::pair<std::string_view, std::string_view> kSigns[] = {
    {"−", "-"},         {"²", "^2"},         {"³", "^3"},     {"¹", "^1"},          {"√", "\\surd"},
    {"÷", "\\div"},     {"µ", "\\mu"},       {"¬", "\\lnot"}, {"⌀", "\\text{\\O}"}, {"ϕ", "\\phi"},
    {"ϵ", "\\epsilon"}, {"∥", "\\parallel"}, {"′", "{}'"}};

// Commands of labels that LaTeX does not have, or has with another meaning.
constexpr std::pair<std::string_view, std::string_view> kCommands[] = {{"bm", "\\boldsymbol"},
                                                                       {"degree", "{^\\circ}"},
                                                                       {"sgn", "\\operatorname{sgn}"},
                                                                       {"rot", "\\operatorname{rot}"},
                                                                       {"div", "\\operatorname{div}"},
                                                                       {"grad", "\\operatorname{grad}"},
                                                                       {"const", "\\operatorname{const}"}};

// What a formula writes for the character; empty: nothing.
std::string sign_of(std::string_view character) {
  for (const auto& [sign, command] : kSigns)
    if (sign == character) return std::string(command);
  return formula_command_of(character);
}

// The font encoding of LaTeX that has the letter or the quotation mark; empty: none of the usual ones.
std::string_view encoding_of(char32_t code) {
  if ((code >= 0x400 && code <= 0x45F) || code == 0x490 || code == 0x491 || code == 0x2116) return "T2A";
  if ((code > 0xA0 && code <= 0x17F) || (code >= 0x2013 && code <= 0x2026) || code == 0x2030 || code == 0x2039 ||
      code == 0x203A || code == 0x20AC || code == 0x2122)
    return "T1";
  return {};
}

// Characters of text that stand for others in LaTeX, or that only some fonts have.
std::string ascii_for_latex(char c, bool formula) {
  if (c == '%' || c == '#' || c == '&') return {'\\', c};
  if (c == '\n' || c == '\t') return " ";
  if (c == '"') return "\\string\"";  // German documents make it a command
  if (formula) return {c};
  switch (c) {
    case '_':
      return "\\_";
    case '^':
      return "\\textasciicircum{}";
    case '<':
      return "\\textless{}";
    case '>':
      return "\\textgreater{}";
    case '|':
      return "\\textbar{}";
    default:
      return {c};
  }
}

// A label as LaTeX sets it alike. The text is one that parse_tex() takes: braces and dollar signs are balanced.
class LatexText {
 public:
  explicit LatexText(std::string_view text) : text_(text) {}

  std::string run() {
    while (i_ < text_.size()) {
      const CodePoint c = decode_utf8(text_, i_);
      if (c.code >= 0x80) {
        other(c);
        continue;
      }
      ++i_;
      if (c.code == '\\')
        command();
      else if (c.code == '{' || c.code == '}' || c.code == '$')
        delimiter(static_cast<char>(c.code));
      else
        result_ += ascii_for_latex(static_cast<char>(c.code), formula_);
    }
    return std::move(result_);
  }

 private:
  void command() {
    size_t end = i_;
    while (end < text_.size() && std::isalpha(static_cast<unsigned char>(text_[end]))) ++end;
    if (end == i_) {
      result_ += '\\';
      result_ += text_[i_++];
      return;
    }
    const std::string_view name = text_.substr(i_, end - i_);
    i_ = end;
    text_follows_ = takes_text(name);
    const auto* const known =
        std::find_if(std::begin(kCommands), std::end(kCommands), [&](const auto& one) { return one.first == name; });
    result_ += known == std::end(kCommands) ? fmt::format("\\{}", name) : std::string(known->second);
  }

  void delimiter(char c) {
    if (c == '{') around_.push_back(formula_);
    if (c == '{' && text_follows_) formula_ = false;
    if (c == '}' && !around_.empty()) formula_ = around_.back(), around_.pop_back();
    if (c == '$') formula_ = !formula_;
    text_follows_ = false;
    result_ += c;
  }

  void other(const CodePoint& c) {
    const std::string_view character = text_.substr(i_, static_cast<size_t>(c.length));
    const std::string sign = c.code == 0xA0 ? "~" : sign_of(character);
    if (sign.empty()) return letters();
    i_ += character.size();
    const bool word =
        sign[0] == '\\' && std::all_of(sign.begin() + 1, sign.end(), [](unsigned char l) { return std::isalpha(l); });
    if (c.code == 0xA0 || (formula_ && sign.size() == 1))
      result_ += sign;
    else if (formula_)  // a word alone keeps its spacing as a relation or an operator
      result_ += word ? sign + " " : "{" + sign + "}";
    else
      result_ += fmt::format("\\ensuremath{{{}}}", sign);
  }

  // All that follow one another, so that pairs of them are kerned.
  void letters() {
    const size_t begin = i_;
    const auto encoding_here = [&] {
      const CodePoint c = decode_utf8(text_, i_);
      return c.code >= 0x80 && sign_of(text_.substr(i_, static_cast<size_t>(c.length))).empty() ? encoding_of(c.code)
                                                                                                : "";
    };
    const std::string_view encoding = encoding_here();
    if (encoding.empty())
      throw std::invalid_argument(fmt::format("the text '{}': LaTeX's fonts do not have {}; draw without --latex",
                                              text_, describe_character(decode_utf8(text_, i_).code)));
    while (i_ < text_.size() && encoding_here() == encoding) i_ += static_cast<size_t>(decode_utf8(text_, i_).length);
    const std::string set = fmt::format("\\lekaloletters{{{}}}{{{}}}", encoding, text_.substr(begin, i_ - begin));
    result_ += formula_ ? fmt::format("\\text{{{}}}", set) : set;
  }

  std::string_view text_;
  size_t i_ = 0;
  bool formula_ = false, text_follows_ = false;
  std::vector<bool> around_;  // of open braces: whether they stand in a formula
  std::string result_;
};

// Letters of another encoding than the document's; engines with Unicode fonts need none. What is not loaded is said.
constexpr std::string_view kLettersMacro =
    "\\def\\lekaloletters#1#2{{\\ifcsname T@TU\\endcsname\\else\\ifcsname T@#1\\endcsname"
    "\\fontencoding{#1}\\selectfont\\else\\PackageError{lekalo}"
    "{A drawing has letters of the font encoding #1: say \\string\\usepackage[#1,T1]{fontenc}}{In the preamble.}"
    "\\fi\\fi#2}}%\n";

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
    std::string box = fmt::format("\\makebox(0,0)[{}]{{\\smash{{{}}}}}", side, latex_text(text->tex));
    if (text->angle != 0) box = fmt::format("\\rotatebox{{{:.4f}}}{{{}}}", text->angle * 180 / geometry::kPi, box);
    result += fmt::format(
        "  \\put({:.6f},{:.6f}){{\\color[rgb]{{{:.4f},{:.4f},{:.4f}}}{}"
        "{}}}%\n",
        at.x / sheet.width, (sheet.height - at.y) / sheet.width, encoded(0), encoded(1), encoded(2),
        latex_font_size(*text), box);
  }
}

}  // namespace

std::string latex_text(std::string_view label) { return LatexText(label).run(); }

std::string letters_macro(std::string_view texts) {
  return texts.find("\\lekaloletters") == std::string_view::npos ? std::string() : std::string(kLettersMacro);
}

std::string letters_packages(std::string_view texts) {
  return texts.find("\\lekaloletters{T2A}") == std::string_view::npos ? "" : "\\usepackage[T2A,T1]{fontenc}";
}

std::string latex_font_size(const SheetText& text) {
  // The points of scenes are those of PostScript; LaTeX has its fonts at whole ones of its own, by a 270th smaller.
  const double points = std::round(text.size / 25.4 * 72 * 100) / 100;
  return fmt::format("\\fontsize{{{:.3f}}}{{{:.3f}}}\\selectfont ", points, 1.2 * points);
}

std::string file_for_latex(const std::string& name) {
  std::string result;
  for (const char c : name) {
    if (std::string_view("~^&").find(c) != std::string_view::npos) result += "\\string";
    result += c;
  }
  return result;
}

Sheet without_texts(const Sheet& sheet) {
  Sheet result = sheet;
  result.items = kept(sheet.items);
  return result;
}

bool latex_takes_file(std::string_view name) {
  return std::none_of(name.begin(), name.end(), [](unsigned char c) {
    return c < 0x20 || c == 0x7F || std::string_view("#%$\\{}\"").find(static_cast<char>(c)) != std::string_view::npos;
  });
}

std::string latex_overlay(const Sheet& sheet, const std::string& drawing) {
  demand_finite(sheet);
  if (!latex_takes_file(drawing)) throw std::invalid_argument(fmt::format("LaTeX takes no file called '{}'", drawing));
  std::string texts;
  add_texts(sheet.items, sheet, texts);
  const std::string packages = letters_packages(texts);
  std::string text = fmt::format(
      "{0}{1}, set by LaTeX. In the document: \\usepackage{{graphicx,color,amsmath,amssymb}}{2}, then \\input this "
      "file.\n"
      "% \\def\\lekalowidth{{120mm}} before it makes the drawing, not its texts, larger or smaller.\n"
      "\\begingroup%\n",
      kOverlayMagic, drawing, packages.empty() ? "" : " and " + packages);
  text += letters_macro(texts);
  text += fmt::format(
      "\\ifx\\lekalowidth\\undefined\\setlength{{\\unitlength}}{{{0:.4f}mm}}%\n"
      "\\else\\setlength{{\\unitlength}}{{\\lekalowidth}}\\fi%\n"
      "\\begin{{picture}}(1,{1:.6f})%\n"
      "  \\put(0,0){{\\includegraphics[width=\\unitlength]{{{2}}}}}%\n",
      sheet.width, sheet.height / sheet.width, file_for_latex(drawing));
  return text + texts + "\\end{picture}%\n\\endgroup%\n";
}

}  // namespace lekalo::render
