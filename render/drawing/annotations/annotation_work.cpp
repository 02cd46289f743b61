#include "render/drawing/annotations/annotation_work.h"

#include <fmt/format.h>

#include <memory>

#include "geometry/curves/analytic/segment.h"
#include "render/drawing/annotations/page_shapes.h"

namespace lekalo::render {

using namespace geometry;

namespace {

double opacity_of(const HiddenLines& hidden) {
  return hidden.way == HiddenLines::Way::drop ? 0 : hidden.way == HiddenLines::Way::faded ? 1.0 / 3 : 1;
}

}  // namespace

AnnotationWork::AnnotationWork(const View& view, const Annotation& annotation, LineWork& work, PageWork& page)
    : view_(view), annotation_(annotation), work_(work), page_(page), look_(drawn_look(annotation.style)) {}

void AnnotationWork::leave_out(const std::string& why) {
  std::string name = kind();
  for (const char* field : {"text", "label"})
    if (fields().holds<TextTemplate>(field)) name += fmt::format(" '{}'", words(field));
  work_.left_out.push_back(fmt::format("{} {} ({})", name, why, where(annotation_.place)));
}

void AnnotationWork::finish() {
  if (behind_) leave_out(drawn_ ? "as far as it is at points behind the eye" : "at points behind the eye");
}

Vec2 AnnotationWork::place(const Anchor& anchor) {
  if (!anchor.on_page) page_.anchors.push_back(anchor.point);
  return view_.place(anchor);
}

double AnnotationWork::in_scene(double millimetres, const Vec3& point) const {
  return millimetres / view_.millimetres * view_.camera.pixel_size(point);
}

std::pair<bool, bool> AnnotationWork::heads() const {
  const std::string& arrows = style().arrows;
  return {arrows == "start" || arrows == "both", arrows == "end" || arrows == "both"};
}

std::string AnnotationWork::words(const char* field) const {
  return fields().has(field) ? fields().get<TextTemplate>(field).text() : std::string();
}

void AnnotationWork::stroke(CurvePtr curve, const HiddenLines& hidden, bool start, bool end) {
  drawn_ = true;
  Stroke stroke;
  stroke.curve = std::move(curve);
  stroke.kind = kind();
  stroke.look = look_;
  stroke.hidden = drawn_hidden_look(view_.model, look_, hidden);
  stroke.object = -1;
  stroke.arrow_at_start = start, stroke.arrow_at_end = end;
  stroke.arrow_size = style().arrow_size;
  work_.strokes.push_back(std::move(stroke));
}

void AnnotationWork::segment(const Vec3& from, const Vec3& to, const HiddenLines& hidden, bool start, bool end) {
  page_.anchors.push_back(from), page_.anchors.push_back(to);
  if (!is_seen(from) && !is_seen(to)) return leave_out_behind();
  stroke(std::make_shared<Segment>(from, to), hidden, start, end);
}

void AnnotationWork::text(const Vec3& point, std::string words, const std::string& side, double distance,
                          const HiddenLines& hidden, bool leader) {
  page_.anchors.push_back(point);
  if (!is_seen(point)) return leave_out_behind();
  drawn_ = true;
  PointText text;
  text.point = point;
  text.text = std::move(words);
  text.style = style();
  text.kind = kind();
  text.side = side;
  text.distance = distance;
  text.leader = leader;
  text.hidden_opacity = opacity_of(hidden);
  text.object = -1;
  work_.texts.push_back(std::move(text));
}

void AnnotationWork::mark(Mark mark, const HiddenLines& hidden) {
  if (hidden.way != HiddenLines::Way::drop) mark.hidden_opacity = style().opacity * opacity_of(hidden);
  page_.anchors.push_back(mark.point);
  if (!is_seen(mark.point)) return leave_out_behind();
  drawn_ = true;
  work_.marks.push_back(std::move(mark));
}

Label AnnotationWork::page_label(const std::string& words, const Vec2& at) const {
  Label label;
  label.text = text_in(style(), words);
  label.at = at;
  label.kind = kind();
  if (style().fill) label.box = Brush{rgb(*style().fill), 1};
  return label;
}

void AnnotationWork::add(Label label) {
  drawn_ = true;
  page_.labels.push_back(std::move(label));
}

void AnnotationWork::shape(std::vector<SheetItem> items) {
  drawn_ = true;
  page_.shapes.emplace_back(SheetGroup{kind(), "", {}, {}, std::move(items)});
}

void AnnotationWork::page_line(const Vec2& from, const Vec2& to, bool start, bool end) {
  if (from != to) shape(line_with_heads(from, to, start, end, style().arrow_size, look_));
}

}  // namespace lekalo::render
