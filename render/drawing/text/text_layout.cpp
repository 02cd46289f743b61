#include "render/drawing/text/text_layout.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "render/drawing/text/fonts.h"
#include "render/model/tex.h"

namespace lekalo::render {

namespace {

using Kind = TexNode::Kind;
using Role = TexNode::Role;

// In em of the size at the place.
constexpr double kAxis = 0.25;        // height of minus signs and bars of fractions
constexpr double kThickness = 0.045;  // of these bars
constexpr double kSuperscript = 0.40, kSubscript = 0.18, kSubscriptUnder = 0.25;
constexpr double kMinScript = 0.5;  // of the text's size

// What has been laid out, about its own baseline's beginning; y downwards, millimetres.
struct Box {
  double width = 0, ascent = 0, descent = 0;
  std::vector<TextRun> runs;
  std::vector<Path> strokes;
  double overhang = 0;  // of the ink beyond the width: slanted letters under superscripts

  void put(const Box& other, double x, double y) {
    for (TextRun run : other.runs) run.at += Vec2(x, y), runs.push_back(std::move(run));
    for (const Path& path : other.strokes) strokes.push_back(moved(path, {x, y}));
    ascent = std::max(ascent, other.ascent - y);
    descent = std::max(descent, other.descent + y);
  }
};

Path line(std::initializer_list<Vec2> points) {
  Path path;
  path.from = *points.begin();
  for (const Vec2* p = points.begin() + 1; p != points.end(); ++p) path.steps.push_back(line_to(*p));
  return path;
}

class Setter {
 public:
  Setter(std::string_view family, double size) : family_(family), size_(size) {}

  Box box(const TexNode& node, double scale) const {
    switch (node.kind) {
      case Kind::row:
        return row(node, scale);
      case Kind::symbol:
        return symbol(node, scale);
      case Kind::space: {
        Box box;
        box.width = node.amount * em(scale);
        return box;
      }
      case Kind::fraction:
        return fraction(node, scale);
      case Kind::root:
        return root(node, scale);
      case Kind::scripts:
        return scripts(node, scale);
      case Kind::accent:
        return accent(node, scale);
      case Kind::fenced:
        return fenced(node, scale);
    }
    return {};
  }

  double stroke_width() const { return kThickness * size_; }

 private:
  double em(double scale) const { return scale * size_; }
  static double smaller(double scale) { return std::max(kMinScript, 0.7 * scale); }

  Box characters(const std::string& text, const Font& font, double scale) const {
    Box box;
    for (const FontRun& run : font_runs(font, text)) {
      const TextExtent extent = text_extent(run.font, run.text);
      box.runs.push_back({{box.width, 0}, run.text, run.font, em(scale)});
      box.width += extent.advance * em(scale);
      box.ascent = std::max(box.ascent, extent.above * em(scale));
      box.descent = std::max(box.descent, -extent.below * em(scale));
      box.overhang = std::max(0.0, (extent.right - extent.advance) * em(scale));
    }
    return box;
  }

  Font font_of(const TexNode& node) const {
    const std::string_view family = node.family == TexNode::Family::sans   ? "sans"
                                    : node.family == TexNode::Family::mono ? "mono"
                                                                           : family_;
    return {font_family(family), node.italic, node.bold};
  }

  Box symbol(const TexNode& node, double scale) const {
    if (node.role != Role::big) return characters(node.text, font_of(node), scale);
    // Large, and about the height of the bars.
    const double large = 1.35 * scale;
    Box sign = characters(node.text, font_of(node), large);
    Box box;
    box.put(sign, 0, 0.5 * (sign.ascent - sign.descent) - kAxis * em(scale));
    box.width = sign.width;
    return box;
  }

  // How far apart neighbours stand, in em.
  static double gap(Role left, Role right, bool small) {
    const auto is = [&](Role one, Role a, Role b) { return one == a || one == b; };
    if (left == Role::relation || right == Role::relation)
      return left == right || small || right == Role::punctuation || right == Role::closing || left == Role::opening
                 ? 0
                 : 5.0 / 18;
    if (left == Role::binary || right == Role::binary) return small ? 0 : 2.0 / 9;
    if (left == Role::punctuation) return small ? 0 : 1.0 / 6;
    if (is(left, Role::function, Role::big)) return right == Role::opening || right == Role::closing ? 0 : 1.0 / 6;
    if (is(right, Role::function, Role::big)) return left == Role::opening ? 0 : 1.0 / 6;
    return 0;
  }

  Box row(const TexNode& node, double scale) const {
    Box box;
    std::vector<Role> roles;
    for (const TexNode& part : node.parts) roles.push_back(part.role);
    // A sign with nothing before it belongs to what follows: -x.
    for (size_t k = 0; k < roles.size(); ++k)
      if (roles[k] == Role::binary) {
        const Role before = k > 0 ? roles[k - 1] : Role::opening;
        if (k + 1 == roles.size() || before == Role::binary || before == Role::relation || before == Role::opening ||
            before == Role::punctuation || before == Role::function || before == Role::big)
          roles[k] = Role::ordinary;
      }
    for (size_t k = 0; k < node.parts.size(); ++k) {
      const TexNode& part = node.parts[k];
      if (k > 0 && part.in_formula && node.parts[k - 1].in_formula)
        box.width += gap(roles[k - 1], roles[k], scale < 0.99) * em(scale);
      const Box one = this->box(part, scale);
      box.put(one, box.width, 0);
      box.width += one.width;
      box.overhang = one.overhang;
    }
    return box;
  }

