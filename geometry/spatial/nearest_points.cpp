#include "geometry/spatial/nearest_points.h"

#include <algorithm>

namespace lekalo::geometry {

NearestPoints::NearestPoints(std::vector<Vec3> points) : points_(std::move(points)) { sort(0, points_.size(), 0); }

void NearestPoints::sort(size_t begin, size_t end, int axis) {
  if (end - begin < 2) return;
  const size_t middle = begin + (end - begin) / 2;
  const auto at = [&](size_t i) { return points_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](const Vec3& a, const Vec3& b) { return a[axis] < b[axis]; });
  sort(begin, middle, (axis + 1) % 3);
  sort(middle + 1, end, (axis + 1) % 3);
}

const Vec3& NearestPoints::nearest(const Vec3& to) const {
  size_t best = 0;
  double square = kInfinity;
  search(0, points_.size(), 0, to, best, square);
  return points_[best];
}

void NearestPoints::search(size_t begin, size_t end, int axis, const Vec3& to, size_t& best, double& square) const {
  if (begin == end) return;
  const size_t middle = begin + (end - begin) / 2;
  const Vec3 off = points_[middle] - to;
  if (const double here = glm::dot(off, off); here < square) {
    square = here;
    best = middle;
  }
  const int next = (axis + 1) % 3;
  const bool above = off[axis] < 0;
  const auto half = [&](bool upper) {
    upper ? search(middle + 1, end, next, to, best, square) : search(begin, middle, next, to, best, square);
  };
  half(above);
  if (off[axis] * off[axis] < square) half(!above);
}

}  // namespace lekalo::geometry
