// Simplex splines over the plane (Golovanov 2016, 3.12 and 3.13; Micchelli 1979): on m = n + 3 knots
//
//   M^P(p) = a M^(P - p_a)(p) + b M^(P - p_b)(p) + c M^(P - p_c)(p),   M^(p_i p_j p_k) = 1/|d(p_i, p_j, p_k)|
//
// with the barycentric coordinates a, b, c of p in any three knots that are not collinear. Of degree n on each cell of
// the segments that join knots; integral 1/((n + 1)(n + 2)).
#pragma once

#include "geometry/surfaces/triangles/parameter_triangle.h"

namespace lekalo::geometry {

inline constexpr size_t kMaxSimplexKnots = 12;

class SimplexSpline {
 public:
  // 3..kMaxSimplexKnots knots, which may repeat; not all on one line. Throws std::invalid_argument.
  explicit SimplexSpline(std::vector<Vec2> knots);
  const std::vector<Vec2>& knots() const { return knots_; }
  int degree() const { return static_cast<int>(knots_.size()) - 3; }

  // Over a triangle that no segment between knots goes through: the polynomial that the spline is there, by the
  // recurrence on the three knots of the largest determinant.
  TriangularNetOf<double> net(const std::array<Vec2, 3>& cell) const;

 private:
  struct Triple {
    std::array<int, 3> knots{};
    double determinant = 0;
  };
  TriangularNetOf<double> net_of(unsigned subset, const ParameterTriangle& cell, const Vec2& inside,
                                 std::vector<TriangularNetOf<double>>& known) const;
  const Triple& largest(unsigned subset) const { return largest_[subset]; }

  std::vector<Vec2> knots_;
  std::vector<Triple> largest_;  // by subset; determinant 0: all collinear
};

// The homogeneous divided difference of a function of two points on a sequence of points no three of which are
// collinear (3.12.7),
//
//   f[P] = sum_(i < j) f(p_i, p_j)/prod_(n != i, j) d(p_i, p_j, p_n)
//
// Value: anything with sums and multiples. Throws std::invalid_argument where a determinant vanishes.
template <class Function>
auto homogeneous_divided_difference(std::span<const Vec2> points, const Function& f)
    -> decltype(f(points[0], points[1]));

// The same spline as SimplexSpline::net on knots no three of which are collinear: the divided difference of the
// truncated power d(r, q, p)^n sgn d(r, q, x), where p is in [r, q, x), with any point x (3.12.15). Throws
// std::invalid_argument for other knots, or where x is on a line through two of them.
TriangularNetOf<double> truncated_power_net(std::span<const Vec2> knots, const Vec2& x,
                                            const std::array<Vec2, 3>& cell);

[[noreturn]] void throw_collinear();

template <class Function>
auto homogeneous_divided_difference(std::span<const Vec2> points, const Function& f)
    -> decltype(f(points[0], points[1])) {
  decltype(f(points[0], points[1])) sum = 0.0 * f(points[0], points[1]);
  for (size_t i = 0; i < points.size(); ++i)
    for (size_t j = i + 1; j < points.size(); ++j) {
      double product = 1;
      for (size_t n = 0; n < points.size(); ++n)
        if (n != i && n != j) product *= homogeneous_determinant(points[i], points[j], points[n]);
      if (product == 0) throw_collinear();
      sum = sum + (1 / product) * f(points[i], points[j]);
    }
  return sum;
}

}  // namespace lekalo::geometry
