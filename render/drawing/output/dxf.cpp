// DXF Reference, AutoCAD 2000 (AC1015): groups of a code and a value, a line each.
#include "render/drawing/output/dxf.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "render/drawing/output/element_names.h"
#include "render/image/display.h"
#include "render/scene/values/characters.h"

namespace lekalo::render {

namespace {

constexpr double kSame = 1e-5;          // millimetres: half axes that differ by less are a circle's
constexpr double kArcTolerance = 1e-4;  // of the curves that border hatches
constexpr double kCapital = 0.7;        // the height of capital letters, of an em

std::string number(double x) {
  std::string text = fmt::format("{:.6f}", x);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text += '0';
  return text == "-0.0" ? "0.0" : text;
}

// Letters beyond ASCII as \U+XXXX.
std::string dxf_string(std::string_view text) {
  std::string result;
  for (size_t at = 0; at < text.size();) {
    const CodePoint letter = decode_utf8(text, at);
    at += letter.length;
    const auto code = static_cast<uint32_t>(letter.code);
    if (code >= 0x20 && code < 0x7f)
      result += static_cast<char>(code);
    else
      result += fmt::format("\\U+{:04X}", code);
  }
  return result;
}

// The format's colours 1 to 255: nine plain ones, 24 hues of five values in two saturations, six greys.
std::array<int, 3> color_of_index(int index) {
  constexpr std::array<std::array<int, 3>, 10> kPlain{{{0, 0, 0},
                                                       {255, 0, 0},
                                                       {255, 255, 0},
                                                       {0, 255, 0},
                                                       {0, 255, 255},
                                                       {0, 0, 255},
                                                       {255, 0, 255},
                                                       {0, 0, 0},
                                                       {128, 128, 128},
                                                       {192, 192, 192}}};
  constexpr std::array kGreys{51, 80, 105, 130, 190, 255};
  constexpr std::array kValues{255, 165, 127, 76, 38};
  if (index < 10) return kPlain[static_cast<size_t>(index)];
  if (index >= 250) {
    const int grey = kGreys[static_cast<size_t>(index - 250)];
    return {grey, grey, grey};
  }
  const double hue = (index / 10 - 1) / 4.0, value = kValues[static_cast<size_t>(index % 10 / 2)];
  const double least = index % 2 ? 0.5 * value : 0;
  std::array<int, 3> result{};
  for (int k = 0; k < 3; ++k) {
    // How near the hue is to red, green, blue: two sixths away it has none of it.
    const double away = std::abs(std::remainder(hue - 2 * k, 6.0));
    result[static_cast<size_t>(k)] =
        static_cast<int>(std::lround(least + (value - least) * std::clamp(2 - away, 0.0, 1.0)));
  }
  return result;
}

// 7 is black on white paper, and white on a black screen.
int index_of(const Spectrum& color) {
  int best = 7;
  double nearest = geometry::kInfinity;
  for (int index = 1; index < 256; ++index) {
    const std::array<int, 3> other = color_of_index(index);
    double apart = 0;
    for (int k = 0; k < 3; ++k) {
      const double off = 255 * std::clamp(srgb_encode(color[k]), 0.0, 1.0) - other[static_cast<size_t>(k)];
      apart += off * off;
    }
    if (apart < nearest || (apart == nearest && index == 7)) nearest = apart, best = index;
  }
  return best;
}

// Hundredths of a millimetre: the next of the widths that the format has.
int lineweight_of(double width) {
  constexpr std::array kWidths{0,  5,  9,  13, 15, 18,  20,  25,  30,  35,  40,  50,
                               53, 60, 70, 80, 90, 100, 106, 120, 140, 158, 200, 211};
  const auto apart = [&](int w) { return std::abs(100 * width - w); };
  return *std::min_element(kWidths.begin(), kWidths.end(), [&](int a, int b) { return apart(a) < apart(b); });
}

// "silhouette hidden layers-2": silhouette-hidden.
std::string layer_of(const std::string& kind) {
  std::string result;
  for (size_t begin = 0; begin < kind.size();) {
    const size_t end = std::min(kind.find(' ', begin), kind.size());
    const std::string word = kind.substr(begin, end - begin);
    begin = end + 1;
    if (word.empty() || word.starts_with("layers-")) continue;
    result += fmt::format("{}{}", result.empty() ? "" : "-", name_token(word));
  }
  return result.empty() ? "0" : result;
}

struct Look {
  int color = 7, weight = 25;
  std::vector<double> dash;
  bool operator==(const Look&) const = default;
};

// Of the region in which a group is seen: positive inside.
struct Clip {
  Vec2 lo{0}, size{0};
  bool is_round = false;
  double inside(const Vec2& p) const {
    const Vec2 off = glm::abs(p - lo - 0.5 * size);
    if (is_round) return 0.5 * size.x - glm::length(off);
    return std::min(0.5 * size.x - off.x, 0.5 * size.y - off.y);
  }
};

class Writer {
 public:
  explicit Writer(const Sheet& sheet) : sheet_(sheet) {}

