// What may stand in the way of many shadow rays from one point to one light.
#pragma once

#include <cstdint>

namespace lekalo::render {

// Made and read by Hierarchy: members of its lists of few and unbounded things by bit (the last bit stands for all from
// the 64th on), and its Embree scene. At first everything.
struct Obstacles {
  uint64_t listed = ~uint64_t{0};
  bool scene = true;
  bool none() const { return listed == 0 && !scene; }
};

}  // namespace lekalo::render
