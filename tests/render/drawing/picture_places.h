// Points in a picture, found again by place.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "geometry/vectors.h"

namespace lekalo::render {

// In fine pixels; places farther than two or three are infinitely far.
class Places {
 public:
  void add(const geometry::Vec2& p) { cells_[key(p, 0, 0)].push_back(p); }
  double distance(const geometry::Vec2& q) const {
    double least = geometry::kInfinity;
    for (int i = -2; i <= 2; ++i)
      for (int j = -2; j <= 2; ++j)
        if (const auto cell = cells_.find(key(q, i, j)); cell != cells_.end())
          for (const geometry::Vec2& p : cell->second) least = std::min(least, glm::length(p - q));
    return least;
  }

 private:
  static std::pair<int, int> key(const geometry::Vec2& p, int i, int j) {
    return {static_cast<int>(std::floor(p.x)) + i, static_cast<int>(std::floor(p.y)) + j};
  }
  std::map<std::pair<int, int>, std::vector<geometry::Vec2>> cells_;
};

}  // namespace lekalo::render
