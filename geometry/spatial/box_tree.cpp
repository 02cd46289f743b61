#include "geometry/spatial/box_tree.h"

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
  farthest_ = farthest(nodes_[0].box);
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

}  // namespace lekalo::geometry