  DxfDrawing write() {
    items(sheet_.items, "");
    const std::string entities = std::move(text_);
    text_.clear();
    group(999, "Drawing by Lekalo");
    begin_section("HEADER");
    variable("$ACADVER", 1, "AC1015");
    variable("$INSUNITS", 70, "4");
    variable("$MEASUREMENT", 70, "1");
    variable("$LTSCALE", 40, "1.0");
    point(9, "$EXTMIN", Vec2(0));
    point(9, "$EXTMAX", {sheet_.width, sheet_.height});
    // Behind all handles.
    variable("$HANDSEED", 5, "FFFFFF");
    end_section();
    begin_section("CLASSES");
    end_section();
    write_tables();
    begin_section("BLOCKS");
    write_block("*Model_Space", kModelSpace);
    write_block("*Paper_Space", kPaperSpace);
    end_section();
    begin_section("ENTITIES");
    text_ += entities;
    end_section();
    begin_section("OBJECTS");
    const std::string root = begin_object("DICTIONARY", "0"), groups = fmt::format("{:X}", handle_ + 1);
    group(100, "AcDbDictionary"), group(3, "ACAD_GROUP"), group(350, groups);
    begin_object("DICTIONARY", root);
    group(100, "AcDbDictionary");
    end_section();
    group(0, "EOF");
    return {std::move(text_), std::move(notes_)};
  }

 private:
  static constexpr const char *kModelSpace = "10", *kPaperSpace = "11";

  // ---- groups

  void group(int code, std::string_view value) { text_ += fmt::format("{:3}\n{}\n", code, value); }
  void group(int code, int value) { group(code, fmt::format("{}", value)); }
  void group(int code, double value) { group(code, number(value)); }
  void variable(const char* name, int code, const char* value) { group(9, name), group(code, value); }
  void point(int code, const char* name, const Vec2& p) { group(code, name), coordinates(10, p); }
  void coordinates(int code, const Vec2& p, bool in_space = true) {
    group(code, p.x), group(code + 10, p.y);
    if (in_space) group(code + 20, 0.0);
  }
  void begin_section(const char* name) { group(0, "SECTION"), group(2, name); }
  void end_section() { group(0, "ENDSEC"); }
  std::string new_handle() { return fmt::format("{:X}", ++handle_); }
  std::string begin_object(const char* kind, const std::string& owner) {
    const std::string handle = new_handle();
    group(0, kind), group(5, handle), group(330, owner);
    return handle;
  }

  // ---- tables

  void begin_record(const char* kind, const char* of, const std::string& name) {
    begin_object(kind, "0");
    group(100, "AcDbSymbolTableRecord"), group(100, of), group(2, name), group(70, 0);
  }
  void begin_table(const char* name, size_t count) {
    group(0, "TABLE"), group(2, name), group(5, new_handle()), group(330, "0"), group(100, "AcDbSymbolTable");
    group(70, static_cast<int>(count));
  }
  void end_table() { group(0, "ENDTAB"); }

  void line_type(const std::string& name, const std::vector<double>& dash) {
    begin_record("LTYPE", "AcDbLinetypeTableRecord", name);
    double length = 0;
    for (const double part : dash) length += part;
    group(3, ""), group(72, 65), group(73, static_cast<int>(dash.size())), group(40, length);
    for (size_t i = 0; i < dash.size(); ++i) group(49, i % 2 ? -dash[i] : dash[i]), group(74, 0);
  }

