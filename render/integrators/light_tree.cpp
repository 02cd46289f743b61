#include "render/integrators/light_tree.h"

#include <algorithm>
#include <any>
#include <cmath>

#include "render/lights/lights.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// Lamps of a leaf at most.
constexpr size_t kLeafLamps = 8;
// Light that leaves a lamp at an angle counts at least as this much of that along its axis: spots are full to the rim.
constexpr double kMinCosine = 0.1;
// Of angles, so that rounding excludes nothing.
constexpr double kSlack = 1e-6;

// A node is split where its ball's radius is more than this times the distance of its middle.
constexpr double kNear = 0.5;

double largest(const Lamp& lamp) { return kPi * lamp.intensity * std::max({lamp.color.x, lamp.color.y, lamp.color.z}); }

double angle_between(const Vec3& a, const Vec3& b) { return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0)); }

Vec3 perpendicular(const Vec3& axis) { return frame_about(Vec3(0), axis).x; }

struct Directions {
  Vec3 axis;
  double opening;
};

// The narrowest cone about two: it reaches from the far rim of one to that of the other.
Directions hull(const Directions& a, const Directions& b) {
  const Directions &wide = a.opening >= b.opening ? a : b, &slim = a.opening >= b.opening ? b : a;
  const double between = angle_between(wide.axis, slim.axis);
  if (std::min(between + slim.opening, kPi) <= wide.opening) return wide;
  const double opening = 0.5 * (wide.opening + between + slim.opening);
  if (opening >= kPi) return {wide.axis, kPi};
  const Vec3 off = slim.axis - glm::dot(slim.axis, wide.axis) * wide.axis;
  const double length = glm::length(off);
  const Vec3 side = length > 1e-9 ? off / length : perpendicular(wide.axis);
  const double turn = opening - wide.opening;
  return {glm::normalize(std::cos(turn) * wide.axis + std::sin(turn) * side), opening};
}

}  // namespace

// Nothing for lamps that are nowhere, or not of those that lights.h knows.
std::optional<LightTree::Node> LightTree::placed(const Light& lamp) {
  Node node;
  const std::any made = lamp.made_from();
  const auto place = [&](const Vec3& position) { node.box.include(position); };
  const auto shine = [&](const Lamp& values) { (values.inverse_square ? node.falling : node.even) = largest(values); };
  const auto point_along = [&](const Vec3& axis, double spread) {
    node.axis = axis;
    node.opening = 0;
    node.spread = spread;
  };
  const auto lie_flat = [&](const auto& area) {
    node.box = lamp.places();
    shine(area.lamp);
    if (area.one_sided) point_along(area.frame.z, kPi / 2);
  };
  if (const auto* point = std::any_cast<PointLight>(&made)) {
    place(point->position);
    shine(point->lamp);
  } else if (const auto* spot = std::any_cast<SpotLight>(&made)) {
    place(spot->position);
    shine(spot->lamp);
    point_along(spot->direction, spot->angle);
  } else if (const auto* profile = std::any_cast<ProfileLight>(&made)) {
    place(profile->frame.origin);
    shine(profile->lamp);
  } else if (const auto* ball = std::any_cast<SphereLight>(&made)) {
    node.box = lamp.places();
    shine(ball->lamp);
  } else if (const auto* rectangle = std::any_cast<RectangleLight>(&made)) {
    lie_flat(*rectangle);
  } else if (const auto* disc = std::any_cast<DiscLight>(&made)) {
    lie_flat(*disc);
  } else {
    return std::nullopt;
  }
  return node;
}

LightTree::LightTree(const World& world) : world_(world), min_square_(1e-12 * world.radius() * world.radius()) {
  std::vector<Node> leaves;
  const size_t lamps = world.lamps().size();
  for (size_t i = 0; i < lamps; ++i) {
    if (std::optional<Node> node = placed(*world.lamps()[i])) {
      node->first = i;
      leaves.push_back(*node);
    } else {
      apart_.push_back(i);
    }
  }
  for (size_t i = 0; i < world.glows().size(); ++i) {
    const World::Glow& glow = world.glows()[i];
    Node node;
    node.box.include(glow.center - glow.radius);
    node.box.include(glow.center + glow.radius);
    node.falling = kPi * glow.radius * glow.radius * static_cast<double>(glow.brightness);
    node.first = lamps + i;
    leaves.push_back(node);
  }
  leaf_of_.assign(lamps + world.glows().size(), -1);
  nodes_.reserve(2 * leaves.size());
  if (!leaves.empty()) build(leaves, 0, leaves.size());
}

