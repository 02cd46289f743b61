// Convex cells are cut one by one at each segment. A cut is by the line of the segment, of cells in whose inside there
// is a part of the segment; places where a line cuts a side are kept for the neighbour. Beside a cell that was cut
// beyond the end of a segment a neighbour has a vertex on its side: such a cell becomes a fan about its middle.
#include "geometry/surfaces/triangles/planar_cells.h"

#include <algorithm>
#include <map>

#include "geometry/tessellation/predicates.h"

namespace lekalo::geometry {

namespace {

using Polygon = std::vector<int>;

double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

class Cutter {
 public:
  explicit Cutter(std::span<const Vec2> border) {
    Vec2 lo(kInfinity), hi(-kInfinity);
    for (const Vec2& p : border) lo = glm::min(lo, p), hi = glm::max(hi, p);
    near_ = 1e-12 * glm::length(hi - lo);
    Polygon whole;
    for (const Vec2& p : border) whole.push_back(vertex(p));
    cells_.push_back(whole);
  }

  void cut(const PlanarSegment& segment) {
    if (glm::length(segment.to - segment.from) <= near_) return;
    made_.clear();
    const size_t count = cells_.size();
    for (size_t k = 0; k < count; ++k) cut(k, segment);
  }

  PlanarCells take() {
    PlanarCells result;
    for (const Polygon& cell : cells_) triangulate(with_vertices_on_sides(cell), result.triangles);
    result.points = std::move(points_);
    return result;
  }

 private:
  int vertex(const Vec2& p) {
    for (size_t k = 0; k < points_.size(); ++k)
      if (glm::length(points_[k] - p) <= 4 * near_) return static_cast<int>(k);
    points_.push_back(p);
    return static_cast<int>(points_.size()) - 1;
  }
  const Vec2& at(int vertex) const { return points_[static_cast<size_t>(vertex)]; }

  void cut(size_t k, const PlanarSegment& segment) {
    const Polygon cell = cells_[k];
    const double length = glm::length(segment.to - segment.from);
    const Vec2 along = (segment.to - segment.from) / length;
    std::vector<double> side(cell.size());
    bool left = false, right = false;
    for (size_t i = 0; i < cell.size(); ++i) {
      side[i] = cross(along, at(cell[i]) - segment.from);
      if (std::abs(side[i]) <= near_) side[i] = 0;
      left = left || side[i] > 0;
      right = right || side[i] < 0;
    }
    if (!left || !right) return;
    // Where the line goes in and out.
    const auto crossing = [&](size_t i, size_t next) {
      const double t = side[i] / (side[i] - side[next]);
      return at(cell[i]) + t * (at(cell[next]) - at(cell[i]));
    };
    double first = kInfinity, last = -kInfinity;
    const auto include = [&](const Vec2& p) {
      const double t = glm::dot(p - segment.from, along);
      first = std::min(first, t), last = std::max(last, t);
    };
    for (size_t i = 0; i < cell.size(); ++i) {
      const size_t next = (i + 1) % cell.size();
      if (side[i] == 0) include(at(cell[i]));
      if (side[i] * side[next] < 0) include(crossing(i, next));
    }
    if (std::min(last, length) - std::max(first, 0.0) <= 4 * near_) return;
    Polygon above, below;
    const auto add = [](Polygon& polygon, int vertex) {
      if (polygon.empty() || (polygon.back() != vertex && polygon.front() != vertex)) polygon.push_back(vertex);
    };
    for (size_t i = 0; i < cell.size(); ++i) {
      const size_t next = (i + 1) % cell.size();
      if (side[i] >= 0) add(above, cell[i]);
      if (side[i] <= 0) add(below, cell[i]);
      if (side[i] * side[next] < 0) {
        const auto key = std::minmax(cell[i], cell[next]);
        const auto [found, is_new] = made_.try_emplace({key.first, key.second}, 0);
        if (is_new) found->second = vertex(crossing(i, next));
        add(above, found->second), add(below, found->second);
      }
    }
    if (above.size() < 3 || below.size() < 3) return;
    cells_[k] = above;
    cells_.push_back(below);
  }

