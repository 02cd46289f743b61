#include "render/drawing/annotations/label_placement.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/drawing/text/text_layout.h"
#include "render/drawing/view.h"

namespace lekalo::render {

namespace {

// Costs by what they are for; those of lines and texts grow with what is covered, in millimetres.
constexpr double kOnText = 60, kOffPaper = 60, kOnLine = 3, kOnSign = 12;
constexpr double kFarther = 0.5;   // for each step away from the point
constexpr double kNextSpot = 0.1;  // for each place that is liked better
constexpr int kRounds = 4;
constexpr double kCrossing = 10;  // for lines of two texts that cross
constexpr double kOverLine = 1;   // for a line of a text that crosses another line
constexpr double kBad = 2;        // a place that costs so much may be worth moving another text for
constexpr double kUpon = 0.1;     // millimetres between lines that are one for the eye

// In the order in which they are liked; y downwards.
struct Direction {
  const char* side;
  Vec2 way;
};
const std::array<Direction, 8> kDirections = {{{"above right", {1, -1}},
                                               {"above left", {-1, -1}},
                                               {"above", {0, -1}},
                                               {"right", {1, 0}},
                                               {"below right", {1, 1}},
                                               {"left", {-1, 0}},
                                               {"below", {0, 1}},
                                               {"below left", {-1, 1}}}};

SheetBox with_border(const SheetBox& box, double border) { return {box.lo - border, box.hi + border}; }

// What the text takes: its box or, where it is turned, the boxes of pieces of it about as long as high.
std::vector<SheetBox> boxes_of(const SheetText& text, double border) {
  const double height = text.ascent + text.descent;
  const int pieces = text.angle != 0 && height > 0 ? std::max(1, static_cast<int>(std::ceil(text.width / height))) : 1;
  std::vector<SheetBox> boxes;
  for (int k = 0; k < pieces; ++k)
    boxes.push_back(
        with_border(box_of(text, static_cast<double>(k) / pieces, static_cast<double>(k + 1) / pieces), border));
  return boxes;
}

double overlap(const SheetBox& a, const SheetBox& b) {
  const double x = std::min(a.hi.x, b.hi.x) - std::max(a.lo.x, b.lo.x),
               y = std::min(a.hi.y, b.hi.y) - std::max(a.lo.y, b.lo.y);
  return x > 0 && y > 0 ? std::min(x, y) + x * y : 0;
}

double overlap(const std::vector<SheetBox>& some, const std::vector<SheetBox>& others) {
  double sum = 0;
  for (const SheetBox& a : some)
    for (const SheetBox& b : others) sum += overlap(a, b);
  return sum;
}

// Length of a segment within a rectangle.
double covered(const SheetBox& box, const Vec2& from, const Vec2& to) {
  double lo = 0, hi = 1;
  const Vec2 way = to - from;
  for (int axis = 0; axis < 2; ++axis) {
    if (way[axis] == 0) {
      if (from[axis] < box.lo[axis] || from[axis] > box.hi[axis]) return 0;
      continue;
    }
    double a = (box.lo[axis] - from[axis]) / way[axis], b = (box.hi[axis] - from[axis]) / way[axis];
    if (a > b) std::swap(a, b);
    lo = std::max(lo, a), hi = std::min(hi, b);
  }
  return hi > lo ? (hi - lo) * glm::length(way) : 0;
}

// The beginning of the baseline of a text that stands so beside its point.
Vec2 baseline(const SheetText& text, const Vec2& at, const Vec2& way, double distance) {
  const double off = way.x != 0 && way.y != 0 ? distance * std::sqrt(0.5) : distance;
  Vec2 place;
  place.x = way.x > 0 ? at.x + off : way.x < 0 ? at.x - off - text.width : at.x - 0.5 * text.width;
  place.y = way.y > 0   ? at.y + off + text.ascent
            : way.y < 0 ? at.y - off - text.descent
                        : at.y + 0.5 * (text.ascent - text.descent);
  return place;
}

struct Candidate {
  Vec2 at{0};
  double alignment = 0;
  double cost = 0;  // all but that of other texts
  std::vector<SheetBox> boxes;
  std::vector<LabelLine> lines;
};

double covered(const std::vector<SheetBox>& boxes, const std::vector<LabelLine>& lines) {
  double sum = 0;
  for (const SheetBox& box : boxes)
    for (const auto& [from, to] : lines) sum += covered(box, from, to);
  return sum;
}

bool cross(const LabelLine& a, const LabelLine& b) {
  const auto side = [](const LabelLine& line, const Vec2& point) {
    const Vec2 way = line.second - line.first, off = point - line.first;
    return way.x * off.y - way.y * off.x;
  };
  return side(a, b.first) * side(a, b.second) < 0 && side(b, a.first) * side(b, a.second) < 0;
}

// What two labels cost each other.
double cost_of(const Candidate& a, const Candidate& b) {
  double cost = 0;
  if (const double over = overlap(a.boxes, b.boxes); over > 0) cost += kOnText + kOnText * over;
  if (const double length = covered(a.boxes, b.lines) + covered(b.boxes, a.lines); length > 0)
    cost += kOnLine * (0.5 + length);
  for (const LabelLine& one : a.lines)
    for (const LabelLine& other : b.lines)
      if (cross(one, other)) cost += kCrossing;
  return cost;
}

// Length of a line that lies upon another.
double shared(const LabelLine& line, const LabelLine& other) {
  const Vec2 way = line.second - line.first;
  const double length = glm::length(way);
  if (!(length > 0)) return 0;
  const Vec2 along = way / length, across(-along.y, along.x);
  const Vec2 from = other.first - line.first, to = other.second - line.first;
  if (std::max(std::abs(glm::dot(from, across)), std::abs(glm::dot(to, across))) > kUpon) return 0;
  const double a = glm::dot(from, along), b = glm::dot(to, along);
  return std::max(0.0, std::min(length, std::max(a, b)) - std::max(0.0, std::min(a, b)));
}

double off_paper(const SheetBox& box, const LabelObstacles& obstacles) {
  const double outside = std::max({0.0, -box.lo.x, -box.lo.y, box.hi.x - obstacles.width, box.hi.y - obstacles.height});
  return outside > kTextBorder ? kOffPaper * (1 + outside) : 0;
}

// Of lines and signs under a text, which has this box where it is turned level about its beginning.
double covering(const SheetText& text, const SheetBox& level, const LabelObstacles& obstacles) {
  const Vec2 along(std::cos(text.angle), std::sin(text.angle)), down(-along.y, along.x);
  const auto turned = [&](const Vec2& point) {
    const Vec2 off = point - text.at;
    return text.angle == 0 ? point : text.at + off.x * along + off.y * down;
  };
  double cost = 0;
  for (const LabelLine& line : obstacles.segments) {
    const Vec2 from = turned(line.first), to = turned(line.second);
    if (std::max(from.x, to.x) < level.lo.x || std::min(from.x, to.x) > level.hi.x ||
        std::max(from.y, to.y) < level.lo.y || std::min(from.y, to.y) > level.hi.y)
      continue;
    if (const double length = covered(level, from, to); length > 0) cost += kOnLine * (0.5 + length);
  }
  for (const auto& [place, radius] : obstacles.discs) {
    const Vec2 center = turned(place);
    const Vec2 near(std::clamp(center.x, level.lo.x, level.hi.x), std::clamp(center.y, level.lo.y, level.hi.y));
    if (const double gap = glm::length(near - center) - radius; gap < 0) cost += kOnSign * (0.2 - gap);
  }
  return cost;
}

// A line that lies upon another would be taken for a part of it.
double continuing(const LabelLine& line, const LabelObstacles& obstacles) {
  double length = 0, cost = 0;
  for (const LabelLine& other : obstacles.segments) {
    length += shared(line, other);
    if (cross(line, other)) cost += kOverLine;
  }
  return length > kUpon ? cost + kOnText : cost;
}

std::vector<Candidate> candidates(const Label& label, const LabelObstacles& obstacles) {
  std::vector<Candidate> result;
  SheetText there = label.text, level = label.text;
  level.angle = 0;
  const auto add_at = [&](const LabelSpot& spot, double alignment, double liked) {
    there.at = spot.at;
    Candidate one{spot.at, alignment, liked, boxes_of(there, spot.border), spot.lines};
    for (const SheetBox& box : one.boxes) one.cost += off_paper(box, obstacles);
    level.at = spot.at;
    one.cost += covering(there, with_border(box_of(level), spot.border), obstacles);
    for (const LabelLine& line : spot.lines) one.cost += continuing(line, obstacles);
    result.push_back(std::move(one));
  };
  const auto add = [&](const Vec2& point, const Vec2& way, double distance, double liked,
                       const std::vector<LabelLine>& lines = {}) {
    const LabelSpot spot{baseline(label.text, point, way, distance), "here", 0, lines};
    add_at(spot, way.x > 0 ? 0 : way.x < 0 ? 1 : 0.5, liked);
  };
  if (label.side == "here") {
    add_at({label.text.at}, label.text.alignment, 0);
  } else if (!label.side.empty()) {
    add(label.at, direction_of_side(label.side), label.distance, 0);
  } else if (!label.spots.empty()) {
    for (size_t k = 0; k < label.spots.size(); ++k) {
      const LabelSpot& spot = label.spots[k];
      const double liked = kNextSpot * static_cast<double>(k);
      if (spot.side == "here")
        add_at(spot, label.text.alignment, liked);
      else
        add(spot.at, direction_of_side(spot.side), spot.distance, liked, spot.lines);
    }
  } else {
    const std::vector<double> steps =
        label.leader ? std::vector<double>{5, 7, 10, 14, 19, 25} : std::vector<double>{0, 0.5, 1.2, 2.2, 3.5};
    for (size_t step = 0; step < steps.size(); ++step)
      for (size_t k = 0; k < kDirections.size(); ++k)
        add(label.at, kDirections[k].way, label.distance + steps[step],
            kFarther * static_cast<double>(step) * (1 + step) + 0.05 * k);
  }
  return result;
}

}  // namespace

Vec2 direction_of_side(std::string_view side) {
  for (const Direction& one : kDirections)
    if (one.side == side) return one.way;
  return Vec2(0);  // center
}

namespace {

class Placement {
 public:
  explicit Placement(std::vector<std::vector<Candidate>> all)
      : all_(std::move(all)), chosen_(all_.size(), 0), placed_(all_.size(), false) {}