LightTree::Node LightTree::merged(const Node& a, const Node& b) {
  Node node;
  node.box = a.box;
  node.box.include(b.box);
  const Directions directions = hull({a.axis, a.opening}, {b.axis, b.opening});
  node.axis = directions.axis;
  node.opening = directions.opening;
  node.spread = std::max(a.spread, b.spread);
  node.even = a.even + b.even;
  node.falling = a.falling + b.falling;
  return node;
}

// Strength times the size of the box times the measure of directions (Conty Estevez, Kulla, 4.4). The size is that of
// the diagonal: lamps that are points have no area.
double LightTree::cost(const Node& node) {
  const double o = node.opening, w = std::min(o + node.spread, kPi);
  const double directions = kTwoPi * (1 - std::cos(o)) +
                            kPi / 2 * (2 * w * std::sin(o) - std::cos(o - 2 * w) - 2 * o * std::sin(o) + std::cos(o));
  const double diagonal = node.box.diameter();
  return (node.even + node.falling) * diagonal * diagonal * directions;
}

// The leaves are one lamp each, their number in `first`; those that the tree has hold more.
int LightTree::build(std::vector<Node>& leaves, size_t begin, size_t end) {
  const int at = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  if (end - begin <= kLeafLamps) {
    Node all = leaves[begin];
    for (size_t i = begin + 1; i < end; ++i) all = merged(all, leaves[i]);
    all.first = numbers_.size();
    all.count = end - begin;
    for (size_t i = begin; i < end; ++i) {
      numbers_.push_back(leaves[i].first);
      leaf_of_[leaves[i].first] = at;
    }
    nodes_[at] = all;
    return at;
  }
  const size_t middle = best_split(leaves, begin, end);
  const int left = build(leaves, begin, middle), right = build(leaves, middle, end);
  nodes_[at] = merged(nodes_[left], nodes_[right]);
  nodes_[at].left = left;
  nodes_[at].right = right;
  nodes_[left].parent = nodes_[right].parent = at;
  return at;
}

// Sorts the leaves by the best of the three axes. Of splits alike, the one nearest to the middle: so the tree of lamps
// at one place is not deep.
size_t LightTree::best_split(std::vector<Node>& leaves, size_t begin, size_t end) const {
  const size_t count = end - begin;
  const auto sort_along = [&](int axis) {
    std::sort(leaves.begin() + begin, leaves.begin() + end, [axis](const Node& a, const Node& b) {
      const double x = a.box.center()[axis], y = b.box.center()[axis];
      return x < y || (x == y && a.first < b.first);
    });
  };
  double best = kInfinity;
  size_t best_from_middle = 0, best_middle = begin + count / 2;
  int best_axis = 0;
  std::vector<double> behind(count);  // cost of the leaves from each on
  for (int axis = 0; axis < 3; ++axis) {
    sort_along(axis);
    Node all = leaves[end - 1];
    for (size_t i = count; i-- > 1;) {
      if (i + 1 < count) all = merged(leaves[begin + i], all);
      behind[i] = cost(all);
    }
    all = leaves[begin];
    for (size_t i = 1; i < count; ++i) {
      if (i > 1) all = merged(all, leaves[begin + i - 1]);
      const double sum = cost(all) + behind[i];
      const size_t from_middle = i > count / 2 ? i - count / 2 : count / 2 - i;
      if (sum > best || (sum == best && from_middle >= best_from_middle)) continue;
      best = sum;
      best_from_middle = from_middle;
      best_middle = begin + i;
      best_axis = axis;
    }
  }
  sort_along(best_axis);
  return best_middle;
}

// About the irradiance that the node's lamps bring; 0 only if they surely bring none.
double LightTree::importance(const Node& node, const Vec3& point) const {
  const Vec3 to_point = point - node.box.center();
  const double radius = 0.5 * node.box.diameter(), square = glm::dot(to_point, to_point);
  const double power = node.even + node.falling / std::max({square, radius * radius, min_square_});
  if (node.opening + node.spread >= kPi || square <= radius * radius) return power;
  const double distance = std::sqrt(square);
  const double seen = std::asin(std::min(1.0, radius / distance));  // half the angle under which the box is seen
  const double off = angle_between(node.axis, to_point / distance) - node.opening - seen - kSlack;
  if (off >= node.spread) return 0;
  return power * std::max(std::cos(std::max(off, 0.0)), kMinCosine);
}

