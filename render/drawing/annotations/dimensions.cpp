#include "render/drawing/annotations/dimensions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include "geometry/curves/analytic/circle.h"
#include "render/drawing/annotations/page_shapes.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// Millimetres, as ISO 129-1 draws dimensions of a small figure.
constexpr double kGap = 0.8;           // between a point and the line that leads away from it
constexpr double kBeyond = 1.5;        // by which these lines pass the dimension line
constexpr double kTextOff = 0.7;       // between a line and the text upon it
constexpr double kShelf = 6;           // from a circle to the number of its radius, at least
constexpr double kBesideShelf = 0.6;   // between that line's end and the number
constexpr double kInside = 0.4;        // of the way to the apex of an angle: a text within a small arc
constexpr double kNearArc = 4;         // from an arc to a text that speaks of it
constexpr double kMinForHeads = 3;     // in arrow lengths: shorter dimension lines have their arrows outside
constexpr double kTail = 2;            // in arrow lengths: from there lines lead to arrows outside
constexpr double kBesideText = 0.5;    // between a text upon a line and the line's ends
constexpr double kNumberBorder = 0.2;  // around a number: it may be so near to the arrow heads of its line
constexpr double kLean = 0.6;          // of leaders to numbers, for each of their height
constexpr double kSameHeight = 1e-6;   // millimetres: the points of one edge seen from its side
constexpr double kFromItsSide = 1e-6;  // of a circle's area on the page: what is less is none
constexpr double kStraight = 1e-9;     // radians: sides of an angle that are one line

// The plane of an angle, x along its first side. The sides of 180 degrees are one line, which lies in many planes: it
// is the one across the line of sight, seen from its front. None where there is no angle, or such a line is seen
// end-on.
std::optional<Frame> plane_of_angle(const View& view, const Vec3& apex, const Vec3& side, const Vec3& other) {
  Vec3 z = glm::cross(side, other);
  if (!(glm::length(z) > kStraight * glm::length(side) * glm::length(other))) {
    if (!(glm::dot(side, other) < 0)) return std::nullopt;
    const PicturePoint seen = view.camera.project(apex);
    const Vec3 sight = view.camera.ray(seen.x, seen.y).direction, along = glm::normalize(side);
    z = glm::dot(sight, along) * along - sight;
    if (!(glm::length(z) > kStraight)) return std::nullopt;
  }
  return frame_from(apex, glm::normalize(z), glm::normalize(side));
}

// A leader from a point of an arc, first along `way`, then level below the text at its end.
LabelSpot spot_on_leader(const SheetText& text, const Vec2& from, const Vec2& way, double length) {
  const double side = way.x < -1e-9 ? -1 : 1;
  const Vec2 knee = from + length * way, end = knee + Vec2(side * text.width, 0);
  return {{std::min(knee.x, end.x), knee.y - kTextOff - text.descent}, "here", 0, {{from, knee}, {knee, end}}};
}

// The text of an arc about `apex` on the page: outside of its middle or, where something is in the way there, at
// other places of it, inside of it, beside its ends, or farther off; the number of a dimension on a leader then.
template <class Place>
void arc_label(AnnotationWork& work, const Vec2& apex, const Place& on_arc, const std::string& words,
               const std::string& side, bool dimension) {
  if (words.empty()) return;
  Label label = work.page_label(words, on_arc(0.5));
  label.side = side;
  label.distance = kTextOff;
  if (side.empty()) {
    const auto beside = [&](const Vec2& point, const Vec2& way, double distance) {
      label.spots.push_back({point, side_towards(way), distance});
    };
    constexpr double kParts[] = {0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8};
    for (const double part : kParts) beside(on_arc(part), on_arc(part) - apex, kTextOff);
    for (const double part : kParts) {
      const Vec2 inwards = apex - on_arc(part);
      if (kInside * glm::length(inwards) <= kNearArc)
        label.spots.push_back({on_arc(part) + kInside * inwards, "center", 0});
      else
        beside(on_arc(part), inwards, kTextOff);
    }
    if (!dimension)
      for (const double farther : {1.5, 3.0, 5.0}) beside(on_arc(0.5), on_arc(0.5) - apex, kTextOff + farther);
    for (const double end : {0.0, 1.0}) beside(on_arc(end), on_arc(end) - on_arc(0.5), kTextOff);
    if (dimension) {
      label.text.alignment = 0.5;
      label.pen = work.look();
      for (const double length : {4.0, 7.0, 11.0})
        for (const double part : {0.5, 0.3, 0.7})
          for (const double out : {1.0, -1.0}) {
            const Vec2 way = out * (on_arc(part) - apex);
            if (glm::length(way) > (out > 0 ? 0 : length))
              label.spots.push_back(spot_on_leader(label.text, on_arc(part), glm::normalize(way), length));
          }
    }
  }
  work.add(std::move(label));
}

