#include "render/drawing/annotations/annotations.h"

#include <algorithm>
#include <array>
#include <memory>
#include <span>

#include "geometry/box_corners.h"
#include "render/drawing/annotations/annotation_work.h"
#include "render/drawing/annotations/balloon.h"
#include "render/drawing/annotations/center_lines.h"
#include "render/drawing/annotations/color_bar.h"
#include "render/drawing/annotations/cutting_plane.h"
#include "render/drawing/annotations/detail_circle.h"
#include "render/drawing/annotations/dimensions.h"
#include "render/drawing/annotations/light_path.h"
#include "render/drawing/annotations/page_shapes.h"
#include "render/model/placed_annotations.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// Millimetres.
constexpr double kTextOff = 0.7;   // between a brace and the text at its tip
constexpr double kEndOn = 0.5;     // arrows shorter than this have no room for a name
constexpr double kTitle = 1.2;     // size of titles, of labels
constexpr double kLastPart = 0.4;  // of a light path, of the scene's radius

// What is drawn on the page from the pictures of its points has none where these are behind the eye; lines in space are
// cut before it.
bool is_behind_eye(const AnnotationWork& work) {
  const Fields& f = work.fields();
  const std::string& type = work.kind();
  const auto hides = [&](const char* field) {
    return f.holds<Anchor>(field) && !f.get<Anchor>(field).on_page && !work.is_seen(f.get<Anchor>(field).point);
  };
  if (type == "angle") return hides("at");
  if (type == "angle_dimension") return hides("at") || hides("from") || hides("to");
  if (type == "color_bar") return hides("at");
  if (type == "leader" || type == "balloon") return hides("at") || hides("to");
  if (type == "brace" || type == "linear_dimension") return hides("from") || hides("to");
  if (type == "arrow" && f.has("to") && (f.get<Anchor>("from").on_page || f.get<Anchor>("to").on_page))
    return hides("from") || hides("to");
  return false;
}

void add_label(AnnotationWork& work) {
  const Fields& f = work.fields();
  const Anchor& at = f.get<Anchor>("at");
  const double distance = f.has("distance") ? f.number("distance") : at.on_page ? 0.0 : 1.2;
  if (!at.on_page)
    return work.text(at.point, work.words("text"), work.side(), distance, work.hidden(), f.boolean("leader"));
  Label label = work.page_label(work.words("text"), work.place(at));
  label.on_page = true;
  label.side = f.has("side") ? f.text("side") : "center";
  label.distance = distance;
  work.add(std::move(label));
}

void add_point(AnnotationWork& work) {
  const Fields& f = work.fields();
  const Style& style = work.style();
  const Anchor& at = f.get<Anchor>("at");
  Mark mark;
  mark.point = at.point;
  mark.sign = *mark_sign(f.text("marker"));
  mark.radius = 0.5 * style.marker_size;
  mark.line = work.look();
  if (style.fill) mark.fill = rgb(*style.fill);
  mark.object = -1;
  const double distance = 0.6 + mark.radius;
  if (!at.on_page) {
    work.mark(mark, work.hidden());
    if (f.has("label")) work.text(at.point, work.words("label"), work.side(), distance, work.hidden());
    return;
  }
  work.shape(drawn_mark(mark, work.place(at), style.opacity, work.view()));
  if (!f.has("label")) return;
  Label label = work.page_label(work.words("label"), work.place(at));
  label.on_page = true;
  label.side = work.side(), label.distance = distance;
  work.add(std::move(label));
}

