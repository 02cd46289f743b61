#include "geometry/queries/closest/distance_pairs.h"

#include <algorithm>

namespace lekalo::geometry {

namespace {

double distance_of(const Box3& a, const Box3& b) {
  return glm::length(glm::max(glm::max(a.lo - b.hi, b.lo - a.hi), Vec3(0)));
}

}  // namespace

std::vector<NearestPairs::Node> NearestPairs::tree_of(const DistanceElements& elements) {
  std::vector<const DistanceElement*> order;
  for (const auto& element : elements) order.push_back(element.get());
  std::vector<Node> nodes(1);
  nodes.reserve(2 * order.size());
  struct Part {
    int node;
    size_t begin, end;
  };
  std::vector<Part> parts{{0, 0, order.size()}};
  while (!parts.empty()) {
    const Part part = parts.back();
    parts.pop_back();
    Box3 box;
    for (size_t k = part.begin; k < part.end; ++k) box.include(order[k]->box);
    nodes[part.node].box = box;
    if (part.end - part.begin == 1) {
      nodes[part.node].element = order[part.begin];
      continue;
    }
    const Vec3 size = box.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const size_t middle = (part.begin + part.end) / 2;
    const auto at = [&](size_t k) { return order.begin() + static_cast<std::ptrdiff_t>(k); };
    std::nth_element(at(part.begin), at(middle), at(part.end),
                     [&](const auto* x, const auto* y) { return x->box.center()[axis] < y->box.center()[axis]; });
    const int child = static_cast<int>(nodes.size());
    nodes[part.node].first_child = child;
    nodes.resize(nodes.size() + 2);
    parts.push_back({child, part.begin, middle});
    parts.push_back({child + 1, middle, part.end});
  }
  return nodes;
}

NearestPairs::NearestPairs(const DistanceElements& a, const DistanceElements& b) : a_(tree_of(a)), b_(tree_of(b)) {
  add(0, 0);
}

void NearestPairs::add(int a, int b) {
  const Node &x = a_[a], &y = b_[b];
  const int unknowns = x.element && y.element ? x.element->dimension + y.element->dimension : -1;
  queue_.push({distance_of(x.box, y.box), unknowns, a, b});
}

std::optional<ElementPair> NearestPairs::next() {
  while (!queue_.empty()) {
    const Waiting one = queue_.top();
    queue_.pop();
    const Node &a = a_[one.a], &b = b_[one.b];
    if (a.element && b.element) return ElementPair{a.element, b.element, one.from};
    // The larger one is opened.
    const bool open_a = !a.element && (b.element || a.box.diameter() >= b.box.diameter());
    for (const int child : {0, 1}) open_a ? add(a.first_child + child, one.b) : add(one.a, b.first_child + child);
  }
  return std::nullopt;
}

}  // namespace lekalo::geometry