// The arc from one side to the other, of a radius in scene units.
void arc_of_angle(AnnotationWork& work, const Vec3& apex, const Vec3& from, const Vec3& to, double radius,
                  const std::string& words, const std::string& side, const HiddenLines& ways, bool dimension) {
  const std::optional<Frame> frame = plane_of_angle(work.view(), apex, from - apex, to - apex);
  if (!frame) return work.leave_out_end_on();
  work.page().anchors.push_back(apex);
  const Vec3 other = to - apex;
  const double angle = std::atan2(std::abs(glm::dot(other, frame->y)), glm::dot(other, frame->x));
  const auto [start, end] = work.heads();
  work.stroke(std::make_shared<Circle>(*frame, radius, Interval{0, angle}), ways, start, end);
  const auto on_arc = [&](double part) {
    return work.view().place(frame->point(radius * Vec3(std::cos(part * angle), std::sin(part * angle), 0)));
  };
  constexpr int kPlaces = 8;
  for (int k = 0; k <= kPlaces; ++k) work.page().reach.push_back(on_arc(static_cast<double>(k) / kPlaces));
  arc_label(work, work.view().place(apex), on_arc, words, side, dimension);
}

void page_arc(AnnotationWork& work, const Vec2& apex, const Vec2& side, const Vec2& other, double radius,
              const std::string& words, const std::string& text_side) {
  const Vec2 x = side - apex, y = other - apex;
  const double from = std::atan2(-x.y, x.x);
  double angle = std::atan2(-y.y, y.x) - from;
  if (angle > kPi) angle -= kTwoPi;
  if (angle < -kPi) angle += kTwoPi;
  const PictureEllipse circle{apex, {radius, 0}, {0, -radius}};
  work.shape({drawn({circle.point(from), arcs_to(circle, from, from + angle), false}, work.look())});
  arc_label(
      work, apex, [&](double part) { return circle.point(from + part * angle); }, words, text_side, false);
}

// From a point that is measured to the dimension line and beyond it.
void extension_line(AnnotationWork& work, const Vec2& point, const Vec2& foot_point) {
  const double length = glm::length(foot_point - point);
  if (!(length > kGap)) return;
  const Vec2 way = (foot_point - point) / length;
  work.page_line(point + kGap * way, foot_point + kBeyond * way, false, false);
}

// The number with what stands around it, or the text in its place.
std::string number_text(const AnnotationWork& work, double value, const std::string& sign, const std::string& unit) {
  const Fields& f = work.fields();
  if (f.has("text")) return work.words("text");
  const bool with_decimals = f.given("decimals") || !unit.empty();
  return work.words("prefix") + sign +
         (with_decimals ? dimension_number(value, f.integer("decimals")) : dimension_number(value)) + unit +
         work.words("suffix");
}

// A dimension line as it is read, from below or from the right.
struct ReadLine {
  Vec2 middle{0}, way{0}, up{0};
  double length = 0;
  double ends = 0;  // by which arrow heads and their lines go on at both ends
  double out = 1;   // the side along `up` that looks away from what is measured: 1 or -1

  Vec2 at(double along, double upwards) const { return middle + along * way + upwards * up; }
};

