// The order in which holes are drilled (Zavyalov et al. 1985, V.3): from one to the nearest that is left, then parts of
// the way turned round as long as that makes it shorter (2-opt, Croes 1958).
#pragma once

#include <vector>

#include "geometry/vectors.h"

namespace lekalo::geometry {

struct DrillingTask {
  std::vector<Vec3> holes;
  std::vector<int> tools;  // of the holes; none: one for all
  double speed = 1;        // of moves
  double tool_change = 0;  // time
  bool closed = false;     // the way leads back to the first hole
  int start = 0;           // the first hole

  // Move and change of tools from one hole to another.
  double time(int from, int to) const;
  double time(const std::vector<int>& order) const;
  int tool_changes(const std::vector<int>& order) const;
};

std::vector<int> nearest_order(const DrillingTask& task);
// Never takes longer than the order it begins with; the first hole stays the first.
std::vector<int> two_opt(const DrillingTask& task, std::vector<int> order);

struct DrillingPlan {
  DrillingTask task;
  std::vector<int> nearest, order;
};

}  // namespace lekalo::geometry
