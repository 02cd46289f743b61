#include "render/drawing/sheet.h"

#include <cmath>
#include <stdexcept>

namespace lekalo::render {

namespace {

bool is_finite(const Vec2& p) { return std::isfinite(p.x) && std::isfinite(p.y); }

bool is_finite(const Path& path) {
  if (!is_finite(path.from)) return false;
  for (const PathStep& step : path.steps)
    if (!is_finite(step.to) || !is_finite(step.first) || !is_finite(step.second) || !is_finite(step.ellipse.center) ||
        !is_finite(step.ellipse.x) || !is_finite(step.ellipse.y))
      return false;
  return true;
}

bool is_finite(const std::vector<Path>& paths) {
  for (const Path& path : paths)
    if (!is_finite(path)) return false;
  return true;
}

bool has_place(const SheetItem& item) {
  if (const auto* path = std::get_if<SheetPath>(&item)) return is_finite(path->parts);
  if (const auto* text = std::get_if<SheetText>(&item))
    return is_finite(text->at) && std::isfinite(text->angle) && is_finite(text->strokes);
  if (const auto* picture = std::get_if<SheetPicture>(&item)) return is_finite(picture->at);
  return true;
}

void demand_finite(const std::vector<SheetItem>& items, const std::string& of) {
  for (const SheetItem& item : items) {
    if (!has_place(item))
      throw std::invalid_argument("the drawing" + (of.empty() ? "" : " of '" + of + "'") +
                                  " has a place that is infinite or has no value");
    if (const auto* group = std::get_if<SheetGroup>(&item))
      demand_finite(group->items, group->object.empty() ? of : group->object);
  }
}

}  // namespace

void demand_finite(const Sheet& sheet) { demand_finite(sheet.items, ""); }

}  // namespace lekalo::render
