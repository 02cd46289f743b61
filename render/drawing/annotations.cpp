#include "render/drawing/annotations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "geometry/curves/circle.h"
#include "geometry/curves/segment.h"
#include "render/drawing/light_path.h"
#include "render/drawing/page_shapes.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// Millimetres, as ISO 129-1 draws dimensions of a small figure.
constexpr double kGap = 0.8;          // between a point and the line that leads away from it
constexpr double kBeyond = 1.5;       // by which these lines pass the dimension line
constexpr double kTextOff = 0.7;      // between a line and the text upon it
constexpr double kShelf = 6;          // from a circle to the number of its radius
constexpr double kLastPart = 0.4;     // of a light path, of the scene's radius
constexpr double kLeastForHeads = 3;  // in arrow lengths: shorter dimension lines have their arrows outside
constexpr double kStraight = 1e-9;    // radians: sides of an angle that are one line

class Annotator {
 public:
  Annotator(const View& view, LineWork& work, PageWork& page) : view_(view), work_(work), page_(page) {}

  void add(const Annotation& annotation) {
    kind_ = annotation.type;
    style_ = &annotation.style;
    look_ = drawn_look(annotation.style);
    const Fields& f = annotation.values;
    const std::string& type = annotation.type;
    if (is_behind_eye(type, f)) return leave_out();
    if (lack_of_size(type, f)) {
      work_.left_out.push_back(kind_ + " of no size");
      return;
    }
    if (type == "label")
      add_label(f);
    else if (type == "point")
      add_point(f);
    else if (type == "arrow")
      add_arrow(f);
    else if (type == "frame")
      add_triad(f.frame().origin, {f.frame().x, f.frame().y, f.frame().z}, f);
    else if (type == "axes")
      add_axes(f);
    else if (type == "angle")
      add_angle(f);
    else if (type == "angle_dimension")
      add_angle_dimension(f);
    else if (type == "leader")
      add_leader(f);
    else if (type == "brace")
      add_brace(f);
    else if (type == "linear_dimension")
      add_linear_dimension(f);
    else if (type == "radius_dimension" || type == "diameter_dimension")
      add_round_dimension(f, type == "diameter_dimension");
    else if (type == "light_path")
      add_light_path(f);  // knots are a graph's axis'
  }

 private:
  void leave_out() { work_.left_out.push_back(kind_ + " at points behind the eye"); }

  bool is_seen(const Vec3& point) const { return view_.camera.project(point).visible_side; }

  // What is drawn on the page from the pictures of its points has none there; lines in space are cut before the eye.
  bool is_behind_eye(const std::string& type, const Fields& f) const {
    const auto hides = [&](const char* field) {
      return f.holds<Anchor>(field) && !f.get<Anchor>(field).on_page && !is_seen(f.get<Anchor>(field).point);
    };
    if (type == "angle") return hides("at");
    if (type == "angle_dimension") return hides("at") || hides("from") || hides("to");
    if (type == "leader") return hides("at") || hides("to");
    if (type == "brace" || type == "linear_dimension") return hides("from") || hides("to");
    if (type == "arrow" && f.has("to") && (f.get<Anchor>("from").on_page || f.get<Anchor>("to").on_page))
      return hides("from") || hides("to");
    return false;
  }

  // A place on the page that an annotation speaks of.
  Vec2 place(const Anchor& anchor) {
    if (!anchor.on_page) page_.anchors.push_back(anchor.point);
    return view_.place(anchor);
  }

  // ---------------------------------------------------------------- in space

  HiddenLines hidden(const Fields& f) const { return hidden_of(f); }
  static double opacity_of(const HiddenLines& hidden) {
    return hidden.way == HiddenLines::Way::drop ? 0 : hidden.way == HiddenLines::Way::faded ? 1.0 / 3 : 1;
  }

  void stroke(CurvePtr curve, const HiddenLines& hidden, bool start, bool end) {
    Stroke stroke;
    stroke.curve = std::move(curve);
    stroke.kind = kind_;
    stroke.look = look_;
    stroke.hidden = drawn_hidden_look(view_.model, look_, hidden);
    stroke.object = -1;
    stroke.arrow_at_start = start, stroke.arrow_at_end = end;
    stroke.arrow_size = style_->arrow_size;
    work_.strokes.push_back(std::move(stroke));
  }

