// A finished drawing as plain data: what is on the paper, in millimetres from its upper left corner, y downwards; later
// things lie over earlier ones. Made by figure.h, written by svg.h and cairo_output.h.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "render/drawing/paths/paths.h"
#include "render/image/png.h"
#include "render/lines/strokes.h"

namespace lekalo::render {

// A rectangle on the sheet, millimetres.
struct SheetBox {
  Vec2 lo{geometry::kInfinity}, hi{-geometry::kInfinity};
  void include(const Vec2& p) { lo = glm::min(lo, p), hi = glm::max(hi, p); }
  Vec2 size() const { return hi - lo; }
};

struct Brush {
  Spectrum color;
  double opacity = 1;
};

// Colours along a line of the paper, or by the distance from a point of it.
struct Gradient {
  bool radial = false;
  Vec2 from{0}, to{0};  // radial: the centre, and a point at the distance of the last colour
  struct Stop {
    double offset;  // 0 at `from`, 1 at `to`; growing
    Spectrum color;
  };
  std::vector<Stop> stops;
};

// Filled by the even-odd rule, then drawn.
struct SheetPath {
  std::vector<Path> parts;
  std::optional<LineLook> pen;  // widths in millimetres
  std::optional<Brush> brush;
  std::optional<Gradient> gradient;  // instead of the brush
};

// Which file of the font families that drawings use (fonts.h).
struct Font {
  std::string family;
  bool italic = false, bold = false;
  auto operator<=>(const Font&) const = default;
};

// Characters of one font on a line.
struct TextRun {
  Vec2 at{0};  // of the baseline's beginning, from the text's own
  std::string text;
  Font font;
  double size = 1;  // millimetres of an em
};

// A text as it was laid out: runs, and what is drawn: bars of fractions, roots, arrows over vectors.
struct SheetText {
  Vec2 at{0};        // of the baseline's beginning
  double angle = 0;  // radians, counterclockwise on the paper
  std::vector<TextRun> runs;
  std::vector<Path> strokes;  // from `at`, turned with it
  double stroke_width = 0.1;
  Brush brush;
  // For LaTeX's own setting: the text as written, and its box about `at`.
  std::string tex;
  double width = 0, ascent = 0, descent = 0, size = 0;
  // Which point of its width stays where it is if the text comes out wider or narrower: 0 left, 0.5 middle, 1 right.
  double alignment = 0;
};

struct SheetPicture {
  Vec2 at{0};  // upper left corner
  double width = 0, height = 0;
  std::shared_ptr<const DisplayImage> picture;
};

struct SheetGroup;
using SheetItem = std::variant<SheetPath, SheetText, SheetPicture, SheetGroup>;

struct SheetGroup {
  // Classes of a style sheet: boundary, silhouette hidden, label, ...; object: of all that an object has, panel: of
  // one.
  std::string kind;
  std::string object;  // whose it is, or the panel's name; empty: of the drawing
  std::optional<Vec2> clip_at;
  Vec2 clip_size{0};  // of a group that is cut at a rectangle
  std::vector<SheetItem> items;
  bool clip_is_round = false;  // cut at the circle in a square instead
};

struct Sheet {
  double width = 0, height = 0;
  Vec2 corner{0};  // upper left one of the part that is shown; width and height are its
  Spectrum paper;
  std::string title;
  std::vector<SheetItem> items;
};

// The last guard of what is written: throws std::invalid_argument where a coordinate is infinite or none.
void demand_finite(const Sheet& sheet);

}  // namespace lekalo::render