  void write_tables() {
    begin_section("TABLES");
    begin_table("VPORT", 0);
    end_table();
    begin_table("LTYPE", 3 + dashes_.size());
    for (const char* name : {"ByBlock", "ByLayer", "Continuous"}) line_type(name, {});
    for (size_t i = 0; i < dashes_.size(); ++i) line_type(fmt::format("DASH-{}", i + 1), dashes_[i]);
    end_table();
    layers_.try_emplace("0");
    begin_table("LAYER", layers_.size());
    for (const auto& [name, look] : layers_) {
      begin_record("LAYER", "AcDbLayerTableRecord", name);
      group(62, look.color), group(6, line_type_of(look.dash)), group(370, look.weight), group(390, "0");
    }
    end_table();
    begin_table("STYLE", styles_.size() + 1);
    write_style("Standard", {});
    for (const Font& font : styles_) write_style(style_of(font), font);
    end_table();
    for (const char* name : {"VIEW", "UCS"}) begin_table(name, 0), end_table();
    begin_table("APPID", 1);
    begin_record("APPID", "AcDbRegAppTableRecord", "ACAD");
    end_table();
    begin_table("DIMSTYLE", 0);
    group(100, "AcDbDimStyleTable");
    end_table();
    begin_table("BLOCK_RECORD", 2);
    for (const auto& [name, handle] :
         {std::pair("*Model_Space", kModelSpace), std::pair("*Paper_Space", kPaperSpace)}) {
      group(0, "BLOCK_RECORD"), group(5, handle), group(330, "0");
      group(100, "AcDbSymbolTableRecord"), group(100, "AcDbBlockTableRecord"), group(2, name), group(340, "0");
    }
    end_table();
    end_section();
  }

  static std::string style_of(const Font& font) {
    return fmt::format("{}{}{}", name_token(font.family), font.italic ? "-italic" : "", font.bold ? "-bold" : "");
  }
  void write_style(const std::string& name, const Font& font) {
    begin_record("STYLE", "AcDbTextStyleTableRecord", name);
    group(40, 0.0), group(41, 1.0), group(50, 0.0), group(71, 0), group(42, 2.5), group(3, "txt"), group(4, "");
    if (font.family.empty()) return;
    // A TrueType font is named in extended data: italic and bold are flags.
    group(1001, "ACAD"), group(1000, dxf_string(font.family));
    group(1071, (font.italic ? 0x1000000 : 0) + (font.bold ? 0x2000000 : 0));
  }

  void write_block(const char* name, const char* record) {
    begin_object("BLOCK", record);
    group(100, "AcDbEntity"), group(8, "0"), group(100, "AcDbBlockBegin"), group(2, name), group(70, 0);
    coordinates(10, Vec2(0));
    group(3, name), group(1, "");
    begin_object("ENDBLK", record);
    group(100, "AcDbEntity"), group(8, "0"), group(100, "AcDbBlockEnd");
  }

  // ---- what is drawn

  std::string line_type_of(const std::vector<double>& dash) const {
    const auto found = std::find(dashes_.begin(), dashes_.end(), dash);
    return dash.empty() ? "Continuous" : fmt::format("DASH-{}", found - dashes_.begin() + 1);
  }

  void note(const char* sentence) {
    if (std::find(notes_.begin(), notes_.end(), sentence) == notes_.end()) notes_.emplace_back(sentence);
  }

  // The layer's look is that of the first entity on it; others say their own.
  void begin_entity(const char* kind, const Look& look) {
    const Look& usual = layers_.try_emplace(layer_, look).first->second;
    begin_object(kind, kModelSpace);
    group(100, "AcDbEntity"), group(8, layer_);
    if (look.dash != usual.dash) group(6, line_type_of(look.dash));
    if (look.color != usual.color) group(62, look.color);
    if (look.weight != usual.weight) group(370, look.weight);
  }

  Look look_of(const LineLook& pen) {
    Look look{index_of(pen.color), lineweight_of(2 * pen.half_width), pen.dash};
    if (look.dash.size() % 2) look.dash.insert(look.dash.end(), pen.dash.begin(), pen.dash.end());
    if (!look.dash.empty() && std::find(dashes_.begin(), dashes_.end(), look.dash) == dashes_.end())
      dashes_.push_back(look.dash);
    return look;
  }

  void items(const std::vector<SheetItem>& list, const std::string& layer) {
    for (const SheetItem& item : list) {
      layer_ = layer;
      std::visit([&](const auto& one) { write(one); }, item);
    }
  }

  // Groups of no object hold those of objects: the innermost kind counts.
  void write(const SheetGroup& group) {
    const auto outer = clips_.size();
    if (group.clip_at) clips_.push_back({*group.clip_at, group.clip_size, group.clip_is_round});
    items(group.items, layer_of(group.kind));
    clips_.resize(outer);
  }

