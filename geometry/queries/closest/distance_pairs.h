// Pairs of elements in the order of the distances of their boxes, made one by one: far pairs are never made.
#pragma once

#include <optional>
#include <queue>
#include <vector>

#include "geometry/queries/closest/distance_search.h"

namespace lekalo::geometry {

// Both lists outlive it and are not empty.
class NearestPairs {
 public:
  NearestPairs(const DistanceElements& a, const DistanceElements& b);
  // The next pair; of pairs as far the one with fewer parameters. None after the last.
  std::optional<ElementPair> next();

 private:
  // Boxes of elements, halved again and again along their longest side.
  struct Node {
    Box3 box;
    int first_child = -1;                      // the second follows; none of a leaf
    const DistanceElement* element = nullptr;  // of a leaf
  };
  struct Waiting {
    double from;
    int unknowns;  // -1 of nodes that are no leaves
    int a, b;
    bool operator<(const Waiting& other) const {
      return from != other.from ? from > other.from : unknowns > other.unknowns;
    }
  };
  static std::vector<Node> tree_of(const DistanceElements& elements);
  void add(int a, int b);

  std::vector<Node> a_, b_;
  std::priority_queue<Waiting> queue_;
};

}  // namespace lekalo::geometry