// Where the number of a dimension may stand, the best liked place first: upon the middle of its line, elsewhere upon
// it, upon its continuation, at the end of a leader. What does not fit between the ends has the last two.
std::vector<LabelSpot> places_of_number(const SheetText& text, const ReadLine& line) {
  std::vector<LabelSpot> spots;
  const auto add = [&](double along, double upwards, std::vector<LabelLine> lines) {
    spots.push_back({line.at(along - 0.5 * text.width, upwards + kTextOff + text.descent), "here", 0, std::move(lines),
                     kNumberBorder});
  };
  const double half = 0.5 * line.length, free = line.length - text.width - 2 * kBesideText;
  if (free >= 0)
    for (const double part : {0.0, 0.5, -0.5, 1.0, -1.0}) add(0.5 * part * free, 0, {});
  for (const double side : {1.0, -1.0}) {
    const double begin = half + std::max(1.25 * line.ends, 2 * kBesideText), end = begin + text.width;
    add(side * (begin + 0.5 * text.width), 0, {{line.at(side * (half + line.ends), 0), line.at(side * end, 0)}});
  }
  const double height = text.ascent + text.descent + 2 * kTextOff;
  for (const double level : {0, 1, 2})
    for (const double away : {line.out, -line.out})
      for (const double side : {1.0, -1.0}) {
        // The text stands upon the leader's end: below the line it needs its own height more.
        const double rise = away * (kBeyond + kTextOff + level * height) - (away < 0 ? height : 0);
        const double knee = side * kLean * std::abs(rise), end = knee + side * text.width;
        add(0.5 * (knee + end), rise,
            {{line.at(0, 0), line.at(knee, rise)}, {line.at(knee, rise), line.at(end, rise)}});
      }
  return spots;
}

// `out`: the unit direction away from what is measured.
void add_number(AnnotationWork& work, const std::string& words, const Vec2& from, const Vec2& to, const Vec2& out,
                double ends) {
  ReadLine line;
  line.middle = 0.5 * (from + to);
  line.length = glm::length(to - from);
  line.ends = ends;
  line.way = Vec2(-out.y, out.x);
  if (line.way.x < -1e-9 || (std::abs(line.way.x) <= 1e-9 && line.way.y > 0)) line.way = -line.way;
  line.up = Vec2(line.way.y, -line.way.x);
  line.out = glm::dot(line.up, out) < 0 ? -1 : 1;
  Label label = work.page_label(words, line.middle);
  label.text.alignment = 0.5;
  label.text.angle = std::atan2(-line.way.y, line.way.x);
  label.pen = work.look();
  label.spots = places_of_number(label.text, line);
  work.add(std::move(label));
}

// Where the number of a radius or a diameter may stand: at an end of its line beyond the circle, the nearer the better
// liked. `ends`: where that line leaves the circle, and the way that it takes. `drawn`: so much of it is there already.
std::vector<LabelSpot> places_along(const std::vector<std::pair<Vec2, Vec2>>& ends, double drawn) {
  std::vector<LabelSpot> spots;
  for (const double farther : {0.0, 2.0, 4.0, 7.0, 11.0, 16.0})
    for (const auto& [from, out] : ends) {
      const Vec2 end = from + (kShelf + farther) * out;
      spots.push_back({end, out.x >= -1e-9 ? "right" : "left", kBesideShelf, {{from + drawn * out, end}}});
    }
  return spots;
}

// Of a face or the end of a body any point will do: the one nearest to the dimension line.
Vec3 begin_of_dimension(const AnnotationWork& work, const char* field, const Vec2& out) {
  const Fields& f = work.fields();
  const std::string spots = std::string(field) + ".spots";
  Vec3 best = f.get<Anchor>(field).point;
  if (!f.has(spots)) return best;
  double farthest = -kInfinity;
  for (const Vec3& point : f.get<std::vector<Vec3>>(spots)) {
    const double height = glm::dot(work.view().place(point), out);
    if (height > farthest + kSameHeight) farthest = height, best = point;
  }
  return best;
}

}  // namespace