  void segment(const Vec3& from, const Vec3& to, const HiddenLines& hidden, bool start, bool end) {
    page_.anchors.push_back(from), page_.anchors.push_back(to);
    stroke(std::make_shared<Segment>(from, to), hidden, start, end);
  }

  void text(const Vec3& point, std::string words, const std::string& side, double distance, const HiddenLines& hidden,
            bool leader = false) {
    page_.anchors.push_back(point);
    PointText text;
    text.point = point;
    text.text = std::move(words);
    text.style = *style_;
    text.kind = kind_;
    text.side = side;
    text.distance = distance;
    text.leader = leader;
    text.hidden_opacity = opacity_of(hidden);
    text.object = -1;
    work_.texts.push_back(std::move(text));
  }

  static std::string side_of(const Fields& f) { return f.has("side") ? f.text("side") : std::string(); }

  void add_label(const Fields& f) {
    const Anchor& at = f.get<Anchor>("at");
    const std::string words = f.get<TextTemplate>("text").text();
    const double distance = f.has("distance") ? f.number("distance") : at.on_page ? 0.0 : 1.2;
    if (!at.on_page) return text(at.point, words, side_of(f), distance, hidden(f), f.boolean("leader"));
    Label label = page_label(words, place(at));
    label.side = f.has("side") ? f.text("side") : "center";
    label.distance = distance;
    page_.labels.push_back(std::move(label));
  }

  void add_point(const Fields& f) {
    const Anchor& at = f.get<Anchor>("at");
    Mark mark;
    mark.point = at.point;
    mark.sign = *mark_sign(f.text("marker"));
    mark.radius = 0.5 * style_->marker_size;
    mark.line = look_;
    if (style_->fill) mark.fill = rgb(*style_->fill);
    const HiddenLines ways = hidden(f);
    if (ways.way != HiddenLines::Way::drop) mark.hidden_opacity = style_->opacity * opacity_of(ways);
    mark.object = -1;
    if (at.on_page) {
      page_.shapes.push_back(SheetGroup{kind_, "", {}, {}, drawn_mark(mark, view_.place(at), style_->opacity, view_)});
    } else {
      page_.anchors.push_back(mark.point);
      work_.marks.push_back(mark);
    }
    if (!f.has("label")) return;
    const std::string words = f.get<TextTemplate>("label").text();
    const double distance = 0.6 + mark.radius;
    if (!at.on_page) return text(at.point, words, side_of(f), distance, ways);
    Label label = page_label(words, view_.place(at));
    label.side = side_of(f), label.distance = distance;
    page_.labels.push_back(std::move(label));
  }

  std::pair<bool, bool> heads() const {
    return {style_->arrows == "start" || style_->arrows == "both", style_->arrows == "end" || style_->arrows == "both"};
  }

  void add_arrow(const Fields& f) {
    const Anchor& from = f.get<Anchor>("from");
    const std::string words = f.has("label") ? f.get<TextTemplate>("label").text() : std::string();
    const auto [start, end] = heads();
    Anchor to;
    if (f.has("to"))
      to = f.get<Anchor>("to");
    else
      to.point = from.point + f.number("length") * f.vec3("along");
    if (from.on_page || to.on_page) {
      const Vec2 a = place(from), b = place(to);
      page_line(a, b, start, end);
      if (words.empty()) return;
      Label label = page_label(words, b);
      label.side = side_of(f);
      page_.labels.push_back(std::move(label));
      return;
    }
    if (to.point == from.point) return;
    const HiddenLines ways = hidden(f);
    segment(from.point, to.point, ways, start, end);
    if (!words.empty()) text(to.point, words, side_of(f), 0.8, ways);
  }

  void add_light_path(const Fields& f) {
    if (!world_) world_ = std::make_unique<const World>(std::make_shared<const Model>(view_.model), false);
    LightPath path;
    path.from = f.vec3("from");
    const Vec3 way = f.has("to") ? f.vec3("to") - path.from : f.vec3("along");
    if (!(glm::length(way) > 0)) return;
    path.direction = glm::normalize(way);
    path.wavelength = f.number("wavelength");
    path.bounces = f.integer("bounces");
    path.reflection = f.text("follow") == "reflection";
    path.length = f.has("length") ? f.number("length") : kLastPart * world_->radius();
    const std::vector<Vec3> corners = light_path(*world_, path);
    HiddenLines ways;
    ways.way = HiddenLines::Way::show;  // inside of glass, behind its surface
    const auto [start, end] = heads();
    for (size_t k = 0; k + 1 < corners.size(); ++k)
      if (corners[k] != corners[k + 1])
        segment(corners[k], corners[k + 1], ways, start && k == 0, end && k + 2 == corners.size());
  }

