// The eight corners of a box.
#pragma once

#include <array>

#include "geometry/vectors.h"

namespace lekalo::geometry {

// Corner k has the higher x where bit 1 of k is set, y for 2, z for 4.
inline std::array<Vec3, 8> corners(const Box3& box) {
  std::array<Vec3, 8> all;
  for (size_t k = 0; k < 8; ++k)
    all[k] = {k & 1 ? box.hi.x : box.lo.x, k & 2 ? box.hi.y : box.lo.y, k & 4 ? box.hi.z : box.lo.z};
  return all;
}

}  // namespace lekalo::geometry
