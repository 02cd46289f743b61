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

  // A line with what every box asks for.
  struct LineToBoxes {
    Vec3 origin, direction, inverse;
    explicit LineToBoxes(const Line& line)
        : origin(line.origin), direction(line.direction), inverse(1.0 / line.direction) {}
  };

  // Calls visit(index) for every box that the line meets with t in the interval.
  template <class Visit>
  void along(const Line& line, const Interval& t, Visit&& visit) const {
    if (!nodes_.empty()) along(LineToBoxes(line), t, visit);
  }
  template <class Visit>
  void along(const LineToBoxes& line, const Interval& t, Visit&& visit) const {
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

  // Whether the line meets the box with t in the interval; boxes are taken a rounding error larger.
  static bool meets(const Box3& box, const LineToBoxes& line, const Interval& t) {
    double enter = t.lo, leave = t.hi;
    for (int k = 0; k < 3; ++k) {
      const double o = line.origin[k];
      // The slack covers the rounding of the differences below.
      const double slack = 4e-16 * (std::abs(o) + std::max(std::abs(box.lo[k]), std::abs(box.hi[k])));
      const double lo = box.lo[k] - slack - o, hi = box.hi[k] + slack - o;
      if (line.direction[k] == 0) {
        if (lo > 0 || hi < 0) return false;
        continue;
      }
      const double a = lo * line.inverse[k], b = hi * line.inverse[k];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    // That of the products.
    return enter - 1e-15 * std::abs(enter) <= leave + 1e-15 * std::abs(leave);
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
};

}  // namespace lekalo::geometry