  void add_triad(const Vec3& origin, const std::array<Vec3, 3>& axes, const Fields& f) {
    const auto [start, end] = heads();
    const double length = f.number("length");
    const auto& labels = f.get<std::vector<TextTemplate>>("labels");
    const HiddenLines ways = hidden(f);
    for (size_t k = 0; k < 3; ++k) {
      const Vec3 tip = origin + length * axes[k];
      segment(origin, tip, ways, start, end);
      if (k < labels.size() && seen_from_the_side(origin, tip)) text(tip, labels[k].text(), "", 0.6, ways);
    }
  }
  // An axis that points at the viewer has no room for its name.
  bool seen_from_the_side(const Vec3& from, const Vec3& to) const {
    return glm::length(view_.place(to) - view_.place(from)) > 0.5;
  }

  void add_axes(const Fields& f) {
    const Anchor& at = f.get<Anchor>("at");
    constexpr std::array<Vec3, 3> kAxes{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
    if (!at.on_page) return add_triad(at.point, kAxes, f);
    // As they would be seen in the middle of the picture.
    const auto [start, end] = heads();
    const Ray middle = view_.camera.ray(0.5 * view_.camera.width(), 0.5 * view_.camera.height());
    const double depth = view_.camera.is_parallel() ? 0 : glm::length(middle_point() - middle.origin);
    const Vec3 origin = middle.origin + depth * middle.direction;
    const Vec2 corner = view_.place(at);
    const auto& labels = f.get<std::vector<TextTemplate>>("labels");
    for (size_t k = 0; k < 3; ++k) {
      const Vec2 tip = corner + view_.place(origin + f.number("length") * kAxes[k]) - view_.place(origin);
      if (glm::length(tip - corner) < 0.5) continue;
      page_line(corner, tip, start, end);
      if (k >= labels.size()) continue;
      Label label = page_label(labels[k].text(), tip);
      page_.labels.push_back(std::move(label));
    }
  }
  Vec3 middle_point() const {
    const Box3 box = bounds(view_.model);
    return 0.5 * (box.lo + box.hi);
  }

  // The plane of an angle, x along its first side. The sides of 180 degrees are one line, which lies in many planes: it
  // is the one across the way of sight, seen from its front. None where there is no angle, or such a line is seen
  // end-on.
  std::optional<Frame> plane_of_angle(const Vec3& apex, const Vec3& side, const Vec3& other) const {
    Vec3 z = glm::cross(side, other);
    if (!(glm::length(z) > kStraight * glm::length(side) * glm::length(other))) {
      if (!(glm::dot(side, other) < 0)) return std::nullopt;
      const PicturePoint seen = view_.camera.project(apex);
      const Vec3 sight = view_.camera.ray(seen.x, seen.y).direction, along = glm::normalize(side);
      z = glm::dot(sight, along) * along - sight;
      if (!(glm::length(z) > kStraight)) return std::nullopt;
    }
    return frame_from(apex, glm::normalize(z), glm::normalize(side));
  }

  // Scene units of a length on the page that lies across the way of sight at this point.
  double in_scene(double millimetres, const Vec3& point) const {
    return millimetres / view_.millimetres * view_.camera.pixel_size(point);
  }

  void add_angle(const Fields& f) {
    const Anchor &at = f.get<Anchor>("at"), &from = f.get<Anchor>("from"), &to = f.get<Anchor>("to");
    const double radius = f.number("radius");
    const std::string words = f.has("label") ? f.get<TextTemplate>("label").text() : std::string();
    if (at.on_page || from.on_page || to.on_page)
      page_arc(place(at), place(from), place(to), radius, words, side_of(f));
    else
      arc_of_angle(at.point, from.point, to.point, in_scene(radius, at.point), words, side_of(f), hidden(f));
  }

  // The arc from one side to the other, of a radius in scene units.
  void arc_of_angle(const Vec3& apex, const Vec3& from, const Vec3& to, double radius, const std::string& words,
                    const std::string& side, const HiddenLines& ways) {
    const std::optional<Frame> frame = plane_of_angle(apex, from - apex, to - apex);
    if (!frame) return;
    page_.anchors.push_back(apex);
    const Vec3 other = to - apex;
    const double angle = std::atan2(std::abs(glm::dot(other, frame->y)), glm::dot(other, frame->x));
    const auto [start, end] = heads();
    stroke(std::make_shared<Circle>(*frame, radius, Interval{0, angle}), ways, start, end);
    const auto on_arc = [&](double part) {
      return view_.place(frame->point(radius * Vec3(std::cos(part * angle), std::sin(part * angle), 0)));
    };
    constexpr int kPlaces = 8;
    for (int k = 0; k <= kPlaces; ++k) page_.reach.push_back(on_arc(static_cast<double>(k) / kPlaces));
    arc_label(view_.place(apex), on_arc, words, side);
  }

  // The text of an arc about `apex` on the page: outside of its middle or, where something is in the way there, at
  // other places of it, inside of it, farther outside, or beside its ends.
  template <class Place>
  void arc_label(const Vec2& apex, const Place& on_arc, const std::string& words, const std::string& side) {
    if (words.empty()) return;
    Label label = page_label(words, on_arc(0.5));
    label.side = side;
    label.distance = kTextOff;
    if (side.empty()) {
      const auto beside = [&](const Vec2& point, const Vec2& way, double distance) {
        label.spots.push_back({point, side_towards(way), distance});
      };
      constexpr double kParts[] = {0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8};
      for (const double part : kParts) beside(on_arc(part), on_arc(part) - apex, kTextOff);
      for (const double part : kParts) label.spots.push_back({apex + 0.6 * (on_arc(part) - apex), "center", 0});
      for (const double farther : {1.5, 3.0, 5.0}) beside(on_arc(0.5), on_arc(0.5) - apex, kTextOff + farther);
      for (const double end : {0.0, 1.0}) beside(on_arc(end), on_arc(end) - on_arc(0.5), kTextOff);
    }
    page_.labels.push_back(std::move(label));
  }

  // In the plane of the angle, beyond the nearer of the two points: so the offset is foreshortened as that plane is.
  void add_angle_dimension(const Fields& f) {
    const Vec3 apex = f.get<Anchor>("at").point;
    const std::array<Vec3, 2> ends = {f.get<Anchor>("from").point, f.get<Anchor>("to").point};
    const Vec3 x = ends[0] - apex, y = ends[1] - apex;
    const double radius = std::min(glm::length(x), glm::length(y)) + in_scene(f.number("offset"), apex);
    std::array<Vec3, 2> feet;
    for (size_t k = 0; k < 2; ++k) {
      page_.anchors.push_back(ends[k]);
      if (!(glm::length(ends[k] - apex) > 0)) return;
      feet[k] = apex + radius * glm::normalize(ends[k] - apex);
      if (!is_seen(feet[k])) return leave_out();
    }
    for (size_t k = 0; k < 2; ++k) {
      const Vec2 point = view_.place(ends[k]), foot = view_.place(feet[k]);
      const double length = glm::length(foot - point);
      if (glm::length(ends[k] - apex) > radius || !(length > kGap)) continue;
      const Vec2 way = (foot - point) / length;
      page_line(point + kGap * way, foot + kBeyond * way, false, false);
    }
    const double degrees = std::atan2(glm::length(glm::cross(x, y)), glm::dot(x, y)) * 180 / kPi;
    arc_of_angle(apex, ends[0], ends[1], radius, number_text(f, degrees, "", "°"), "",
                 HiddenLines{HiddenLines::Way::show, {}});
  }

  // ---------------------------------------------------------------- on the page

  Label page_label(const std::string& words, const Vec2& at) const {
    Label label;
    label.text = text_in(*style_, words);
    label.at = at;
    label.kind = kind_;
    if (style_->fill) label.box = Brush{rgb(*style_->fill), 1};
    return label;
  }

  void shape(std::vector<SheetItem> items) { page_.shapes.push_back(SheetGroup{kind_, "", {}, {}, std::move(items)}); }

  void page_line(const Vec2& from, const Vec2& to, bool start, bool end) {
    if (from != to) shape(line_with_heads(from, to, start, end, style_->arrow_size, look_));
  }

  void page_arc(const Vec2& apex, const Vec2& side, const Vec2& other, double radius, const std::string& words,
                const std::string& text_side) {
    const Vec2 x = side - apex, y = other - apex;
    const double from = std::atan2(-x.y, x.x);
    double angle = std::atan2(-y.y, y.x) - from;
    if (angle > kPi) angle -= kTwoPi;
    if (angle < -kPi) angle += kTwoPi;
    const PictureEllipse circle{apex, {radius, 0}, {0, -radius}};
    shape({drawn({circle.point(from), arcs_to(circle, from, from + angle), false}, look_)});
    arc_label(
        apex, [&](double part) { return circle.point(from + part * angle); }, words, text_side);
  }

  void add_leader(const Fields& f) {
    const Vec2 at = place(f.get<Anchor>("at")), to = place(f.get<Anchor>("to"));
    const std::string& head = f.text("head");
    page_line(to, at, false, head == "arrow");
    if (head == "dot") {
      Mark dot;
      dot.radius = 0.5 * style_->marker_size;
      dot.line = look_;
      shape(drawn_mark(dot, at, style_->opacity, view_));
    }
    Label label = page_label(f.get<TextTemplate>("text").text(), to);
    label.side = f.has("side") ? f.text("side") : to.x >= at.x ? "right" : "left";
    page_.labels.push_back(std::move(label));
  }

  void add_brace(const Fields& f) {
    const Vec2 from = place(f.get<Anchor>("from")), to = place(f.get<Anchor>("to"));
    if (from == to) return;
    const double offset = f.number("offset"), depth = (offset < 0 ? -1 : 1) * f.number("depth");
    const Brace brace = brace_along(from, to, offset, depth);
    shape({drawn(brace.path, look_)});
    if (!f.has("label")) return;
    Label label = page_label(f.get<TextTemplate>("label").text(), brace.tip);
    label.side = side_towards(brace.out);
    label.distance = kTextOff;
    page_.labels.push_back(std::move(label));
  }

  // The number with what stands around it, or the text in its place.
  static std::string number_text(const Fields& f, double value, const std::string& sign, const std::string& unit) {
    if (f.has("text")) return f.get<TextTemplate>("text").text();
    std::string words;
    if (f.has("prefix")) words += f.get<TextTemplate>("prefix").text();
    words += sign +
             (f.given("decimals") || !unit.empty() ? dimension_number(value, f.integer("decimals"))
                                                   : dimension_number(value)) +
             unit;
    if (f.has("suffix")) words += f.get<TextTemplate>("suffix").text();
    return words;
  }

  void add_linear_dimension(const Fields& f) {
    const Vec3 a = f.get<Anchor>("from").point, b = f.get<Anchor>("to").point;
    const Vec3 along = f.has("along") ? f.vec3("along") : b - a;
    const double value = f.has("along") ? std::abs(glm::dot(b - a, along)) : glm::length(b - a);
    if (!(value > 0)) return;
    const Vec2 p = place(f.get<Anchor>("from")), q = place(f.get<Anchor>("to"));
    const Vec3 beyond = f.has("along") ? a + value * along : b;
    if (!is_seen(beyond)) return leave_out();
    const Vec2 shown = view_.place(beyond) - p;
    if (!(glm::length(shown) > 1e-6)) return;  // seen along itself
    Vec2 way = glm::normalize(shown);
    if (glm::dot(q - p, way) < 0) way = -way;
    const Vec2 forward = glm::normalize(shown), out(forward.y, -forward.x);  // to the left, as seen
    const double offset = f.number("offset");
    const double hp = glm::dot(p, out), hq = glm::dot(q, out);
    const double level = (offset >= 0 ? std::max(hp, hq) : std::min(hp, hq)) + offset;
    const Vec2 from = p + (level - hp) * out, to = q + (level - hq) * out;
    for (const auto& [point, foot] : {std::pair(p, from), std::pair(q, to)}) {
      const double length = glm::length(foot - point);
      if (length <= kGap) continue;
      const Vec2 away = (foot - point) / length;
      page_line(point + kGap * away, foot + kBeyond * away, false, false);
    }
    const double length = glm::length(to - from);
    if (length >= kLeastForHeads * style_->arrow_size) {
      const auto [start, end] = heads();
      page_line(from, to, start, end);
    } else {
      page_line(from, to, false, false);
      page_line(from - 2 * style_->arrow_size * way, from, false, true);
      page_line(to + 2 * style_->arrow_size * way, to, false, true);
    }
    text_along(number_text(f, value, "", ""), 0.5 * (from + to), way, length);
  }

  // Above the line as read from below or from the right.
  void text_along(const std::string& words, const Vec2& middle, Vec2 way, double length) {
    if (way.x < -1e-9 || (std::abs(way.x) <= 1e-9 && way.y > 0)) way = -way;
    const Vec2 up(way.y, -way.x);
    Label label = page_label(words, middle);
    label.side = "here";
    label.text.alignment = 0.5;
    label.text.angle = std::atan2(-way.y, way.x);
    const auto at = [&](double beside) {
      return middle + (beside - 0.5 * label.text.width) * way + (kTextOff + label.text.descent) * up;
    };
    label.text.at = at(0);
    if (label.text.width + 1 > length) {
      // It does not fit between the arrows: behind one of them.
      label.side.clear();
      const double beside = 0.5 * length + 2.5 * style_->arrow_size + 0.5 * label.text.width;
      label.spots = {{at(beside), "here", 0}, {at(-beside), "here", 0}};
    }
    page_.labels.push_back(std::move(label));
  }

  void add_round_dimension(const Fields& f, bool diameter) {
    const Circle circle = circle_of(f);
    const Frame& frame = circle.frame();
    const double radius = circle.radius();
    const Vec3 corner = radius * (frame.x + frame.y), other = radius * (frame.x - frame.y);
    const std::array<Vec3, 4> around = {frame.origin + corner, frame.origin - corner, frame.origin + other,
                                        frame.origin - other};
    if (!std::all_of(around.begin(), around.end(), [&](const Vec3& point) { return is_seen(point); }))
      return leave_out();
    page_.anchors.push_back(frame.origin + radius * frame.x), page_.anchors.push_back(frame.origin - radius * frame.x);
    page_.anchors.push_back(frame.origin + radius * frame.y), page_.anchors.push_back(frame.origin - radius * frame.y);
    const double leader = f.number("leader");
    const Vec2 way(std::cos(leader), -std::sin(leader));
    const Vec2 center = view_.place(frame.origin);
    const Vec2 x = view_.place(frame.origin + radius * frame.x) - center,
               y = view_.place(frame.origin + radius * frame.y) - center;
    const auto cross = [](const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; };
    // The point of the circle that is seen in this direction.
    double t = std::atan2(-cross(way, x), cross(way, y));
    if (glm::dot(std::cos(t) * x + std::sin(t) * y, way) < 0) t += kPi;
    const auto on = [&](double at) { return view_.place(frame.point(radius * Vec3(std::cos(at), std::sin(at), 0))); };
    const Vec2 near = on(t), far = on(t + kPi);
    const double span = diameter ? glm::length(near - far) : glm::length(near - center);
    if (!(span > 0)) return;
    const Vec2 out = glm::normalize(near - (diameter ? far : center));
    const Vec2 end = near + kShelf * out;
    const bool fits = span >= kLeastForHeads * style_->arrow_size;
    if (fits) {
      page_line(diameter ? far : center, near, diameter, true);
      page_line(near, end, false, false);
    } else {
      page_line(end, near, false, true);
      if (diameter) page_line(far - 2 * style_->arrow_size * out, far, false, true);
    }
    Label label = page_label(number_text(f, diameter ? 2 * radius : radius, diameter ? "⌀" : "R", ""), end);
    label.side = out.x >= -1e-9 ? "right" : "left";
    label.distance = 0.6;
    page_.labels.push_back(std::move(label));
  }

  std::unique_ptr<const World> world_;  // one for all light paths
  const View& view_;
  LineWork& work_;
  PageWork& page_;
  std::string kind_;
  const Style* style_ = nullptr;
  LineLook look_;
};

}  // namespace

void add_annotations(const View& view, LineWork& work, PageWork& page) {
  Annotator annotator(view, work, page);
  for (const Annotation& annotation : view.model.drawing.annotations) annotator.add(annotation);
}

}  // namespace lekalo::render
