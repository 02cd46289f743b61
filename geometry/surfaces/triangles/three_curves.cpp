#include "geometry/surfaces/triangles/three_curves.h"

#include <algorithm>

#include "geometry/curves/splines/nurbs_operations.h"

namespace lekalo::geometry {

namespace {

std::vector<Vec3> raised(const std::vector<Vec3>& points, int degree) {
  std::vector<Vec4> homogeneous;
  for (const Vec3& p : points) homogeneous.emplace_back(p, 1);
  std::vector<Vec3> result;
  for (const Vec4& p : elevated_bezier(std::move(homogeneous), degree)) result.emplace_back(p);
  return result;
}

Vec3 middle_of(std::vector<Vec3> points) {
  for (size_t n = points.size() - 1; n > 0; --n)
    for (size_t i = 0; i < n; ++i) points[i] = 0.5 * (points[i] + points[i + 1]);
  return points[0];
}

// 4abc of degree n >= 3, times a vector.
void subtract_bubble(TriangularNet& net, const Vec3& correction) {
  TriangularNetOf<double> bubble{3, std::vector<double>(10, 0.0)};
  bubble.points[static_cast<size_t>(bubble.index(1, 1))] = 4.0 / 6;
  while (bubble.degree < net.degree) bubble = elevated(bubble);
  for (size_t k = 0; k < net.points.size(); ++k) net.points[k] -= Vec4(bubble.points[k] * correction, 0);
}

}  // namespace

TriangularNet net_on_three_curves(const std::array<std::vector<Vec3>, 3>& curves, const Vec3& correction) {
  size_t count = correction == Vec3(0) ? 2 : 3;
  for (const std::vector<Vec3>& points : curves) count = std::max(count, points.size());
  const int degree = static_cast<int>(count) - 1;
  std::array<std::vector<Vec3>, 3> e;
  for (size_t q = 0; q < 3; ++q) e[q] = raised(curves[q], degree);
  const Vec3 p[] = {e[1].front(), e[2].front(), e[0].front()};
  const auto at = [&](int q, int i) { return e[static_cast<size_t>(q)][static_cast<size_t>(i)]; };
  TriangularNet net{degree + 1, {}};
  each_index(degree + 1, [&](int i, int j, int k) {
    Vec3 sum(0);
    if (i > 0) sum += static_cast<double>(i) * (at(2, degree - j) + at(1, k) - p[0]);
    if (j > 0) sum += static_cast<double>(j) * (at(0, degree - k) + at(2, i) - p[1]);
    if (k > 0) sum += static_cast<double>(k) * (at(1, degree - i) + at(0, j) - p[2]);
    net.points.emplace_back(sum / (degree + 1.0), 1);
  });
  if (correction != Vec3(0)) subtract_bubble(net, correction);
  return net;
}

TriangularNet balanced_net_on_three_curves(const std::array<std::vector<Vec3>, 3>& curves) {
  Vec3 correction(0);
  for (const std::vector<Vec3>& points : curves) correction += middle_of(points) - points.front();
  return net_on_three_curves(curves, correction);
}

}  // namespace lekalo::geometry
