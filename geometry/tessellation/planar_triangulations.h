// Triangulations of points in the plane by other rules than Delaunay's, or by other ways to his (Golovanov 2016, 8.6).
// Points are told apart by their places: of several at one place the first counts. All turn left.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/tessellation/triangulation.h"

namespace lekalo::geometry {

// The center of the circle through a, b, v lies at (a + b)/2 + t (a_y - b_y, b_x - a_x): t in units of |ab|, positive
// left of ab (Golovanov 2016, 8.6.3). Infinite where the three are collinear.
double circumcenter_parameter(const Vec2& a, const Vec2& b, const Vec2& v);

// Edges by increasing length (ties by index), each kept that crosses none kept before. O(n^2 log n): most of it sorts
// the pairs. The edges in this order, and the triangles that the first `steps` of them, or all, make.
std::vector<std::pair<int, int>> greedy_edges(std::span<const Vec2> points);
std::vector<IndexTriangle> greedy_triangulation(std::span<const Vec2> points, std::optional<int> steps = {});

// The least sum of the edges' lengths, of all triangulations: flips lead from each to every other (Lawson 1972).
// With `steps` what so many flips make of the greedy one, on a shortest way to the optimal one. Throws
// std::invalid_argument for more than kMaxOptimalPoints points.
inline constexpr size_t kMaxOptimalPoints = 10;
std::vector<IndexTriangle> optimal_triangulation(std::span<const Vec2> points, std::optional<int> steps = {});

// From the greedy one by flips of edges whose quadrilateral violates Delaunay's condition, until none is left or
// `steps` are done.
std::vector<IndexTriangle> triangulation_by_flips(std::span<const Vec2> points, std::optional<int> steps = {});

// The region on the left of closed polygons, edge by edge of the front, each with the nearest vertex left of it
// (algorithm 5); polygons and inner points as for `triangulate`. No more than `steps` triangles. Throws
// std::invalid_argument where polygons cross or run the wrong way.
std::vector<IndexTriangle> advancing_front(std::span<const Vec2> points, const std::vector<std::vector<int>>& polygons,
                                           std::optional<int> steps = {});

}  // namespace lekalo::geometry