void add_arrow(AnnotationWork& work) {
  const Fields& f = work.fields();
  const Anchor& from = f.get<Anchor>("from");
  const std::string words = work.words("label");
  const auto [start, end] = work.heads();
  Anchor to;
  if (f.has("to"))
    to = f.get<Anchor>("to");
  else
    to.point = from.point + f.number("length") * f.vec3("along");
  if (from.on_page || to.on_page) {
    const Vec2 a = work.place(from), b = work.place(to);
    work.page_line(a, b, start, end);
    if (words.empty()) return;
    Label label = work.page_label(words, b);
    label.on_page = to.on_page;
    label.side = work.side();
    return work.add(std::move(label));
  }
  if (to.point == from.point) return;
  const View& view = work.view();
  if (work.is_seen(from.point) && work.is_seen(to.point) &&
      glm::length(view.place(to.point) - view.place(from.point)) < kSeenEndOn)
    return work.leave_out_end_on();
  work.segment(from.point, to.point, work.hidden(), start, end);
  if (!words.empty()) work.text(to.point, words, work.side(), 0.8, work.hidden());
}

void add_triad(AnnotationWork& work, const Vec3& origin, const std::array<Vec3, 3>& axes) {
  const Fields& f = work.fields();
  const auto [start, end] = work.heads();
  const auto& labels = f.get<std::vector<TextTemplate>>("labels");
  for (size_t k = 0; k < 3; ++k) {
    const Vec3 tip = origin + f.number("length") * axes[k];
    work.segment(origin, tip, work.hidden(), start, end);
    const bool end_on = !(glm::length(work.view().place(tip) - work.view().place(origin)) > kEndOn);
    if (k < labels.size() && !end_on) work.text(tip, labels[k].text(), "", 0.6, work.hidden());
  }
}

