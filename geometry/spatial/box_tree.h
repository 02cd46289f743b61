// A small bounding-volume hierarchy in double precision for the queries of the geometry library.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/numerics/interval.h"
#include "geometry/spatial/line_through_boxes.h"
#include "geometry/vectors.h"

namespace lekalo::geometry {

class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(const std::vector<Box3>& boxes);

  // Calls visit(index) for every box that the line meets with t in the interval.
  template <class Visit>
  void along(const Line& line, const Interval& t, Visit&& visit) const {
    if (!nodes_.empty()) along(LineThroughBoxes(line, farthest_), t, visit);
  }
  template <class Visit>
  void along(const LineThroughBoxes& line, const Interval& t, Visit&& visit) const {
    if (nodes_.empty()) return;
    int stack[64];
    int top = 0;
    stack[top++] = 0;
    while (top > 0) {
      const Node& node = nodes_[stack[--top]];
      if (!line.meets(node.box, t)) continue;
      if (node.count > 0) {
        for (int i = 0; i < node.count; ++i) {
          const int item = order_[node.first + i];
          if (node.count == 1 || line.meets(boxes_[item], t)) visit(item);
        }
      } else {
        stack[top++] = node.first;
        stack[top++] = node.first + 1;
      }
    }
  }

  // Calls visit(index) for every box that meets the one given.
  template <class Visit>
  void around(const Box3& box, Visit&& visit) const {
    if (nodes_.empty()) return;
    int stack[64];
    int top = 0;
    stack[top++] = 0;
    while (top > 0) {
      const Node& node = nodes_[stack[--top]];
      if (!meets(node.box, box)) continue;
      if (node.count > 0) {
        for (int i = 0; i < node.count; ++i) {
          const int item = order_[node.first + i];
          if (node.count == 1 || meets(boxes_[item], box)) visit(item);
        }
      } else {
        stack[top++] = node.first;
        stack[top++] = node.first + 1;
      }
    }
  }
  static bool meets(const Box3& a, const Box3& b) {
    for (int k = 0; k < 3; ++k)
      if (a.lo[k] > b.hi[k] || b.lo[k] > a.hi[k]) return false;
    return true;
  }
  // The largest of the coordinates that are bounded, 0 without one.
  static double farthest(const Box3& box) {
    double result = 0;
    for (int k = 0; k < 3; ++k)
      for (const double x : {std::abs(box.lo[k]), std::abs(box.hi[k])})
        if (x < kInfinity) result = std::max(result, x);
    return result;
  }

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
  double farthest_ = 0;  // coordinate of its boxes
};

}  // namespace lekalo::geometry
