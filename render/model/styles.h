// Styles of drawings: one kind for lines, markers and text.
//
// A style is complete; what scene files write are changes. They apply in this order, later ones winning:
//
//   the plain style below, the built-in or named style, the object's own, an inline map
//
// Built-in: thick thin hairline hidden axis construction dimension label ray. A built-in name given under `styles`
// changes it everywhere, key by key. Widths are those of ISO 128-2 (0.13, 0.18, 0.25, 0.35, 0.5, 0.7 mm).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/describe.h"

namespace lekalo::render {

// Lengths in millimetres on the page.
struct Style {
  std::string name;  // as the scene calls it; empty for an inline one
  double width = 0.25;
  geometry::Vec3 color{0};  // linear Rec.709
  bool cycles = false;      // the next colour of the palette for each member of a family, instead of `color`
  double opacity = 1;
  std::vector<double> dash;            // lengths drawn and left out in turn; empty: solid
  std::string cap = "butt";            // butt, round, square
  std::string join = "round";          // round, miter, bevel
  std::string marker = "dot";          // at points: none, dot, circle, ball, cross, plus, square, triangle, diamond
  double marker_size = 1.2;            // its diameter
  std::optional<geometry::Vec3> fill;  // of markers and text boxes; none: markers in the line's colour
  std::string font = "serif";          // serif, sans, mono
  double text_size = 10 * 25.4 / 72;   // 10 pt
  std::string arrows = "none";         // none, start, end, both
  double arrow_size = 2;
};

// What a scene says about a style: only the fields that were given.
struct StyleChanges {
  std::string name;  // by which it was referred to
  geometry::Fields fields;
};

// The plain style with these changes.
Style complete(const StyleChanges& changes);
// The style that a declared field of the kind reference({style}) holds.
Style style_of(const geometry::Fields& fields, std::string_view field);

// The built-in styles as the section of a scene file.
std::string_view built_in_styles();
bool is_built_in_style(std::string_view name);

}  // namespace lekalo::render
