// Constrained Delaunay triangulation of points and polygons in the plane (Golovanov 2016, 8.6).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/vectors.h"

namespace lekalo::geometry {

using IndexTriangle = std::array<int, 3>;

// Grows point by point and constraint by constraint; every step restores the Delaunay condition except across
// constraints (Lawson flips, Golovanov 2016, 8.6 algorithms 3 and 4; constraints by Sloan 1993).
class PlanarTriangulation {
 public:
  // All points inserted later must lie in the box (empty boxes are widened).
  PlanarTriangulation(const Vec2& lo, const Vec2& hi);

  // Index of the new vertex, or of the vertex that already stands at this place. A point on an edge splits it.
  int insert(const Vec2& point);

  // Makes a -> b an edge (several, if vertices lie on it), when all polygon points have been inserted. The kept region
  // lies on its left once keep_left() is called. Throws std::invalid_argument where it crosses another constraint.
  void constrain(int a, int b);

  // Marks as inside the triangles that a walk from the left sides of all constraints reaches without crossing one.
  void keep_left();

  // Splits inside triangles while `better_point` asks for it: it gets the three vertices and which of the sides
  // (opposite to vertex i) are constrained, and returns true with a point to insert. Points that fall outside the
  // inside region or onto a constraint are left out. Ends after `limit` insertions. `inserted` hears of each vertex.
  template <class BetterPoint, class Inserted>
  void refine(BetterPoint better_point, Inserted inserted, int limit);

  // The inside triangles, counterclockwise.
  std::vector<IndexTriangle> triangles() const;
  const Vec2& point(int vertex) const { return points_[vertex + 3]; }
  int size() const { return static_cast<int>(points_.size()) - 3; }

 private:
  struct Triangle {
    std::array<int, 3> vertex;
    std::array<int, 3> across;  // neighbour opposite to vertex i, -1 outside
    std::array<bool, 3> constrained{};
    bool inside = false;
  };
  // A side of a triangle.
  struct Side {
    int triangle;
    int corner;  // opposite to the side
  };
  struct Location {
    int triangle;
    int on_side = -1;    // the point lies on the side opposite to this corner
    int on_vertex = -1;  // or on this vertex
  };

  Location locate(const Vec2& point) const;
  int insert_at(const Location& where, const Vec2& point);
  void split_triangle(int triangle, int vertex);
  void split_side(Side side, int vertex);
  void flip(Side side);
  void restore_delaunay();
  bool is_delaunay(Side side) const;
  Side find_side(int a, int b) const;  // side from a to b, triangle -1 if there is none
  void replace_neighbour(int triangle, int before, int after);
  void set_triangle(int index, std::array<int, 3> vertex, std::array<int, 3> across, std::array<bool, 3> constrained);
  void constrain_piece(int a, int b, std::vector<std::array<int, 2>>& rest);
  int corner_against(int triangle, int neighbour) const;

  std::vector<Vec2> points_;  // the first three enclose all others
  std::vector<Triangle> triangles_;
  std::vector<int> first_triangle_;  // one triangle of each vertex
  std::vector<Side> suspects_;       // sides that may violate the Delaunay condition
  std::vector<std::array<int, 2>> constraints_;
  std::vector<int> changed_;  // triangles made or changed since refine looked
  bool record_changes_ = false;
  mutable int last_ = 0;
  mutable uint32_t random_ = 1;
};

// Triangles of the region on the left of closed polygons (outer ones counterclockwise, holes clockwise), which index
// `points`; points that no polygon names are inner vertices where they lie inside, and are left out elsewhere.
// B + 2K + 2H - 2 triangles for B polygon points, K inner points and H holes. Throws std::invalid_argument when
// polygons cross.
std::vector<IndexTriangle> triangulate(std::span<const Vec2> points, const std::vector<std::vector<int>>& polygons);

// Delaunay triangulation of the points' convex hull.
std::vector<IndexTriangle> delaunay(std::span<const Vec2> points);

template <class BetterPoint, class Inserted>
void PlanarTriangulation::refine(BetterPoint better_point, Inserted inserted, int limit) {
  std::vector<int> waiting;
  for (int i = 0; i < static_cast<int>(triangles_.size()); ++i) waiting.push_back(i);
  record_changes_ = true;
  for (size_t next = 0; next < waiting.size() && limit > 0; ++next) {
    const Triangle triangle = triangles_[waiting[next]];
    if (!triangle.inside) continue;
    Vec2 place;
    const IndexTriangle corners{triangle.vertex[0] - 3, triangle.vertex[1] - 3, triangle.vertex[2] - 3};
    if (!better_point(corners, triangle.constrained, place)) continue;
    last_ = waiting[next];
    const Location where = locate(place);
    const Triangle& found = triangles_[where.triangle];
    if (!found.inside || where.on_vertex >= 0 || (where.on_side >= 0 && found.constrained[where.on_side])) continue;
    changed_.clear();
    inserted(insert_at(where, place) - 3);
    waiting.insert(waiting.end(), changed_.begin(), changed_.end());
    --limit;
  }
  record_changes_ = false;
}

}  // namespace lekalo::geometry