void add_axes(AnnotationWork& work) {
  const Fields& f = work.fields();
  const View& view = work.view();
  const Anchor& at = f.get<Anchor>("at");
  constexpr std::array<Vec3, 3> kAxes{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  if (!at.on_page) return add_triad(work, at.point, kAxes);
  // As they would be seen in the middle of the picture.
  const auto [start, end] = work.heads();
  const Ray middle = view.camera.ray(0.5 * view.camera.width(), 0.5 * view.camera.height());
  const double depth = view.camera.is_parallel() ? 0 : glm::length(bounds(view.model).center() - middle.origin);
  const Vec3 origin = middle.origin + depth * middle.direction;
  const Vec2 corner = work.place(at);
  const auto& labels = f.get<std::vector<TextTemplate>>("labels");
  for (size_t k = 0; k < 3; ++k) {
    const Vec2 tip = corner + view.place(origin + f.number("length") * kAxes[k]) - view.place(origin);
    if (glm::length(tip - corner) < kEndOn) continue;
    work.page_line(corner, tip, start, end);
    if (k < labels.size()) work.add(work.page_label(labels[k].text(), tip));
  }
}

void add_light_path(AnnotationWork& work, const World& world) {
  const Fields& f = work.fields();
  LightPath path;
  path.from = f.vec3("from");
  const Vec3 way = f.has("to") ? f.vec3("to") - path.from : f.vec3("along");
  if (!(glm::length(way) > 0)) return;
  path.direction = glm::normalize(way);
  path.wavelength = f.number("wavelength");
  path.bounces = f.integer("bounces");
  path.reflection = f.text("follow") == "reflection";
  path.length = f.has("length") ? f.number("length") : kLastPart * world.radius();
  const std::vector<Vec3> corners = light_path(world, path);
  HiddenLines ways;
  ways.way = HiddenLines::Way::show;  // inside of glass, behind its surface
  const auto [start, end] = work.heads();
  for (size_t k = 0; k + 1 < corners.size(); ++k)
    if (corners[k] != corners[k + 1])
      work.segment(corners[k], corners[k + 1], ways, start && k == 0, end && k + 2 == corners.size());
}

void add_leader(AnnotationWork& work) {
  const Fields& f = work.fields();
  const Vec2 at = work.place(f.get<Anchor>("at")), to = work.place(f.get<Anchor>("to"));
  const std::string& head = f.text("head");
  work.page_line(to, at, false, head == "arrow");
  if (head == "dot") {
    Mark dot;
    dot.radius = 0.5 * work.style().marker_size;
    dot.line = work.look();
    work.shape(drawn_mark(dot, at, work.style().opacity, work.view()));
  }
  Label label = work.page_label(work.words("text"), to);
  label.on_page = f.get<Anchor>("to").on_page;
  const std::string across = to.x >= at.x ? "right" : "left", up = to.y >= at.y ? "below" : "above";
  if (f.has("side"))
    label.side = f.text("side");
  else if (label.on_page)
    label.side = across;
  else  // on from the line, or turned away from what is in the way
    for (const std::string& side : {across, up + " " + across, up, (up == "above" ? "below " : "above ") + across})
      label.spots.push_back({to, side, label.distance, {}});
  work.add(std::move(label));
}

void add_brace(AnnotationWork& work) {
  const Fields& f = work.fields();
  const Vec2 from = work.place(f.get<Anchor>("from")), to = work.place(f.get<Anchor>("to"));
  if (glm::length(to - from) < kSeenEndOn) return work.leave_out_end_on();
  const double offset = f.number("offset"), depth = (offset < 0 ? -1 : 1) * f.number("depth");
  const Brace brace = brace_along(from, to, offset, depth);
  work.shape({drawn(brace.path, work.look())});
  if (!f.has("label")) return;
  Label label = work.page_label(work.words("label"), brace.tip);
  label.side = side_towards(brace.out);
  label.distance = kTextOff;
  work.add(std::move(label));
}

// What one annotation adds, so that it can be taken back.
class Added {
 public:
  Added(LineWork& lines, PageWork& page)
      : lines_(lines), page_(page), sizes_{lines.strokes.size(), lines.marks.size(), lines.texts.size(),
                                           page.shapes.size(),   page.labels.size(), page.reach.size(),
                                           page.anchors.size()} {}

  std::span<const Vec3> anchors() const { return std::span(page_.anchors).subspan(sizes_[6]); }
  void take_back() {
    const auto cut = [](auto& all, size_t size) {
      all.erase(all.begin() + static_cast<std::ptrdiff_t>(size), all.end());
    };
    cut(lines_.strokes, sizes_[0]), cut(lines_.marks, sizes_[1]), cut(lines_.texts, sizes_[2]);
    cut(page_.shapes, sizes_[3]), cut(page_.labels, sizes_[4]), cut(page_.reach, sizes_[5]);
    cut(page_.anchors, sizes_[6]);
  }

 private:
  LineWork& lines_;
  PageWork& page_;
  std::array<size_t, 7> sizes_;
};

double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double square = glm::dot(along, along);
  const double t = square > 0 ? std::clamp(glm::dot(p - a, along) / square, 0.0, 1.0) : 0;
  return glm::length(a + t * along - p);
}

// Whether it speaks of places, and these and the way from one to the next lie outside of a detail's circle. Paths of
// light may lead through it.
bool is_outside(const View& view, const std::string& type, std::span<const Vec3> anchors, const Detail& detail) {
  constexpr double kRounding = 1e-6;  // of the radius
  if (anchors.empty() || type == "light_path") return false;
  const PageCircle circle = circle_of(view, detail);
  for (size_t k = 0; k < anchors.size(); ++k) {
    const Vec2 from = view.place(anchors[k == 0 ? 0 : k - 1]), to = view.place(anchors[k]);
    if (distance_to_segment(circle.center, from, to) <= (1 + kRounding) * circle.radius) return false;
  }
  return true;
}

}  // namespace