  const Candidate& chosen(size_t label) const { return all_[label][chosen_[label]]; }
  bool has_choice(size_t label) const { return all_[label].size() > 1; }

  void choose(size_t label) {
    chosen_[label] = best(label).place;
    placed_[label] = true;
  }

  // The place of a label with lines that fares badly because of one other, and a place for that one, where they fare
  // better together. Without lines, texts that changed places would seem to speak of one another's points.
  void choose_with_another(size_t label) {
    if (chosen(label).lines.empty()) return;
    const double now = cost(label, chosen_[label], kNone);
    if (now < kBad) return;
    const size_t before = chosen_[label];
    for (size_t k = 0; k < all_[label].size(); ++k) {
      const size_t other = only_obstacle(label, k);
      if (other == kNone) continue;
      const double both = now + cost(other, chosen_[other], label);
      chosen_[label] = k;
      const Best moved = best(other);
      if (cost(label, k, other) + moved.cost < both) {
        chosen_[other] = moved.place;
        return;
      }
      chosen_[label] = before;
    }
  }

 private:
  static constexpr size_t kNone = static_cast<size_t>(-1);
  struct Best {
    size_t place;
    double cost;
  };

  Best best(size_t label) const {
    Best found{chosen_[label], geometry::kInfinity};
    for (size_t k = 0; k < all_[label].size(); ++k)
      if (const double here = cost(label, k, kNone, found.cost); here < found.cost) found = {k, here};
    return found;
  }

