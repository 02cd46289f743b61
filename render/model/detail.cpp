#include "render/model/detail.h"

#include <fmt/format.h>

#include <utility>

namespace lekalo::render {

using namespace geometry;

std::vector<Field> detail_fields() {
  return {{"around", point(), "the middle of the circle that it shows", true, {}},
          {"radius", length().positive(), "of the circle, in scene units", true, {}},
          {"scale", number().positive().or_word({"fit"}),
           "5 draws a length of 1 mm with 5 mm; fit: as large as there is room", false, "fit"},
          {"title", label(), "its letter: the view is called B (5:1)", false, {}}};
}

Detail detail_of(const Fields& fields) {
  Detail detail;
  detail.around = fields.vec3("around");
  detail.radius = fields.number("radius");
  if (fields.word("scale").empty()) detail.scale = fields.number("scale");
  if (fields.has("title")) detail.title = fields.get<TextTemplate>("title").text();
  return detail;
}

namespace {

// Four digits, more only before the point.
std::string few_digits(double x) { return x < 1000 ? fmt::format("{:.4g}", x) : fmt::format("{:.0f}", x); }

}  // namespace

std::string view_title(const Detail& detail) {
  if (!(detail.scale > 0)) return detail.title;
  const std::string ratio = detail.scale >= 1 ? few_digits(detail.scale) + ":1" : "1:" + few_digits(1 / detail.scale);
  return detail.title.empty() ? ratio : fmt::format("{} ({})", detail.title, ratio);
}

Annotation border_of(DetailPtr detail, Style style) {
  Annotation border;
  border.type = kDetailBorder;
  border.style = std::move(style);
  border.values.set("detail", std::move(detail));
  return border;
}

DetailPtr detail_of(const DrawingChoices& drawing) {
  for (const Annotation& one : drawing.annotations)
    if (one.type == kDetailBorder) return one.values.get<DetailPtr>("detail");
  return nullptr;
}

}  // namespace lekalo::render
