#include "geometry/queries/box_tree.h"

#include <algorithm>
#include <cmath>

namespace lekalo::geometry {

BoxTree::BoxTree(const std::vector<Box3>& boxes) : boxes_(boxes) {
  for (int i = 0; i < static_cast<int>(boxes.size()); ++i)
    if (!boxes[i].empty()) order_.push_back(i);
  if (order_.empty()) return;
  nodes_.reserve(2 * order_.size());
  nodes_.emplace_back();
  build(0, 0, static_cast<int>(order_.size()));
}

void BoxTree::build(int node, int begin, int end) {
  Box3 box, centers;
  for (int i = begin; i < end; ++i) {
    box.include(boxes_[order_[i]]);
    if (boxes_[order_[i]].bounded()) centers.include(boxes_[order_[i]].center());
  }
  nodes_[node].box = box;
  if (end - begin <= 2) {
    nodes_[node].first = begin;
    nodes_[node].count = end - begin;
    return;
  }
  // Median cuts keep the depth below 32 for any input (the traversal's stack has room for 64); boxes whose centres
  // cannot be told apart are cut by number.
  const Vec3 size = centers.empty() ? Vec3(0) : centers.size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const int middle = (begin + end) / 2;
  const auto key = [&](int i) { return boxes_[i].bounded() ? boxes_[i].center()[axis] : 0.0; };
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](int a, int b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
  const int children = static_cast<int>(nodes_.size());
  nodes_[node].first = children;
  nodes_.emplace_back();
  nodes_.emplace_back();
  build(children, begin, middle);
  build(children + 1, middle, end);
}

bool BoxTree::meets(const Box3& box, const Line& line, const Interval& t) {
  double enter = t.lo, leave = t.hi;
  for (int k = 0; k < 3; ++k) {
    const double o = line.origin[k], d = line.direction[k];
    // The slack covers the rounding of the differences and quotients below.
    const double slack = 4e-16 * (std::abs(o) + std::max(std::abs(box.lo[k]), std::abs(box.hi[k])));
    if (d == 0) {
      if (o < box.lo[k] - slack || o > box.hi[k] + slack) return false;
      continue;
    }
    double a = (box.lo[k] - slack - o) / d, b = (box.hi[k] + slack - o) / d;
    if (a > b) std::swap(a, b);
    const double pad = 4e-16 * std::max(std::abs(a), std::abs(b));
    if (std::isfinite(a)) enter = std::max(enter, a - (std::isfinite(pad) ? pad : 0));
    if (std::isfinite(b)) leave = std::min(leave, b + (std::isfinite(pad) ? pad : 0));
    if (enter > leave) return false;
  }
  return true;
}

}  // namespace lekalo::geometry
