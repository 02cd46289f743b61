// Triangular nets and what de Casteljau's algorithm makes of them (Golovanov 2016, 3.11; Farin 1986):
//
//   r(a, b, c) = sum_(i + j + k = n) n!/(i! j! k!) a^i b^j c^k p_ijk,  a + b + c = 1
//
// A step takes n from p_ijk to a p_(i+1,j,k) + b p_(i,j+1,k) + c p_(i,j,k+1); n steps end at the point. Steps of
// different arguments give the polar form (blossom), whose values are the nets of parts.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/vectors.h"

namespace lekalo::geometry {

// Barycentric coordinates (a, b, c), a + b + c = 1, of a point; a + b + c = 0 of a direction.
using Barycentric = Vec3;

// The points ijk, i + j + k = degree, for i = degree .. 0, for j = degree - i .. 0. Point: Vec4 (homogeneous) or
// double.
template <class Point>
struct TriangularNetOf {
  int degree = 0;
  std::vector<Point> points;

  static int count(int degree) { return (degree + 1) * (degree + 2) / 2; }
  static int index_in(int degree, int i, int j) {
    const int row = degree - i;
    return row * (row + 1) / 2 + row - j;
  }
  int index(int i, int j) const { return index_in(degree, i, j); }
  const Point& at(int i, int j) const { return points[static_cast<size_t>(index(i, j))]; }
};
using TriangularNet = TriangularNetOf<Vec4>;

// Calls visit(i, j, k) in the order of the points.
template <class Visit>
void each_index(int degree, const Visit& visit) {
  for (int i = degree; i >= 0; --i)
    for (int j = degree - i; j >= 0; --j) visit(i, j, degree - i - j);
}

// The net of degree n - 1 of the step with these arguments; of a direction, the derivative's divided by n.
template <class Point>
TriangularNetOf<Point> de_casteljau_step(const TriangularNetOf<Point>& net, const Barycentric& t) {
  TriangularNetOf<Point> result{net.degree - 1, {}};
  result.points.reserve(net.points.size());
  each_index(net.degree - 1, [&](int i, int j, int) {
    result.points.push_back(t.x * net.at(i + 1, j) + t.y * net.at(i, j + 1) + t.z * net.at(i, j));
  });
  return result;
}

// The polar form: symmetric and affine in its `degree` arguments.
template <class Point>
Point blossom(TriangularNetOf<Point> net, std::span<const Barycentric> arguments) {
  for (const Barycentric& t : arguments) net = de_casteljau_step(net, t);
  return net.points.front();
}

template <class Point>
Point value_at(TriangularNetOf<Point> net, const Barycentric& t) {
  while (net.degree > 0) net = de_casteljau_step(net, t);
  return net.points.front();
}

// The net of the same polynomial over the triangle with these corners.
template <class Point>
TriangularNetOf<Point> part_of(const TriangularNetOf<Point>& net, const std::array<Barycentric, 3>& corners) {
  TriangularNetOf<Point> result{net.degree, {}};
  each_index(net.degree, [&](int i, int j, int k) {
    std::vector<Barycentric> arguments;
    const int times[] = {i, j, k};
    for (int corner = 0; corner < 3; ++corner)
      arguments.insert(arguments.end(), static_cast<size_t>(times[corner]), corners[static_cast<size_t>(corner)]);
    result.points.push_back(blossom(net, arguments));
  });
  return result;
}

// The net of degree n + 1 of the product with the linear function that has these values at the corners; with (1, 1, 1)
// the same polynomial raised by a degree (3.11.8).
template <class Point>
TriangularNetOf<Point> times_linear(const TriangularNetOf<Point>& net, const Vec3& at_corners) {
  const int n = net.degree + 1;
  TriangularNetOf<Point> result{n, {}};
  each_index(n, [&](int i, int j, int k) {
    Point sum(0);
    if (i > 0) sum += (i * at_corners.x) * net.at(i - 1, j);
    if (j > 0) sum += (j * at_corners.y) * net.at(i, j - 1);
    if (k > 0) sum += (k * at_corners.z) * net.at(i, j);
    result.points.push_back(sum / static_cast<double>(n));
  });
  return result;
}
template <class Point>
TriangularNetOf<Point> elevated(const TriangularNetOf<Point>& net) {
  return times_linear(net, Vec3(1));
}

// Nets of one degree.
template <class Point>
TriangularNetOf<Point> operator+(TriangularNetOf<Point> a, const TriangularNetOf<Point>& b) {
  for (size_t k = 0; k < a.points.size(); ++k) a.points[k] += b.points[k];
  return a;
}
template <class Point>
TriangularNetOf<Point> operator*(double factor, TriangularNetOf<Point> net) {
  for (Point& p : net.points) p *= factor;
  return net;
}

// The corners in another order: the point ijk of the result is that whose corner order[0] has i, ...
template <class Point>
TriangularNetOf<Point> permuted(const TriangularNetOf<Point>& net, const std::array<int, 3>& order) {
  TriangularNetOf<Point> result{net.degree, {}};
  each_index(net.degree, [&](int i, int j, int k) {
    int of_corner[3];
    of_corner[order[0]] = i, of_corner[order[1]] = j, of_corner[order[2]] = k;
    result.points.push_back(net.at(of_corner[0], of_corner[1]));
  });
  return result;
}

}  // namespace lekalo::geometry