  // The primes at the beginning of what stands above, which loses them.
  Box primes(TexNode& above, double scale) const {
    // What stands in braces is a row in a row.
    if (above.parts.size() == 1 && above.parts[0].kind == Kind::row) above = TexNode(above.parts[0]);
    std::string signs;
    const auto first = above.parts.begin();
    auto last = first;
    for (; last != above.parts.end() && last->text == kPrime; ++last) signs += kPrime;
    above.parts.erase(first, last);
    return characters(signs, {font_family(family_), false, false}, scale);
  }

  Box scripts(const TexNode& node, double scale) const {
    const Box base = box(node.parts[0], scale);
    TexNode raised = node.parts[2];
    const Box prime = primes(raised, scale);
    const bool has_below = !node.parts[1].parts.empty(), has_above = !raised.parts.empty();
    Box result;
    result.put(base, 0, 0);
    result.width = base.width;
    const double small = smaller(scale);
    double width = base.width;
    double up = std::max(kSuperscript * em(scale), base.ascent - 0.45 * em(scale));
    double down = std::max((has_above || prime.width > 0 ? kSubscriptUnder : kSubscript) * em(scale),
                           base.descent - 0.02 * em(scale));
    const Box below = has_below ? box(node.parts[1], small) : Box(), above = has_above ? box(raised, small) : Box();
    if (has_below && has_above) {
      // They keep apart.
      const double free = (up - above.descent) + (down - below.ascent);
      const double wanted = 4 * kThickness * em(scale);
      if (free < wanted) down += wanted - free;
    }
    if (has_below) {
      result.put(below, base.width, down);
      width = std::max(width, base.width + below.width);
    }
    if (prime.width > 0) {
      result.put(prime, base.width + base.overhang, 0);
      width = std::max(width, base.width + base.overhang + prime.width);
    }
    if (has_above) {
      const double behind = base.width + base.overhang + prime.width;
      result.put(above, behind, -up);
      width = std::max(width, behind + above.width);
    }
    result.width = width + 0.03 * em(scale);
    return result;
  }

  Box fraction(const TexNode& node, double scale) const {
    const double part_scale = node.text == "large" ? scale : smaller(scale);
    const Box above = box(node.parts[0], part_scale), below = box(node.parts[1], part_scale);
    const double side = 0.1 * em(scale), clear = (node.text == "large" ? 0.16 : 0.1) * em(scale);
    const double width = std::max(above.width, below.width) + 2 * side;
    const double axis = -kAxis * em(scale);
    Box result;
    result.put(above, 0.5 * (width - above.width), axis - clear - above.descent);
    result.put(below, 0.5 * (width - below.width), axis + clear + below.ascent);
    if (node.amount > 0) result.strokes.push_back(line({{0.5 * side, axis}, {width - 0.5 * side, axis}}));
    result.width = width;
    return result;
  }

  Box root(const TexNode& node, double scale) const {
    const Box inner = box(node.parts[0], scale);
    const double unit = em(scale), top = -(std::max(inner.ascent, 0.45 * unit) + 0.14 * unit),
                 bottom = std::max(inner.descent, 0.05 * unit), left = 0.62 * unit;
    Box result;
    result.put(inner, left + 0.06 * unit, 0);
    result.width = left + inner.width + 0.14 * unit;
    const double height = bottom - top;
    result.strokes.push_back(line({{0.06 * unit, bottom - 0.42 * height},
                                   {0.16 * unit, bottom - 0.5 * height},
                                   {0.36 * unit, bottom},
                                   {left, top},
                                   {result.width - 0.04 * unit, top}}));
    result.ascent = std::max(result.ascent, -top + 0.05 * unit);
    result.descent = std::max(result.descent, bottom);
    return result;
  }

