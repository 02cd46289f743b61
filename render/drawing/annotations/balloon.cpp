#include "render/drawing/annotations/balloon.h"

#include <algorithm>

#include "render/drawing/annotations/page_shapes.h"

namespace lekalo::render {

namespace {

constexpr double kAroundText = 0.8;  // millimetres between the corners of the text and the circle

}  // namespace

void add_balloon(AnnotationWork& work) {
  const geometry::Fields& f = work.fields();
  const Vec2 at = work.place(f.get<geometry::Anchor>("at")), to = work.place(f.get<geometry::Anchor>("to"));
  Label number = work.page_label(work.words("text"), to);
  const double half = 0.5 * glm::length(Vec2(number.text.width, number.text.ascent + number.text.descent));
  // Circles of one size, so far as the texts allow.
  const double radius = std::max(f.number("radius"), half + kAroundText);
  const double r = radius;
  work.shape({drawn({to + Vec2(r, 0), arcs_to({to, {r, 0}, {0, r}}, 0, geometry::kTwoPi), true}, work.look())});
  const double apart = glm::length(at - to);
  if (apart > radius) work.page_line(to + radius / apart * (at - to), at, false, f.text("head") == "arrow");
  if (f.text("head") == "dot") {
    Mark dot;
    dot.radius = 0.5 * work.style().marker_size;
    dot.line = work.look();
    work.shape(drawn_mark(dot, at, work.style().opacity, work.view()));
  }
  number.on_page = true;
  number.side = "center";
  number.distance = 0;
  work.add(std::move(number));
}

}  // namespace lekalo::render