void add_annotations(const View& view, LineWork& lines, PageWork& page) {
  add_center_lines(view, lines, page);
  const DetailPtr detail = detail_of(view.model.drawing);
  if (detail) page.anchors.clear(), page.reach.clear();  // they are cut with all lines
  std::unique_ptr<const World> world;                    // one for all light paths
  for (const Annotation& written : view.model.drawing.annotations) {
    const Annotation annotation = placed(written, view.model.objects, lines.left_out);
    AnnotationWork work(view, annotation, lines, page);
    Added added(lines, page);
    const std::string& type = annotation.type;
    if (is_behind_eye(work)) {
      work.leave_out_behind();
    } else if (lack_of_size(type, annotation.values)) {
      work.leave_out("of no size");
    } else if (type == "label") {
      add_label(work);
    } else if (type == "point") {
      add_point(work);
    } else if (type == "arrow") {
      add_arrow(work);
    } else if (type == "frame") {
      const Frame& frame = annotation.values.frame();
      add_triad(work, frame.origin, {frame.x, frame.y, frame.z});
    } else if (type == "axes") {
      add_axes(work);
    } else if (type == "angle") {
      add_angle(work);
    } else if (type == "angle_dimension") {
      add_angle_dimension(work);
    } else if (type == "leader") {
      add_leader(work);
    } else if (type == "balloon") {
      add_balloon(work);
    } else if (type == "brace") {
      add_brace(work);
    } else if (type == "cutting_plane") {
      add_cutting_plane(work);
    } else if (type == "detail_circle") {
      add_detail_circle(work);
    } else if (type == kDetailBorder) {
      add_detail_border(work);
    } else if (type == "color_bar") {
      add_color_bar(work);
    } else if (type == "linear_dimension") {
      add_linear_dimension(work);
    } else if (type == "radius_dimension" || type == "diameter_dimension") {
      add_round_dimension(work, type == "diameter_dimension");
    } else if (type == "light_path") {  // knots are a graph's axis'
      if (!world) world = std::make_unique<const World>(std::make_shared<const Model>(view.model), false);
      add_light_path(work, *world);
    }
    work.finish();
    if (detail && is_outside(view, type, added.anchors(), *detail)) {
      added.take_back();
      work.leave_out("outside of the detail");
    }
  }
}

SheetText title_text(const Model& model) {
  Style style = model.styles.at("label");
  style.text_size *= kTitle;
  SheetText text = text_in(style, model.drawing.title);
  // As high as brackets, so that titles side by side have one baseline.
  const SheetText strut = text_in(style, "(");
  text.ascent = std::max(text.ascent, strut.ascent), text.descent = std::max(text.descent, strut.descent);
  return text;
}

void add_title(const View& view, SheetBox under, PageWork& page) {
  if (view.model.drawing.title.empty() || view.camera.is_graph()) return;
  const auto is_empty = [&] { return !(under.lo.x <= under.hi.x); };
  const bool shows_objects = !is_empty();
  for (const Vec3& anchor : page.anchors)
    if (view.camera.project(anchor).visible_side) {
      const Vec2 place = view.place(anchor);
      if (shows_objects)
        under.lo.y = std::min(under.lo.y, place.y);
      else
        under.include(place);
    }
  if (is_empty()) under = {view.at, view.at + Vec2(view.width(), view.height())};
  for (const Label& label : page.labels) under.lo.y = std::min(under.lo.y, label.at.y - label.text.ascent);
  for (const Vec2& place : page.reach) under.lo.y = std::min(under.lo.y, place.y);
  Label label;
  label.text = title_text(view.model);
  label.kind = "title";
  if (const auto& fill = view.model.styles.at("label").fill) label.box = Brush{rgb(*fill), 1};
  label.at = {0.5 * (under.lo.x + under.hi.x), under.lo.y};
  // A camera that has a place of its own leaves no room: then the title is over the picture, not over another panel.
  const double height = kTitleOff + label.text.ascent + label.text.descent;
  if (view.room.lo.y <= view.room.hi.y) label.at.y = std::max(label.at.y, view.room.lo.y + height);
  label.side = "above";
  label.distance = kTitleOff;
  page.labels.push_back(std::move(label));
}

}  // namespace lekalo::render