double LightTree::left_share(const Node& node, const Vec3& point) const {
  const double left = importance(nodes_[node.left], point), right = importance(nodes_[node.right], point);
  return left + right > 0 ? left / (left + right) : 0.5;
}

double LightTree::brings(size_t number, const Vec3& point) const {
  const size_t lamps = world_.lamps().size();
  if (number >= lamps) {
    const World::Glow& glow = world_.glows()[number - lamps];
    const Vec3 to = glow.center - point;
    const double square = glow.radius * glow.radius;
    return kPi * static_cast<double>(glow.brightness) * square / std::max(glm::dot(to, to), square);
  }
  const double brings = world_.lamps()[number]->sample_all(point, Vec2(0.5)).irradiance.largest();
  return std::isfinite(brings) ? brings : 0;
}

void LightTree::add_lamps(const Node& leaf, const Vec3& point, std::vector<Candidate>& list) const {
  for (size_t i = leaf.first; i < leaf.first + leaf.count; ++i)
    list.push_back({-1, numbers_[i], brings(numbers_[i], point)});
}

std::vector<LightTree::Candidate> LightTree::candidates(const Vec3& point) const {
  std::vector<Candidate> list;
  for (const size_t lamp : apart_) list.push_back({-1, lamp, brings(lamp, point)});
  std::vector<int> open;
  if (!nodes_.empty()) open.push_back(0);
  while (!open.empty()) {
    const int at = open.back();
    const Node& node = nodes_[at];
    open.pop_back();
    const double weight = importance(node, point);
    if (weight == 0) continue;
    const Vec3 to = node.box.center() - point;
    const double reach = 0.5 * node.box.diameter();
    if (reach * reach <= kNear * kNear * glm::dot(to, to)) {
      list.push_back({at, 0, weight});
    } else if (node.left < 0) {
      add_lamps(node, point, list);
    } else {
      open.push_back(node.right);
      open.push_back(node.left);
    }
  }
  share_out(list);
  return list;
}

std::vector<LightTree::Candidate> LightTree::lamps_of(const Node& leaf, const Vec3& point) const {
  std::vector<Candidate> list;
  add_lamps(leaf, point, list);
  share_out(list);
  return list;
}

std::optional<LightTree::Choice> LightTree::choose(const Vec3& point, double random) const {
  const std::vector<Candidate> list = candidates(point);
  if (list.empty()) return std::nullopt;
  const Candidate& first = chosen_of(list, random);
  if (first.node < 0) return Choice{first.number, first.probability};
  double probability = first.probability;
  const Node* node = &nodes_[first.node];
  while (node->left >= 0) {
    const double share = left_share(*node, point);
    const bool left = random < share;
    random = std::min(left ? random / share : (random - share) / (1 - share), kBelowOne);
    probability *= left ? share : 1 - share;
    node = &nodes_[left ? node->left : node->right];
  }
  const std::vector<Candidate> lamps = lamps_of(*node, point);
  const Candidate& lamp = chosen_of(lamps, random);
  return Choice{lamp.number, probability * lamp.probability};
}

double LightTree::probability(const Vec3& point, size_t number) const {
  const std::vector<Candidate> list = candidates(point);
  const auto of_lamp = [&](const std::vector<Candidate>& lamps) -> const Candidate* {
    for (const Candidate& one : lamps)
      if (one.node < 0 && one.number == number) return &one;
    return nullptr;
  };
  if (const Candidate* alone = of_lamp(list)) return alone->probability;
  int at = leaf_of_[number];
  if (at < 0) return 0;
  double below = of_lamp(lamps_of(nodes_[at], point))->probability;
  for (;;) {
    for (const Candidate& one : list)
      if (one.node == at) return below * one.probability;
    const int above = nodes_[at].parent;
    if (above < 0) return 0;
    const double share = left_share(nodes_[above], point);
    below *= nodes_[above].left == at ? share : 1 - share;
    at = above;
  }
}

std::shared_ptr<const LightTree> make_light_tree(const World& world) {
  if (world.lamps().size() + world.glows().size() <= kManyLamps) return nullptr;
  return std::make_shared<LightTree>(world);
}

}  // namespace lekalo::render