void add_angle(AnnotationWork& work) {
  const Fields& f = work.fields();
  const Anchor &at = f.get<Anchor>("at"), &from = f.get<Anchor>("from"), &to = f.get<Anchor>("to");
  const double radius = f.number("radius");
  if (at.on_page || from.on_page || to.on_page)
    page_arc(work, work.place(at), work.place(from), work.place(to), radius, work.words("label"), work.side());
  else
    arc_of_angle(work, at.point, from.point, to.point, work.in_scene(radius, at.point), work.words("label"),
                 work.side(), work.hidden(), false);
}

// In the plane of the angle, beyond the nearer of the two points: so the offset is foreshortened as that plane is.
void add_angle_dimension(AnnotationWork& work) {
  const Fields& f = work.fields();
  const View& view = work.view();
  const Vec3 apex = f.get<Anchor>("at").point;
  const std::array<Vec3, 2> ends = {f.get<Anchor>("from").point, f.get<Anchor>("to").point};
  const Vec3 x = ends[0] - apex, y = ends[1] - apex;
  const double radius = std::min(glm::length(x), glm::length(y)) + work.in_scene(f.number("offset"), apex);
  std::array<Vec3, 2> foot_points;
  for (size_t k = 0; k < 2; ++k) {
    work.page().anchors.push_back(ends[k]);
    if (!(glm::length(ends[k] - apex) > 0)) return;
    foot_points[k] = apex + radius * glm::normalize(ends[k] - apex);
    if (!work.is_seen(foot_points[k])) return work.leave_out_behind();
  }
  for (size_t k = 0; k < 2; ++k)
    if (!(glm::length(ends[k] - apex) > radius)) extension_line(work, view.place(ends[k]), view.place(foot_points[k]));
  const double degrees = std::atan2(glm::length(glm::cross(x, y)), glm::dot(x, y)) * 180 / kPi;
  arc_of_angle(work, apex, ends[0], ends[1], radius, number_text(work, degrees, "", "°"), "",
               HiddenLines{HiddenLines::Way::show, {}}, true);
}

void add_linear_dimension(AnnotationWork& work) {
  const Fields& f = work.fields();
  Vec3 a = f.get<Anchor>("from").point, b = f.get<Anchor>("to").point;
  const Vec3 along = f.has("along") ? f.vec3("along") : b - a;
  const double value = f.has("along") ? std::abs(glm::dot(b - a, along)) : glm::length(b - a);
  if (!(value > 0)) return;
  const Vec3 beyond = f.has("along") ? a + value * along : b;
  if (!work.is_seen(a) || !work.is_seen(beyond)) return work.leave_out_behind();
  const Vec2 shown = work.view().place(beyond) - work.view().place(a);
  if (glm::length(shown) < kSeenEndOn) return work.leave_out_end_on();
  const Vec2 forward = glm::normalize(shown), out(forward.y, -forward.x);  // to the left, as seen
  const double offset = f.number("offset");
  a = begin_of_dimension(work, "from", offset >= 0 ? out : -out);
  b = begin_of_dimension(work, "to", offset >= 0 ? out : -out);
  const Vec2 p = work.place({a, false}), q = work.place({b, false});
  Vec2 way = forward;
  if (glm::dot(q - p, way) < 0) way = -way;
  const double hp = glm::dot(p, out), hq = glm::dot(q, out);
  const double level = (offset >= 0 ? std::max(hp, hq) : std::min(hp, hq)) + offset;
  const Vec2 from = p + (level - hp) * out, to = q + (level - hq) * out;
  extension_line(work, p, from);
  extension_line(work, q, to);
  const double head = work.style().arrow_size, tail = kTail * head;
  const bool fits = glm::length(to - from) >= kMinForHeads * head;
  if (fits) {
    const auto [start, end] = work.heads();
    work.page_line(from, to, start, end);
  } else {
    work.page_line(from, to, false, false);
    work.page_line(from - tail * way, from, false, true);
    work.page_line(to + tail * way, to, false, true);
  }
  add_number(work, number_text(work, value, "", ""), from, to, offset >= 0 ? out : -out, fits ? 0 : tail);
}