  void write(const SheetPicture&) { note("pictures are left out of DXF files"); }

  void write(const SheetPath& path) {
    if (path.gradient) note("areas filled with gradients are left out of DXF files");
    if (path.brush) hatch(path.parts, *path.brush);
    if (!path.pen) return;
    const Look look = look_of(*path.pen);
    for (const Path& part : path.parts)
      for (const Path& seen : clipped(part)) draw(seen, look);
  }

  void write(const SheetText& text) {
    const Look look{index_of(text.brush.color), lineweight_of(text.stroke_width), {}};
    const Vec2 x(std::cos(text.angle), -std::sin(text.angle)), y(std::sin(text.angle), std::cos(text.angle));
    const auto place = [&](const Vec2& p) { return text.at + p.x * x + p.y * y; };
    for (const Clip& clip : clips_)
      if (clip.inside(text.at) < 0) return;
    for (const TextRun& run : text.runs) {
      styles_.insert(run.font);
      begin_entity("TEXT", look);
      group(100, "AcDbText");
      coordinates(10, on_page(place(run.at)));
      group(40, kCapital * run.size), group(1, dxf_string(run.text));
      group(50, text.angle * 180 / geometry::kPi), group(7, style_of(run.font)), group(100, "AcDbText");
    }
    for (const Path& stroke : text.strokes) {
      Path turned = stroke;
      turned.from = place(stroke.from);
      for (PathStep& step : turned.steps) {
        step.to = place(step.to), step.first = place(step.first), step.second = place(step.second);
        PictureEllipse& e = step.ellipse;
        e = {place(e.center), e.x.x * x + e.x.y * y, e.y.x * x + e.y.y * y};
      }
      draw(turned, look);
    }
  }

  Vec2 on_page(const Vec2& p) const { return {p.x - sheet_.corner.x, sheet_.corner.y + sheet_.height - p.y}; }

  // The parts of a path in all clips.
  std::vector<Path> clipped(const Path& path) const {
    std::vector<Path> result{path};
    for (const Clip& clip : clips_) {
      std::vector<Path> left;
      for (const Path& one : result)
        for (Path& part : parts_in(clip, one)) left.push_back(std::move(part));
      result = std::move(left);
    }
    return result;
  }

  static std::vector<Path> parts_in(const Clip& clip, const Path& path) {
    constexpr int kPlaces = 32, kHalvings = 40;
    std::vector<Path> result;
    bool is_whole = true, goes_on = false;
    Vec2 begin = path.from;
    for (const PathStep& step : path.steps) {
      const auto inside = [&](double s) { return clip.inside(point_on(begin, step, s)) >= -kSame; };
      std::vector<double> cuts{0};
      for (int k = 0; k < kPlaces; ++k) {
        double lo = k / static_cast<double>(kPlaces), hi = (k + 1) / static_cast<double>(kPlaces);
        const bool at_lo = inside(lo);
        if (at_lo == inside(hi)) continue;
        for (int i = 0; i < kHalvings; ++i) (inside(0.5 * (lo + hi)) == at_lo ? lo : hi) = 0.5 * (lo + hi);
        cuts.push_back(hi);
      }
      cuts.push_back(1);
      for (size_t i = 0; i + 1 < cuts.size(); ++i) {
        const bool seen = inside(0.5 * (cuts[i] + cuts[i + 1]));
        is_whole = is_whole && seen;
        if (seen && !goes_on) result.push_back({point_on(begin, step, cuts[i]), {}, false});
        goes_on = seen;
        if (seen) result.back().steps.push_back(part_of(begin, step, cuts[i], cuts[i + 1]));
      }
      begin = step.to;
    }
    if (is_whole && !result.empty()) result.front().closed = path.closed;
    return result;
  }

  // ---- lines