  Box accent(const TexNode& node, double scale) const {
    const Box base = box(node.parts[0], scale);
    const double unit = em(scale);
    Box result;
    result.put(base, 0, 0);
    result.width = base.width, result.overhang = base.overhang;
    // Over slanted letters accents stand to the right of the middle.
    const bool slanted = !base.runs.empty() && base.runs.front().font.italic;
    const double middle = 0.5 * base.width + (slanted ? 0.2 * std::max(0.0, base.ascent - 0.2 * unit) : 0);
    const double y = -(base.ascent + 0.09 * unit);
    const auto stroke = [&](std::initializer_list<Vec2> points) { result.strokes.push_back(line(points)); };
    double height = 0.1 * unit;
    const std::string& kind = node.text;
    if (kind == "overline" || kind == "bar") {
      const double half = kind == "bar" ? 0.2 * unit : 0.5 * base.width;
      const double at = kind == "bar" ? middle : 0.5 * base.width;
      stroke({{at - half, y}, {at + half, y}});
    } else if (kind == "underline") {
      const double under = base.descent + 0.1 * unit;
      stroke({{0, under}, {base.width, under}});
      result.descent = under + 0.05 * unit;
      return result;
    } else if (kind == "hat") {
      const double half = std::max(0.15 * unit, 0.35 * base.width);
      stroke({{middle - half, y}, {middle, y - 0.13 * unit}, {middle + half, y}});
      height = 0.17 * unit;
    } else if (kind == "check") {
      const double half = 0.15 * unit;
      stroke({{middle - half, y - 0.13 * unit}, {middle, y}, {middle + half, y - 0.13 * unit}});
      height = 0.17 * unit;
    } else if (kind == "acute" || kind == "grave") {
      const double lean = (kind == "acute" ? 0.08 : -0.08) * unit;
      stroke({{middle - lean, y}, {middle + lean, y - 0.15 * unit}});
      height = 0.19 * unit;
    } else if (kind == "breve") {
      Path bow;
      const double half = 0.18 * unit, top = y - 0.13 * unit;
      bow.from = {middle - half, top};
      bow.steps.push_back(curve_to({middle - 0.6 * half, y + 0.03 * unit}, {middle + 0.6 * half, y + 0.03 * unit},
                                   {middle + half, top}));
      result.strokes.push_back(bow);
      height = 0.17 * unit;
    } else if (kind == "vec") {
      const double half = std::max(0.24 * unit, 0.5 * base.width), at = y - 0.05 * unit;
      stroke({{middle - half, at}, {middle + half, at}});
      stroke({{middle + half - 0.11 * unit, at - 0.08 * unit},
              {middle + half, at},
              {middle + half - 0.11 * unit, at + 0.08 * unit}});
      height = 0.2 * unit;
    } else if (kind == "tilde" || kind == "widetilde") {
      Path wave;
      const double half = std::max(0.22 * unit, kind == "tilde" ? 0 : 0.4 * base.width), rise = 0.1 * unit,
                   at = y - 0.05 * unit;
      wave.from = {middle - half, at + 0.3 * rise};
      wave.steps.push_back(curve_to({middle - 0.3 * half, at - 1.6 * rise}, {middle + 0.3 * half, at + 1.6 * rise},
                                    {middle + half, at - 0.3 * rise}));
      result.strokes.push_back(wave);
      height = 0.15 * unit;
    } else {
      const std::string sign = kind == "ddot" ? "¨" : kind == "mathring" ? "˚" : "˙";
      Box dots = characters(sign, {font_family(family_), false, false}, scale);
      // Its own place is over a small letter.
      const double lift = std::max(0.0, base.ascent - 0.44 * unit);
      result.put(dots, middle - 0.5 * dots.width, -lift);
      return result;
    }
    result.ascent = base.ascent + 0.09 * unit + height;
    return result;
  }

  Box fenced(const TexNode& node, double scale) const {
    const Box inner = box(node.parts[0], scale);
    const double axis = kAxis * em(scale);
    const double half = std::max(inner.ascent - axis, inner.descent + axis);
    Box result;
    const auto add = [&](const std::string& text, Role role) {
      if (text.empty()) return;
      TexNode sign;
      sign.kind = Kind::symbol;
      sign.text = text, sign.role = role;
      Box one = symbol(sign, scale);
      // A bracket of the usual size reaches 0.5 em from the axis.
      const double grow = std::max(1.0, half / (0.5 * em(scale)));
      if (grow > 1) one = symbol(sign, scale * grow);
      const double middle = 0.5 * (one.ascent - one.descent);
      result.put(one, result.width, grow > 1 ? middle - axis : 0);
      result.width += one.width;
    };
    add(node.text, Role::opening);
    result.put(inner, result.width, 0);
    result.width += inner.width;
    add(node.closing, Role::closing);
    return result;
  }

  std::string_view family_;
  double size_;
};

}  // namespace

SheetText laid_out(std::string_view tex, std::string_view family, double size) {
  const auto parsed = parse_tex(tex);
  if (const auto* slip = std::get_if<TextSlip>(&parsed)) throw std::runtime_error(slip->message);
  const Setter setter(family, size);
  Box box = setter.box(std::get<TexNode>(parsed), 1);
  SheetText text;
  text.runs = std::move(box.runs);
  text.strokes = std::move(box.strokes);
  text.stroke_width = setter.stroke_width();
  text.width = box.width, text.ascent = box.ascent, text.descent = box.descent;
  text.tex = tex, text.size = size;
  return text;
}

SheetBox box_of(const SheetText& text, double from, double to) {
  const Vec2 along(std::cos(text.angle), -std::sin(text.angle)), up(-std::sin(text.angle), -std::cos(text.angle));
  SheetBox box;
  for (const double x : {text.width * from, text.width * to})
    for (const double y : {text.ascent, -text.descent}) box.include(text.at + x * along + y * up);
  return box;
}

}  // namespace lekalo::render
