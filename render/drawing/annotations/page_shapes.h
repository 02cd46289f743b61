// What annotations draw on the page: lines with heads, braces; the circles and numbers of dimensions.
#pragma once

#include <any>
#include <vector>

#include <string>
#include <vector>

#include "geometry/curves/analytic/circle.h"
#include "render/drawing/view.h"

namespace lekalo::render {

// A straight line between two different points, with arrow heads of this length, of a short line smaller ones.
std::vector<SheetItem> line_with_heads(const Vec2& from, const Vec2& to, bool start, bool end, double arrow_size,
                                       const LineLook& pen);

// A brace beside the way between two different points: on its left, as seen, `offset` millimetres from it, on its right
// if offset and depth are negative.
struct Brace {
  Path path;
  Vec2 tip{0}, out{0};  // out: the unit direction in which the tip points
};
Brace brace_along(Vec2 from, Vec2 to, double offset, double depth);

// The side, in words, on which a text stands that goes on in this direction.
std::string side_towards(const Vec2& way);

// The circle of the round curve, surface or body `of` of a dimension.
std::vector<geometry::Circle> circles_of(const std::vector<std::any>& things);

// The number of a dimension: at most so many decimals, zeros at its end left out.
std::string dimension_number(double value, int decimals);

// The same where nobody has said how many: two decimals, of smaller numbers two digits, of very small ones a power of
// ten, as TeX.
std::string dimension_number(double value);

}  // namespace lekalo::render
