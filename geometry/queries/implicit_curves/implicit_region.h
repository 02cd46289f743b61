// Where an implicit surface is looked for.
#pragma once

#include "geometry/vectors.h"

namespace lekalo::geometry {

// A box, or the ball inside it.
struct ImplicitRegion {
  Box3 box;
  bool is_ball = false;

  static ImplicitRegion ball(const Vec3& center, double radius) {
    return {{center - Vec3(radius), center + Vec3(radius)}, true};
  }
  double radius() const { return 0.5 * (box.hi.x - box.lo.x); }
  // Whether a box holds nothing of the region.
  bool misses(const Box3& other) const;
};

}  // namespace lekalo::geometry
