// A small bounding-volume hierarchy in double precision for the queries of the geometry library.
#pragma once

#include <vector>

#include "geometry/numerics/interval.h"
#include "geometry/vectors.h"

namespace lekalo::geometry {

class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(const std::vector<Box3>& boxes);

  // Calls visit(index) for every box that the line meets with t in the interval.
  template <class Visit>
  void along(const Line& line, const Interval& t, Visit&& visit) const {
    if (nodes_.empty()) return;
    int stack[64];
    int top = 0;
    stack[top++] = 0;
    while (top > 0) {
      const Node& node = nodes_[stack[--top]];
      if (!meets(node.box, line, t)) continue;
      if (node.count > 0) {
        for (int i = 0; i < node.count; ++i) {
          const int item = order_[node.first + i];
          if (node.count == 1 || meets(boxes_[item], line, t)) visit(item);
        }
      } else {
        stack[top++] = node.first;
        stack[top++] = node.first + 1;
      }
    }
  }

  // Whether the line meets the box with t in the interval; boxes are taken a rounding error larger.
  static bool meets(const Box3& box, const Line& line, const Interval& t);

 private:
  struct Node {
    Box3 box;
    int first = 0;  // first child, the second follows; or first entry of order_ in a leaf
    int count = 0;  // entries of a leaf, 0 for inner nodes
  };
  void build(int node, int begin, int end);

  std::vector<Box3> boxes_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace lekalo::geometry