  // Runs of steps of one kind, of arcs those of one ellipse, are one entity.
  void draw(Path path, const Look& look) {
    if (path.closed && path.end() != path.from) path.steps.push_back(line_to(path.from));
    Vec2 begin = path.from;
    for (size_t i = 0; i < path.steps.size();) {
      size_t end = i + 1;
      const PathStep& first = path.steps[i];
      while (end < path.steps.size() && goes_on(first, path.steps[end - 1], path.steps[end])) ++end;
      const std::vector<PathStep> run(path.steps.begin() + static_cast<std::ptrdiff_t>(i),
                                      path.steps.begin() + static_cast<std::ptrdiff_t>(end));
      const bool shows = !is_point({begin, run, false}, kSame);
      if (shows && first.kind == PathStep::Kind::line)
        draw_lines(begin, run, look);
      else if (shows && first.kind == PathStep::Kind::arc)
        draw_arc(first.ellipse, first.begin, run.back().end, look);
      else if (shows)
        draw_spline(begin, run, look);
      begin = run.back().to;
      i = end;
    }
  }

  static bool goes_on(const PathStep& first, const PathStep& before, const PathStep& step) {
    if (first.kind != step.kind) return false;
    if (first.kind != PathStep::Kind::arc) return true;
    const PictureEllipse &a = first.ellipse, &b = step.ellipse;
    return a.center == b.center && a.x == b.x && a.y == b.y && std::abs(step.begin - before.end) < 1e-12 &&
           (step.end > step.begin) == (first.end > first.begin);
  }

  void draw_lines(const Vec2& begin, const std::vector<PathStep>& run, const Look& look) {
    if (run.size() == 1) {
      begin_entity("LINE", look);
      group(100, "AcDbLine");
      coordinates(10, on_page(begin)), coordinates(11, on_page(run[0].to));
      return;
    }
    const bool closed = run.back().to == begin;
    begin_entity("LWPOLYLINE", look);
    group(100, "AcDbPolyline");
    group(90, static_cast<int>(run.size() + (closed ? 0 : 1))), group(70, closed ? 1 : 0);
    coordinates(10, on_page(begin), false);
    for (size_t i = 0; i + (closed ? 1 : 0) < run.size(); ++i) coordinates(10, on_page(run[i].to), false);
  }

  void draw_arc(const PictureEllipse& ellipse, double from, double to, const Look& look) {
    // On a page whose y is upwards; along the longer half axis, counterclockwise.
    Vec2 x(ellipse.x.x, -ellipse.x.y), y(ellipse.y.x, -ellipse.y.y);
    if (glm::length(y) > glm::length(x)) {
      std::swap(x, y);
      from = 0.5 * geometry::kPi - from, to = 0.5 * geometry::kPi - to;
    }
    if (x.x * y.y - x.y * y.x < 0) from = -from, to = -to;
    if (from > to) std::swap(from, to);
    const Vec2 center = on_page(ellipse.center);
    const double a = glm::length(x), b = glm::length(y);
    const bool whole = to - from > geometry::kTwoPi - 1e-9;
    if (!(b > kSame)) {
      // Seen from the side.
      const auto at = [&](double angle) { return ellipse.center + std::cos(angle) * Vec2(x.x, -x.y); };
      std::vector<PathStep> run;
      for (double turn = std::ceil(from / geometry::kPi) * geometry::kPi; turn < to; turn += geometry::kPi)
        if (turn > from) run.push_back(line_to(at(turn)));
      run.push_back(line_to(at(to)));
      draw_lines(at(from), run, look);
      return;
    }
    if (std::abs(a - b) < kSame) {
      begin_entity(whole ? "CIRCLE" : "ARC", look);
      group(100, "AcDbCircle");
      coordinates(10, center), group(40, a);
      if (whole) return;
      const double turned = std::atan2(x.y, x.x);
      const auto degrees = [&](double angle) {
        const double all = std::fmod((angle + turned) * 180 / geometry::kPi, 360);
        return all < 0 ? all + 360 : all;
      };
      group(100, "AcDbArc"), group(50, degrees(from)), group(51, degrees(to));
      return;
    }
    begin_entity("ELLIPSE", look);
    group(100, "AcDbEllipse");
    coordinates(10, center), coordinates(11, x), group(40, fmt::format("{:.12f}", b / a));
    if (whole) from = 0, to = geometry::kTwoPi;
    group(41, fmt::format("{:.12f}", from)), group(42, fmt::format("{:.12f}", to));
  }

  // Cubic Bezier curves: knots of multiplicity 3 where they join.
  void draw_spline(const Vec2& begin, const std::vector<PathStep>& run, const Look& look) {
    begin_entity("SPLINE", look);
    group(100, "AcDbSpline");
    group(70, 8), group(71, 3);
    group(72, static_cast<int>(3 * run.size() + 5)), group(73, static_cast<int>(3 * run.size() + 1)), group(74, 0);
    spline_data(begin, run, true);
  }

