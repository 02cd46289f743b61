#include "geometry/surfaces/triangles/simplex_spline.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <stdexcept>

#include "geometry/tessellation/predicates.h"

namespace lekalo::geometry {

namespace {

using Net = TriangularNetOf<double>;

// The values of a linear function at the corners of a cell.
template <class Linear>
Vec3 at_corners(const ParameterTriangle& cell, const Linear& f) {
  return {f(cell.corners[0]), f(cell.corners[1]), f(cell.corners[2])};
}

Vec2 middle_of(const std::array<Vec2, 3>& cell) { return (cell[0] + cell[1] + cell[2]) / 3.0; }

double sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

}  // namespace

void throw_collinear() { throw std::invalid_argument("three of the points are collinear"); }

SimplexSpline::SimplexSpline(std::vector<Vec2> knots) : knots_(std::move(knots)) {
  const size_t m = knots_.size();
  if (m < 3 || m > kMaxSimplexKnots)
    throw std::invalid_argument(fmt::format("{} knots: a simplex spline has 3 to {}", m, kMaxSimplexKnots));
  largest_.resize(size_t{1} << m);
  for (int i = 0; i < static_cast<int>(m); ++i)
    for (int j = i + 1; j < static_cast<int>(m); ++j)
      for (int k = j + 1; k < static_cast<int>(m); ++k) {
        const Vec2 &p = knots_[static_cast<size_t>(i)], &q = knots_[static_cast<size_t>(j)],
                   &r = knots_[static_cast<size_t>(k)];
        const double turn = orient2d(p, q, r);  // exactly zero or not
        if (turn != 0) largest_[1u << i | 1u << j | 1u << k] = {{i, j, k}, std::abs(homogeneous_determinant(p, q, r))};
      }
  for (unsigned subset = 0; subset < largest_.size(); ++subset) {
    if (std::popcount(subset) <= 3) continue;
    for (size_t k = 0; k < m; ++k)
      if (subset >> k & 1) {
        const Triple& other = largest_[subset ^ (1u << k)];
        if (other.determinant > largest_[subset].determinant) largest_[subset] = other;
      }
  }
  if (largest_.back().determinant == 0) throw std::invalid_argument("all knots lie on one line");
}

Net SimplexSpline::net(const std::array<Vec2, 3>& cell) const {
  std::vector<Net> known(largest_.size());
  return net_of(static_cast<unsigned>(largest_.size()) - 1, {cell}, middle_of(cell), known);
}

Net SimplexSpline::net_of(unsigned subset, const ParameterTriangle& cell, const Vec2& inside,
                          std::vector<Net>& known) const {
  Net& result = known[subset];
  if (!result.points.empty()) return result;
  const int degree = std::popcount(subset) - 3;
  result = {degree, std::vector<double>(static_cast<size_t>(Net::count(degree)), 0.0)};
  const auto& [chosen, determinant] = largest(subset);
  if (determinant == 0) return result;
  ParameterTriangle triangle;
  for (size_t k = 0; k < 3; ++k) triangle.corners[k] = knots_[static_cast<size_t>(chosen[k])];
  if (degree == 0) {
    if (triangle.contains(inside)) result.points[0] = 1 / determinant;
    return result;
  }
  Net sum = result;
  for (int k = 0; k < 3; ++k) {
    const Vec3 coordinate = at_corners(cell, [&](const Vec2& p) { return triangle.coordinates(p)[k]; });
    const Net part = net_of(subset ^ (1u << chosen[static_cast<size_t>(k)]), cell, inside, known);
    sum = sum + times_linear(part, coordinate);
  }
  return known[subset] = sum;
}

Net truncated_power_net(std::span<const Vec2> knots, const Vec2& x, const std::array<Vec2, 3>& cell) {
  const int degree = static_cast<int>(knots.size()) - 3;
  const ParameterTriangle triangle{cell};
  const Vec2 inside = middle_of(cell);
  return homogeneous_divided_difference(knots, [&](const Vec2& r, const Vec2& q) {
    const double side = sign(orient2d(r, q, x));
    if (side == 0) throw std::invalid_argument("the auxiliary point lies on a line through two knots");
    Net power{0, {side}};
    const Vec2 region[] = {r, q, x};
    if (!in_half_open_region(region, inside)) power.points[0] = 0;
    for (int k = 0; k < degree; ++k)
      power =
          times_linear(power, at_corners(triangle, [&](const Vec2& p) { return homogeneous_determinant(r, q, p); }));
    return power;
  });
}

}  // namespace lekalo::geometry