void add_round_dimension(AnnotationWork& work, bool diameter) {
  const std::vector<Circle> circles = circles_of(work.fields().references("of"));
  // Of several the one that fills most of the picture.
  const auto seen_area = [&](const Circle& circle) {
    const Frame& frame = circle.frame();
    const Vec2 center = work.view().place(frame.origin);
    const Vec2 x = work.view().place(frame.origin + circle.radius() * frame.x) - center,
               y = work.view().place(frame.origin + circle.radius() * frame.y) - center;
    const double area = std::abs(x.x * y.y - x.y * y.x);
    return std::isfinite(area) ? area : 0;
  };
  const Circle circle = *std::max_element(circles.begin(), circles.end(), [&](const Circle& a, const Circle& b) {
    return seen_area(a) < seen_area(b) * (1 - 1e-9);
  });
  const Frame& frame = circle.frame();
  const double radius = circle.radius();
  const Vec3 corner = radius * (frame.x + frame.y), other = radius * (frame.x - frame.y);
  const std::array<Vec3, 4> around = {frame.origin + corner, frame.origin - corner, frame.origin + other,
                                      frame.origin - other};
  if (!std::all_of(around.begin(), around.end(), [&](const Vec3& point) { return work.is_seen(point); }))
    return work.leave_out_behind();
  for (const Vec3& axis : {frame.x, -frame.x, frame.y, -frame.y})
    work.page().anchors.push_back(frame.origin + radius * axis);
  const double leader = work.fields().number("leader");
  const Vec2 way(std::cos(leader), -std::sin(leader));
  const View& view = work.view();
  const Vec2 center = view.place(frame.origin);
  const Vec2 x = view.place(frame.origin + radius * frame.x) - center,
             y = view.place(frame.origin + radius * frame.y) - center;
  const auto cross = [](const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; };
  // The point of the circle that is seen in this direction.
  double t = std::atan2(-cross(way, x), cross(way, y));
  // Seen from its side it is a line, whatever the direction.
  if (std::abs(cross(x, y)) < kFromItsSide * (glm::dot(x, x) + glm::dot(y, y))) {
    const Vec2 along = glm::dot(x, x) > glm::dot(y, y) ? x : y;
    t = std::atan2(glm::dot(y, along), glm::dot(x, along));
  }
  if (glm::dot(std::cos(t) * x + std::sin(t) * y, way) < 0) t += kPi;
  // An arc that does not go there is met in its middle.
  const Interval arc = circle.domain();
  if (!diameter && std::fmod(t - arc.lo + 2 * kTwoPi, kTwoPi) > arc.width()) t = arc.middle();
  const auto on = [&](double at) { return view.place(frame.point(radius * Vec3(std::cos(at), std::sin(at), 0))); };
  const Vec2 near = on(t), far = on(t + kPi);
  const double span = diameter ? glm::length(near - far) : glm::length(near - center);
  if (span < kSeenEndOn) return work.leave_out("whose circle is too small to be seen");
  const Vec2 out = glm::normalize(near - (diameter ? far : center));
  const double head = work.style().arrow_size, tail = kTail * head;
  const bool fits = span >= kMinForHeads * head;
  if (fits) {
    work.page_line(diameter ? far : center, near, diameter, true);
  } else {
    work.page_line(near + tail * out, near, false, true);
    if (diameter) work.page_line(far - tail * out, far, false, true);
  }
  Label label =
      work.page_label(number_text(work, diameter ? 2 * radius : radius, diameter ? "⌀" : "R", ""), near + kShelf * out);
  label.pen = work.look();
  std::vector<std::pair<Vec2, Vec2>> ends{{near, out}};
  if (diameter) ends.emplace_back(far, -out);
  label.spots = places_along(ends, fits ? 0 : tail);
  work.add(std::move(label));
}

}  // namespace lekalo::render