  Polygon with_vertices_on_sides(const Polygon& cell) const {
    Polygon result;
    for (size_t i = 0; i < cell.size(); ++i) {
      const int a = cell[i], b = cell[(i + 1) % cell.size()];
      result.push_back(a);
      const double length = glm::length(at(b) - at(a));
      const Vec2 along = (at(b) - at(a)) / length;
      std::vector<std::pair<double, int>> on;
      for (int v = 0; v < static_cast<int>(points_.size()); ++v) {
        const Vec2 off = at(v) - at(a);
        const double t = glm::dot(off, along);
        if (v != a && v != b && t > 0 && t < length && std::abs(cross(along, off)) <= 4 * near_) on.emplace_back(t, v);
      }
      std::sort(on.begin(), on.end());
      for (const auto& [t, v] : on) result.push_back(v);
    }
    return result;
  }

  void triangulate(const Polygon& cell, std::vector<std::array<int, 3>>& triangles) {
    const size_t n = cell.size();
    bool is_strict = true;
    for (size_t i = 0; i < n; ++i) {
      const Vec2 a = at(cell[(i + 1) % n]) - at(cell[i]), b = at(cell[(i + 2) % n]) - at(cell[(i + 1) % n]);
      is_strict = is_strict && cross(a, b) > 1e-9 * glm::length(a) * glm::length(b);
    }
    if (is_strict) {
      for (size_t i = 1; i + 1 < n; ++i) triangles.push_back({cell[0], cell[i], cell[i + 1]});
      return;
    }
    Vec2 middle(0);
    for (const int v : cell) middle += at(v) / static_cast<double>(n);
    points_.push_back(middle);
    const int center = static_cast<int>(points_.size()) - 1;
    for (size_t i = 0; i < n; ++i) triangles.push_back({center, cell[i], cell[(i + 1) % n]});
  }

  double near_ = 0;
  std::vector<Vec2> points_;
  std::vector<Polygon> cells_;
  std::map<std::pair<int, int>, int> made_;  // on the sides, by the segment that cuts now
};

}  // namespace

std::array<Vec2, 3> PlanarCells::corners(size_t triangle) const {
  std::array<Vec2, 3> result;
  for (size_t k = 0; k < 3; ++k) result[k] = points[static_cast<size_t>(triangles[triangle][k])];
  return result;
}

PlanarCells planar_cells(std::span<const Vec2> border, std::span<const PlanarSegment> segments) {
  Cutter cutter(border);
  for (const PlanarSegment& segment : segments) cutter.cut(segment);
  return cutter.take();
}

std::vector<Vec2> plane_points(const std::vector<Vec3>& points) { return {points.begin(), points.end()}; }

std::vector<Vec2> convex_hull(std::vector<Vec2> points) {
  const auto before = [](const Vec2& a, const Vec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::vector<Vec2> hull;
  // The lower chain from left to right, then the upper one back (Andrew 1979).
  for (const bool upper : {false, true}) {
    const size_t first = hull.size();
    for (size_t k = 0; k < points.size(); ++k) {
      const Vec2& p = upper ? points[points.size() - 1 - k] : points[k];
      while (hull.size() >= first + 2 && orient2d(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    if (!hull.empty()) hull.pop_back();
  }
  return hull;
}

std::vector<PlanarSegment> all_segments(std::span<const Vec2> points) {
  std::vector<PlanarSegment> segments;
  for (size_t i = 0; i < points.size(); ++i)
    for (size_t j = i + 1; j < points.size(); ++j)
      if (points[i] != points[j]) segments.push_back({points[i], points[j]});
  return segments;
}

}  // namespace lekalo::geometry
