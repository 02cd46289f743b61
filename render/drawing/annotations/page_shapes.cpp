#include "render/drawing/annotations/page_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/body.h"
#include "geometry/curves/operations/parameter_line.h"
#include "geometry/queries/differential/roundness.h"
#include "render/model/numbers.h"

namespace lekalo::render {

using namespace geometry;

std::vector<SheetItem> line_with_heads(const Vec2& from, const Vec2& to, bool start, bool end, double arrow_size,
                                       const LineLook& pen) {
  const double length = glm::length(to - from);
  const Vec2 way = (to - from) / length;
  const double size = std::min(arrow_size, 0.5 * length);
  // Paths first: of growing lists of items g++ 12 warns without reason.
  std::vector<SheetPath> paths(1, drawn(straight_path({from + (start ? shortened_by(size) : 0.0) * way,
                                                       to - (end ? shortened_by(size) : 0.0) * way}),
                                        pen));
  if (start) paths.push_back(arrow_head(from, -way, size, pen));
  if (end) paths.push_back(arrow_head(to, way, size, pen));
  return {paths.begin(), paths.end()};
}

// Two quarter turns, a straight part, the tip, and the same back.
Brace brace_along(Vec2 from, Vec2 to, double offset, double depth) {
  const double length = glm::length(to - from);
  const Vec2 way = (to - from) / length, out(way.y, -way.x);  // to the left of the way, as seen
  from += offset * out, to += offset * out;
  const Vec2 tip = 0.5 * (from + to) + depth * out;
  const double turn = std::min(0.5 * std::abs(depth), 0.25 * length);
  const auto place = [&](const Vec2& begin, double along, double high) { return begin + along * way + high * out; };
  const double half = 0.5 * depth, round = 0.55 * turn;
  Path path;
  path.from = from;
  path.steps = {curve_to(place(from, 0, 0.55 * half), place(from, turn - round, half), place(from, turn, half)),
                line_to(place(tip, -turn, -half)),
                curve_to(place(tip, -turn + round, -half), place(tip, 0, -0.55 * half), tip),
                curve_to(place(tip, 0, -0.55 * half), place(tip, turn - round, -half), place(tip, turn, -half)),
                line_to(place(to, -turn, half)),
                curve_to(place(to, -turn + round, half), place(to, 0, 0.55 * half), to)};
  return {std::move(path), tip, depth > 0 ? out : -out};
}

std::string side_towards(const Vec2& way) {
  constexpr const char* kSides[] = {"right", "below right", "below", "below left",
                                    "left",  "above left",  "above", "above right"};
  const double eighth = std::atan2(way.y, way.x) / (kPi / 4);
  return kSides[(static_cast<int>(std::lround(eighth)) + 8) % 8];
}

std::string dimension_number(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

std::string dimension_number(double value) {
  constexpr int kDecimals = 2, kDigits = 2, kMaxDecimals = 5;
  const double size = std::abs(value);
  const int power = size > 0 ? static_cast<int>(std::floor(std::log10(size) + 1e-9)) : 0;
  const int decimals = std::max(kDecimals, kDigits - 1 - power);
  if (decimals <= kMaxDecimals) return dimension_number(value, decimals);
  // One digit before the point and the others, then the power: 5.0e-05.
  const std::string text = fmt::format("{:.{}e}", value, kDigits - 1);
  const std::string digits = dimension_number(std::stod(text.substr(0, text.find('e'))), kDigits - 1);
  return fmt::format("${}$", times_power_of_ten(digits, std::stoi(text.substr(text.find('e') + 1))));
}

}  // namespace lekalo::render