  void spline_data(const Vec2& begin, const std::vector<PathStep>& run, bool in_space) {
    for (size_t i = 0; i <= run.size(); ++i)
      for (int k = 0; k < (i == 0 || i == run.size() ? 4 : 3); ++k) group(40, static_cast<double>(i));
    coordinates(10, on_page(begin), in_space);
    for (const PathStep& step : run)
      for (const Vec2& p : {step.first, step.second, step.to}) coordinates(10, on_page(p), in_space);
  }

  // ---- areas

  void hatch(const std::vector<Path>& parts, const Brush& brush) {
    std::vector<Path> loops;
    for (const Path& part : parts) {
      Path loop = without_arcs(part, kArcTolerance);
      if (loop.end() != loop.from) loop.steps.push_back(line_to(loop.from));
      for (const Clip& clip : clips_) loop = area_in(clip, loop);
      if (loop.steps.size() > 1) loops.push_back(std::move(loop));
    }
    if (loops.empty()) return;
    begin_entity("HATCH", {index_of(brush.color), 25, {}});
    group(100, "AcDbHatch");
    coordinates(10, Vec2(0));
    group(210, 0.0), group(220, 0.0), group(230, 1.0);
    group(2, "SOLID"), group(70, 1), group(71, 0), group(91, static_cast<int>(loops.size()));
    for (const Path& loop : loops) {
      group(92, 1), group(93, static_cast<int>(loop.steps.size()));
      Vec2 begin = loop.from;
      for (const PathStep& step : loop.steps) {
        if (step.kind == PathStep::Kind::line) {
          group(72, 1), coordinates(10, on_page(begin), false), coordinates(11, on_page(step.to), false);
        } else {
          group(72, 4), group(94, 3), group(73, 0), group(74, 0), group(95, 8), group(96, 4);
          spline_data(begin, {step}, false);
        }
        begin = step.to;
      }
      group(97, 0);
    }
    group(75, 0), group(76, 1), group(98, 0);
  }

  // Of a loop that leaves the clip, by straight lines (Sutherland and Hodgman 1974).
  static Path area_in(const Clip& clip, const Path& loop) {
    constexpr int kPlaces = 16, kSides = 128;
    std::vector<Vec2> polygon;
    Vec2 begin = loop.from;
    bool leaves = false;
    for (const PathStep& step : loop.steps) {
      const int places = step.kind == PathStep::Kind::line ? 1 : kPlaces;
      for (int k = 1; k <= places; ++k) {
        polygon.push_back(point_on(begin, step, static_cast<double>(k) / places));
        leaves = leaves || clip.inside(polygon.back()) < -kSame;
      }
      begin = step.to;
    }
    if (!leaves) return loop;
    const Vec2 center = clip.lo + 0.5 * clip.size;
    const int sides = clip.is_round ? kSides : 4;
    for (int side = 0; side < sides && !polygon.empty(); ++side) {
      const double angle = geometry::kTwoPi * side / sides;
      const Vec2 out(std::cos(angle), std::sin(angle));
      const double reach = 0.5 * (std::abs(out.x) > std::abs(out.y) || clip.is_round ? clip.size.x : clip.size.y);
      const auto beyond = [&](const Vec2& p) { return glm::dot(p - center, out) - reach; };
      std::vector<Vec2> left;
      for (size_t i = 0; i < polygon.size(); ++i) {
        const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double at_a = beyond(a), at_b = beyond(b);
        if (at_a <= 0) left.push_back(a);
        if ((at_a < 0 && at_b > 0) || (at_a > 0 && at_b < 0)) left.push_back(a + at_a / (at_a - at_b) * (b - a));
      }
      polygon = std::move(left);
    }
    Path result;
    if (polygon.empty()) return result;
    result.from = polygon.back();
    for (const Vec2& p : polygon) result.steps.push_back(line_to(p));
    return result;
  }

  const Sheet& sheet_;
  std::string text_;
  int handle_ = 0x20;
  std::string layer_;
  std::map<std::string, Look> layers_;
  std::vector<std::vector<double>> dashes_;
  std::set<Font> styles_;
  std::vector<Clip> clips_;
  std::vector<std::string> notes_;
};

}  // namespace

DxfDrawing dxf_of(const Sheet& sheet) {
  demand_finite(sheet);
  return Writer(sheet).write();
}

}  // namespace lekalo::render
