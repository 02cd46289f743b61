// Lines that lie on one another in the picture are drawn once.
//
// Of a straight line what others cover is cut away; of a curve the whole, if others cover all of it. Visible lines come
// before hidden ones, and lines of an earlier object before those of a later one.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "render/drawing/paths.h"

namespace lekalo::render {

class Overlaps {
 public:
  // What of the path is not drawn yet, in order; it counts as drawn then. Millimetres.
  std::vector<Path> left_of(const Path& path);

 private:
  struct Drawn {
    Vec2 lo, hi;
    bool straight;
    std::vector<Vec2> places;  // of a curve, close together
    Vec2 from{0}, to{0};       // of a straight line
  };
  static std::vector<Vec2> places_on(const Path& path);
  bool is_covered(const Vec2& place) const;
  // What was drawn near a place; near some line, each once.
  const std::vector<int>& near(const Vec2& place) const;
  std::vector<int> near(const std::vector<Vec2>& places) const;

  std::vector<Drawn> drawn_;
  std::unordered_map<int64_t, std::vector<int>> bins_;  // of those near a square of the page, by their numbers
};

}  // namespace lekalo::render
