// The nearest of many points: a k-d tree (Bentley 1975). Immutable; safe to use from many threads.
#pragma once

#include <vector>

#include "geometry/vectors.h"

namespace lekalo::geometry {

class NearestPoints {
 public:
  // At least one point.
  explicit NearestPoints(std::vector<Vec3> points);
  // Of points as near as each other any.
  const Vec3& nearest(const Vec3& to) const;

 private:
  void sort(size_t begin, size_t end, int axis);
  void search(size_t begin, size_t end, int axis, const Vec3& to, size_t& best, double& square) const;

  // The middle of a range parts it along x, y and z by turns.
  std::vector<Vec3> points_;
};

}  // namespace lekalo::geometry
