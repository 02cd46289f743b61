#include "render/drawing/label_placement.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/drawing/text_layout.h"
#include "render/drawing/view.h"

namespace lekalo::render {

namespace {

// Costs by what they are for; those of lines and texts grow with what is covered, in millimetres.
constexpr double kOnText = 60, kOffPaper = 60, kOnLine = 3, kOnSign = 12;
constexpr double kFarther = 0.5;   // for each step away from the point
constexpr double kNextSpot = 0.1;  // for each place that is liked better
constexpr int kRounds = 4;
constexpr double kFree = 0.35;  // millimetres around a text that are its own

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

SheetBox with_border(const SheetBox& box) { return {box.lo - kFree, box.hi + kFree}; }

// What the text takes: its box or, where it is turned, the boxes of pieces of it about as long as high.
std::vector<SheetBox> boxes_of(const SheetText& text) {
  const double height = text.ascent + text.descent;
  const int pieces = text.angle != 0 && height > 0 ? std::max(1, static_cast<int>(std::ceil(text.width / height))) : 1;
  std::vector<SheetBox> boxes;
  for (int k = 0; k < pieces; ++k)
    boxes.push_back(with_border(box_of(text, static_cast<double>(k) / pieces, static_cast<double>(k + 1) / pieces)));
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
};

double fixed_cost(const SheetBox& box, const LabelObstacles& obstacles) {
  double cost = 0;
  const double outside = std::max({0.0, -box.lo.x, -box.lo.y, box.hi.x - obstacles.width, box.hi.y - obstacles.height});
  if (outside > kFree) cost += kOffPaper * (1 + outside);
  for (const auto& [from, to] : obstacles.segments) {
    if (std::max(from.x, to.x) < box.lo.x || std::min(from.x, to.x) > box.hi.x || std::max(from.y, to.y) < box.lo.y ||
        std::min(from.y, to.y) > box.hi.y)
      continue;
    if (const double length = covered(box, from, to); length > 0) cost += kOnLine * (0.5 + length);
  }
  for (const auto& [center, radius] : obstacles.discs) {
    const Vec2 near(std::clamp(center.x, box.lo.x, box.hi.x), std::clamp(center.y, box.lo.y, box.hi.y));
    if (const double gap = glm::length(near - center) - radius; gap < 0) cost += kOnSign * (0.2 - gap);
  }
  return cost;
}

std::vector<Candidate> candidates(const Label& label, const LabelObstacles& obstacles) {
  std::vector<Candidate> result;
  SheetText there = label.text;
  const auto add_at = [&](const Vec2& at, double alignment, double liked) {
    there.at = at;
    Candidate one{at, alignment, liked, boxes_of(there)};
    for (const SheetBox& box : one.boxes) one.cost += fixed_cost(box, obstacles);
    result.push_back(std::move(one));
  };
  const auto add = [&](const Vec2& point, const Vec2& way, double distance, double liked) {
    add_at(baseline(label.text, point, way, distance), way.x > 0 ? 0 : way.x < 0 ? 1 : 0.5, liked);
  };
  if (label.side == "here") {
    add_at(label.text.at, label.text.alignment, 0);
  } else if (!label.side.empty()) {
    add(label.at, direction_of_side(label.side), label.distance, 0);
  } else if (!label.spots.empty()) {
    for (size_t k = 0; k < label.spots.size(); ++k) {
      const LabelSpot& spot = label.spots[k];
      const double liked = kNextSpot * static_cast<double>(k);
      if (spot.side == "here")
        add_at(spot.at, label.text.alignment, liked);
      else
        add(spot.at, direction_of_side(spot.side), spot.distance, liked);
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

void place_labels(std::vector<Label>& labels, const LabelObstacles& obstacles) {
  std::vector<std::vector<Candidate>> all;
  std::vector<size_t> chosen(labels.size(), 0);
  std::vector<bool> placed(labels.size(), false);
  for (const Label& label : labels) all.push_back(candidates(label, obstacles));
  // Those without a choice first.
  std::vector<size_t> order(labels.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return (all[a].size() == 1) > (all[b].size() == 1); });
  for (int round = 0; round < kRounds; ++round)
    for (const size_t i : order) {
      double best = geometry::kInfinity;
      for (size_t k = 0; k < all[i].size(); ++k) {
        double cost = all[i][k].cost;
        for (size_t j = 0; j < labels.size() && cost < best; ++j)
          if (j != i && placed[j])
            if (const double over = overlap(all[i][k].boxes, all[j][chosen[j]].boxes); over > 0)
              cost += kOnText + kOnText * over;
        if (cost < best) best = cost, chosen[i] = k;
      }
      placed[i] = true;
    }
  for (size_t i = 0; i < labels.size(); ++i) {
    labels[i].text.at = all[i][chosen[i]].at;
    labels[i].text.alignment = all[i][chosen[i]].alignment;
  }
}

SheetGroup drawn_label(const Label& label) {
  SheetGroup group;
  group.kind = label.kind, group.object = label.object;
  const SheetBox box = with_border(box_of(label.text));
  if (label.leader) {
    // To the nearest point of the text's box.
    const Vec2 near(std::clamp(label.at.x, box.lo.x, box.hi.x), std::clamp(label.at.y, box.lo.y, box.hi.y));
    SheetPath path;
    path.parts = {straight_path({near, label.at})};
    path.pen = label.leader;
    group.items.push_back(path);
  }
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
