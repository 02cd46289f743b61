// Bezier triangles (Golovanov 2016, 3.11):
//
//   r(a, b, c) = sum n!/(i! j! k!) a^i b^j c^k w_ijk p_ijk / (the same with w_ijk alone),  a + b + c = 1
//
// over the square a = u, b = (1 - u) v, c = (1 - u)(1 - v) (3.10): with n!/(i! j! k!) = C(n, i) C(n - i, j)
//
//   sum_i B_i^n(u) sum_j B_j^(n-i)(v) P_ijk
//
// whose inner sums are raised to degree n. The price is the edge u = 1, which is the corner n00: derivatives by v
// vanish there, and the normal is the limit.
#include "geometry/surfaces/triangles/bezier_triangle.h"

#include <fmt/format.h>

#include <cmath>

#include "geometry/curves/splines/bspline_basis.h"
#include "geometry/curves/splines/nurbs_operations.h"

namespace lekalo::geometry {

namespace {

std::vector<double> bezier_knots(int degree) {
  std::vector<double> knots(2 * (degree + 1), 0.0);
  std::fill(knots.begin() + degree + 1, knots.end(), 1.0);
  return knots;
}

// The degree of a net with so many points. Throws FieldError.
int degree_of(size_t count) {
  const int degree = static_cast<int>(std::lround((std::sqrt(8.0 * count + 1) - 3) / 2));
  if (degree < 1 || degree > kMaxDegree || TriangularNet::count(degree) != static_cast<int>(count))
    throw FieldError("points", fmt::format("{} points make no triangular net", count),
                     "degree 1 has 3 points, degree 2 has 6, degree 3 has 10, degree n has (n + 1)(n + 2)/2");
  return degree;
}

TriangularNet read_net(const Fields& f) {
  const std::vector<Vec3>& points = f.points("points");
  TriangularNet net{degree_of(points.size()), {}};
  std::vector<double> weights(points.size(), 1.0);
  if (f.has("weights")) weights = f.numbers("weights");
  if (weights.size() != points.size())
    throw FieldError("weights",
                     fmt::format("{} points need {} weights, not {}", points.size(), points.size(), weights.size()));
  for (size_t k = 0; k < points.size(); ++k) {
    if (!(weights[k] > 0)) throw FieldError("weights", fmt::format("weight {} is not positive", k));
    net.points.emplace_back(weights[k] * points[k], weights[k]);
  }
  for (int k = 0; k < f.integer("elevate"); ++k) net = elevated(net);
  return net;
}

}  // namespace

NurbsSurface bezier_triangle(const TriangularNet& net) {
  const int n = net.degree;
  NurbsSurfaceForm form;
  form.degree_u = form.degree_v = n;
  form.knots_u = form.knots_v = bezier_knots(n);
  for (int i = 0; i <= n; ++i) {
    std::vector<Vec4> row;
    for (int j = 0; j <= n - i; ++j) row.push_back(net.at(i, j));
    row = i == n ? std::vector<Vec4>(n + 1, row.front()) : elevated_bezier(std::move(row), n);
    form.points.insert(form.points.end(), row.begin(), row.end());
  }
  return NurbsSurface(form);
}

TriangularNet elevated(const TriangularNet& net) {
  const int n = net.degree + 1;
  TriangularNet result{n, {}};
  for (int i = n; i >= 0; --i)
    for (int j = n - i; j >= 0; --j) {
      const int k = n - i - j;
      Vec4 sum(0);
      if (i > 0) sum += double(i) * net.at(i - 1, j);
      if (j > 0) sum += double(j) * net.at(i, j - 1);
      if (k > 0) sum += double(k) * net.at(i, j);
      result.points.push_back(sum / double(n));
    }
  return result;
}

TypeDeclaration bezier_triangle_type() {
  return declare(Category::surface, "bezier_triangle",
                 "Bezier surface on a triangular net of any degree, polynomial or rational. Over the square: u is the "
                 "barycentric coordinate a, v is b/(b + c); the edge u = 1 is the first point, a pole.")
      .field("points", points().count(3),
             "p_ijk, i + j + k = n, in the order i = n .. 0 and in each j = n - i .. 0: the first is the corner n00, "
             "the last row goes from 0n0 to 00n")
      .optional("weights", numbers(), "one for each point, in the same order; all 1 when left out")
      .field("elevate", integer().between(0, kMaxDegree - 1), "raise the degree so often; the surface is the same", "0")
      .shows({"control_net"})
      .example("points: [[0, 0], [0, 1], [1, 0, 1], [0, 2], [1, 1, 1], [2, 0]]")
      .built_by([](const Fields& f) {
        const TriangularNet net = read_net(f);
        if (net.degree > kMaxDegree)
          throw FieldError("elevate", fmt::format("degree {} is above {}", net.degree, kMaxDegree));
        return bezier_triangle(net);
      });
}

TypeDeclaration triangle_surface_type() {
  return declare(
             Category::surface, "triangle_surface",
             "Flat triangle. Over the square: u is the barycentric coordinate of the first corner, a pole at u = 1; "
             "v is b/(b + c).")
      .field("points", points().count(3, 3), "the corners")
      .example("points: [[0, 0], [2, 0], [1, 2, 1]]")
      .built_by([](const Fields& f) {
        const std::vector<Vec3>& p = f.points("points");
        const Vec3 sides = glm::cross(p[1] - p[0], p[2] - p[0]);
        const double longest = std::max({glm::length(p[1] - p[0]), glm::length(p[2] - p[0]), glm::length(p[2] - p[1])});
        if (!(glm::length(sides) > 1e-14 * longest * longest))
          throw FieldError("points", "the three points lie on one line", "a triangle needs three that do not");
        return bezier_triangle({1, {Vec4(p[0], 1), Vec4(p[1], 1), Vec4(p[2], 1)}});
      });
}

}  // namespace lekalo::geometry