  // Of a label in a place, given the others' but for one; no more than is asked for of what costs `enough`.
  double cost(size_t label, size_t place, size_t but, double enough = geometry::kInfinity) const {
    const Candidate& one = all_[label][place];
    double sum = one.cost;
    for (size_t j = 0; j < all_.size() && sum < enough; ++j)
      if (j != label && j != but && placed_[j]) sum += cost_of(one, chosen(j));
    return sum;
  }

  // The one other label that has a choice and is in the way of this place.
  size_t only_obstacle(size_t label, size_t place) const {
    size_t found = kNone;
    for (size_t j = 0; j < all_.size(); ++j) {
      if (j == label || !(cost_of(all_[label][place], chosen(j)) > 0)) continue;
      if (found != kNone || !has_choice(j)) return kNone;
      found = j;
    }
    return found;
  }

  std::vector<std::vector<Candidate>> all_;
  std::vector<size_t> chosen_;
  std::vector<bool> placed_;
};

}  // namespace

void place_labels(std::vector<Label>& labels, const LabelObstacles& obstacles) {
  std::vector<std::vector<Candidate>> all;
  for (const Label& label : labels) all.push_back(candidates(label, obstacles));
  Placement placement(std::move(all));
  // Those without a choice first.
  std::vector<size_t> order(labels.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return !placement.has_choice(a) && placement.has_choice(b); });
  for (int round = 0; round < kRounds; ++round)
    for (const size_t i : order) placement.choose(i);
  for (const size_t i : order) placement.choose_with_another(i);
  for (size_t i = 0; i < labels.size(); ++i) {
    const Candidate& there = placement.chosen(i);
    labels[i].text.at = there.at;
    labels[i].text.alignment = there.alignment;
    labels[i].lines = there.lines;
  }
}

bool is_free(const SheetBox& box, const LabelObstacles& obstacles) {
  const auto touches = [&](const std::pair<Vec2, double>& disc) {
    return glm::length(glm::clamp(disc.first, box.lo, box.hi) - disc.first) < disc.second;
  };
  return std::none_of(obstacles.segments.begin(), obstacles.segments.end(),
                      [&](const LabelLine& line) { return covered(box, line.first, line.second) > 0; }) &&
         std::none_of(obstacles.discs.begin(), obstacles.discs.end(), touches);
}

SheetGroup drawn_label(const Label& label) {
  SheetGroup group;
  group.kind = label.kind, group.object = label.object;
  const SheetBox box = with_border(box_of(label.text), kTextBorder);
  if (label.leader) {
    // To the nearest point of the text's box.
    const Vec2 near(std::clamp(label.at.x, box.lo.x, box.hi.x), std::clamp(label.at.y, box.lo.y, box.hi.y));
    SheetPath path;
    path.parts = {straight_path({near, label.at})};
    path.pen = label.leader;
    group.items.push_back(path);
  }
  for (const auto& [from, to] : label.lines) group.items.emplace_back(drawn(straight_path({from, to}), label.pen));
  if (label.box && label.text.angle == 0) {
    SheetPath path;
    path.parts = {straight_path({box.lo, {box.hi.x, box.lo.y}, box.hi, {box.lo.x, box.hi.y}}, true)};
    path.brush = label.box;
    group.items.push_back(path);
  }
  group.items.push_back(label.text);
  return group;
}

}  // namespace lekalo::render
