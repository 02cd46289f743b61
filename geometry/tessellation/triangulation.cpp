// Constrained Delaunay triangulation.
//
// A point is found by walking (orientation tests from the last triangle on), joined to the corners of its triangle,
// and the Delaunay condition is restored by flipping sides (Lawson 1977; Golovanov 2016, 8.6). A constraint that is
// not yet an edge is made one by flipping the sides it crosses, in turn (Sloan, "A fast algorithm for generating
// constrained Delaunay triangulations", 1993). Orientation is exact, so no step depends on a tolerance.
#include "geometry/tessellation/triangulation.h"

#include <algorithm>
#include <deque>
#include <stdexcept>

#include "geometry/tessellation/predicates.h"

namespace lekalo::geometry {

namespace {
int next(int corner) { return corner == 2 ? 0 : corner + 1; }
int previous(int corner) { return corner == 0 ? 2 : corner - 1; }
}  // namespace

PlanarTriangulation::PlanarTriangulation(const Vec2& lo, const Vec2& hi) {
  const Vec2 center = 0.5 * (lo + hi);
  double size = std::max(hi.x - lo.x, hi.y - lo.y);
  if (!(size > 0)) size = std::max({1.0, std::abs(center.x), std::abs(center.y)});
  // Far enough that no point of the box comes near its sides.
  points_ = {center + size * Vec2(-40, -30), center + size * Vec2(40, -30), center + size * Vec2(0, 50)};
  triangles_.push_back({{0, 1, 2}, {-1, -1, -1}});
  first_triangle_ = {0, 0, 0};
}

int PlanarTriangulation::corner_against(int triangle, int neighbour) const {
  const auto& across = triangles_[triangle].across;
  return across[0] == neighbour ? 0 : across[1] == neighbour ? 1 : 2;
}

void PlanarTriangulation::replace_neighbour(int triangle, int before, int after) {
  if (triangle >= 0) triangles_[triangle].across[corner_against(triangle, before)] = after;
}

void PlanarTriangulation::set_triangle(int index, std::array<int, 3> vertex, std::array<int, 3> across,
                                       std::array<bool, 3> constrained) {
  Triangle& t = triangles_[index];
  t.vertex = vertex;
  t.across = across;
  t.constrained = constrained;
  for (int v : vertex) first_triangle_[v] = index;
  if (record_changes_) changed_.push_back(index);
}

PlanarTriangulation::Location PlanarTriangulation::locate(const Vec2& point) const {
  int at = last_;
  for (;;) {
    const Triangle& t = triangles_[at];
    // A random first side: a walk in a fixed order can run in circles where constraints break the Delaunay condition.
    random_ = random_ * 1664525u + 1013904223u;
    int corner = static_cast<int>((random_ >> 16) % 3);
    Location result{at};
    int step_to = -1;
    for (int n = 0; n < 3; ++n, corner = next(corner)) {
      const int a = t.vertex[next(corner)], b = t.vertex[previous(corner)];
      const double turn = orient2d(points_[a], points_[b], point);
      if (turn < 0) {
        step_to = t.across[corner];
        if (step_to < 0) throw std::invalid_argument("a point lies outside the box of the triangulation");
        break;
      }
      if (turn == 0) {
        if (points_[a] == point) result.on_vertex = a;
        if (points_[b] == point) result.on_vertex = b;
        result.on_side = corner;
      }
    }
    if (step_to < 0) {
      last_ = at;
      return result;
    }
    at = step_to;
  }
}

int PlanarTriangulation::insert(const Vec2& point) { return insert_at(locate(point), point) - 3; }

// Returns the vertex with the three enclosing ones counted; insert() does not count them.
int PlanarTriangulation::insert_at(const Location& where, const Vec2& point) {
  if (where.on_vertex >= 0) return where.on_vertex;
  const int vertex = static_cast<int>(points_.size());
  points_.push_back(point);
  first_triangle_.push_back(where.triangle);
  if (where.on_side >= 0)
    split_side({where.triangle, where.on_side}, vertex);
  else
    split_triangle(where.triangle, vertex);
  restore_delaunay();
  return vertex;
}

void PlanarTriangulation::split_triangle(int triangle, int p) {
  const Triangle old = triangles_[triangle];
  const auto [a, b, c] = old.vertex;
  const int second = static_cast<int>(triangles_.size()), third = second + 1;
  triangles_.resize(triangles_.size() + 2);
  triangles_[second].inside = triangles_[third].inside = old.inside;
  set_triangle(triangle, {a, b, p}, {second, third, old.across[2]}, {false, false, old.constrained[2]});
  set_triangle(second, {b, c, p}, {third, triangle, old.across[0]}, {false, false, old.constrained[0]});
  set_triangle(third, {c, a, p}, {triangle, second, old.across[1]}, {false, false, old.constrained[1]});
  replace_neighbour(old.across[0], triangle, second);
  replace_neighbour(old.across[1], triangle, third);
  for (int t : {triangle, second, third}) suspects_.push_back({t, 2});
}

void PlanarTriangulation::split_side(Side side, int p) {
  const int t = side.triangle, k = side.corner;
  const Triangle old = triangles_[t];
  const int u = old.across[k];
  const int m = corner_against(u, t);
  const Triangle other = triangles_[u];
  const int c = old.vertex[k], a = old.vertex[next(k)], b = old.vertex[previous(k)], q = other.vertex[m];
  const int t2 = static_cast<int>(triangles_.size()), u2 = t2 + 1;
  triangles_.resize(triangles_.size() + 2);
  triangles_[t2].inside = old.inside;
  triangles_[u2].inside = other.inside;
  const bool hard = old.constrained[k];
  set_triangle(t, {c, a, p}, {u2, t2, old.across[previous(k)]}, {hard, false, old.constrained[previous(k)]});
  set_triangle(t2, {c, p, b}, {u, old.across[next(k)], t}, {hard, old.constrained[next(k)], false});
  set_triangle(u, {q, b, p}, {t2, u2, other.across[previous(m)]}, {hard, false, other.constrained[previous(m)]});
  set_triangle(u2, {q, p, a}, {t, other.across[next(m)], u}, {hard, other.constrained[next(m)], false});
  replace_neighbour(old.across[next(k)], t, t2);
  replace_neighbour(other.across[next(m)], u, u2);
  suspects_.insert(suspects_.end(), {{t, 2}, {t2, 1}, {u, 2}, {u2, 1}});
}

// The quadrilateral p a q b with the diagonal a b gets the diagonal p q.
void PlanarTriangulation::flip(Side side) {
  const int t = side.triangle, k = side.corner;
  const Triangle old = triangles_[t];
  const int u = old.across[k];
  const int m = corner_against(u, t);
  const Triangle other = triangles_[u];
  const int p = old.vertex[k], a = old.vertex[next(k)], b = old.vertex[previous(k)], q = other.vertex[m];
  set_triangle(t, {p, a, q}, {other.across[next(m)], u, old.across[previous(k)]},
               {other.constrained[next(m)], false, old.constrained[previous(k)]});
  set_triangle(u, {p, q, b}, {other.across[previous(m)], old.across[next(k)], t},
               {other.constrained[previous(m)], old.constrained[next(k)], false});
  replace_neighbour(other.across[next(m)], u, t);
  replace_neighbour(old.across[next(k)], t, u);
}

bool PlanarTriangulation::is_delaunay(Side side) const {
  const Triangle& t = triangles_[side.triangle];
  const int u = t.across[side.corner];
  if (u < 0 || t.constrained[side.corner]) return true;
  const int q = triangles_[u].vertex[corner_against(u, side.triangle)];
  return !surely_in_circle(points_[t.vertex[0]], points_[t.vertex[1]], points_[t.vertex[2]], points_[q]);
}

void PlanarTriangulation::restore_delaunay() {
  while (!suspects_.empty()) {
    const Side side = suspects_.back();
    suspects_.pop_back();
    if (is_delaunay(side)) continue;
    const int u = triangles_[side.triangle].across[side.corner];
    flip(side);
    suspects_.insert(suspects_.end(), {{side.triangle, 0}, {side.triangle, 2}, {u, 0}, {u, 1}});
  }
}

PlanarTriangulation::Side PlanarTriangulation::find_side(int a, int b) const {
  const int start = first_triangle_[a];
  // Counterclockwise around a, and the other way if that ends at the border (a is one of the enclosing three).
  for (const bool counterclockwise : {true, false}) {
    int t = start;
    do {
      const Triangle& triangle = triangles_[t];
      const int k = triangle.vertex[0] == a ? 0 : triangle.vertex[1] == a ? 1 : 2;
      if (triangle.vertex[next(k)] == b) return {t, previous(k)};
      t = triangle.across[counterclockwise ? next(k) : previous(k)];
    } while (t != start && t >= 0);
    if (t >= 0) break;
  }
  return {-1, -1};
}

void PlanarTriangulation::constrain(int a, int b) {
  if (a == b) return;
  std::vector<std::array<int, 2>> rest{{a + 3, b + 3}};
  while (!rest.empty()) {
    const auto [from, to] = rest.back();
    rest.pop_back();
    constrain_piece(from, to, rest);
  }
}

// Makes a -> b an edge, or only its part up to the first vertex on it; the remainder is put on `rest`.
void PlanarTriangulation::constrain_piece(int a, int b, std::vector<std::array<int, 2>>& rest) {
  std::deque<std::array<int, 2>> crossed;
  if (find_side(a, b).triangle < 0) {
    // The triangle about a through which the segment leaves, or a vertex straight ahead.
    int t = first_triangle_[a], k = 0;
    for (;;) {
      const Triangle& triangle = triangles_[t];
      k = triangle.vertex[0] == a ? 0 : triangle.vertex[1] == a ? 1 : 2;
      const int x = triangle.vertex[next(k)], y = triangle.vertex[previous(k)];
      const double turn_x = orient2d(points_[a], points_[b], points_[x]);
      if (turn_x == 0 && glm::dot(points_[x] - points_[a], points_[b] - points_[a]) > 0) {
        rest.push_back({x, b});
        rest.push_back({a, x});
        return;
      }
      if (turn_x < 0 && orient2d(points_[a], points_[b], points_[y]) > 0) break;
      t = triangle.across[next(k)];
    }
    int target = b;
    for (;;) {
      const Triangle& triangle = triangles_[t];
      if (triangle.constrained[k]) throw std::invalid_argument("polygon sides cross");
      const int x = triangle.vertex[next(k)], y = triangle.vertex[previous(k)];
      crossed.push_back({x, y});
      const int u = triangle.across[k];
      const int m = corner_against(u, t);
      const int q = triangles_[u].vertex[m];
      if (q == b) break;
      const double turn = orient2d(points_[a], points_[b], points_[q]);
      if (turn == 0) {
        target = q;
        rest.push_back({q, b});
        break;
      }
      // u = (q, y, x): leave between x and q, which is opposite to y, or between q and y, opposite to x.
      t = u;
      k = turn > 0 ? next(m) : previous(m);
    }
    b = target;
  }

  std::vector<std::array<int, 2>> made;
  while (!crossed.empty()) {
    const auto [x, y] = crossed.front();
    crossed.pop_front();
    const Side side = find_side(x, y);
    const Triangle& t = triangles_[side.triangle];
    const int u = t.across[side.corner];
    const int p = t.vertex[side.corner], q = triangles_[u].vertex[corner_against(u, side.triangle)];
    const bool convex =
        orient2d(points_[p], points_[x], points_[q]) > 0 && orient2d(points_[q], points_[y], points_[p]) > 0;
    if (!convex) {
      crossed.push_back({x, y});
      continue;
    }
    flip(side);
    const bool crosses =
        p != a && p != b && q != a && q != b &&
        (orient2d(points_[a], points_[b], points_[p]) > 0) != (orient2d(points_[a], points_[b], points_[q]) > 0);
    (crosses ? crossed.push_back({p, q}) : made.push_back({p, q}));
  }

  const Side side = find_side(a, b);
  Triangle& left = triangles_[side.triangle];
  left.constrained[side.corner] = true;
  const int right = left.across[side.corner];
  triangles_[right].constrained[corner_against(right, side.triangle)] = true;
  constraints_.push_back({a, b});
  for (const auto& [p, q] : made) {
    const Side edge = find_side(p, q);
    if (edge.triangle >= 0) suspects_.push_back(edge);
  }
  restore_delaunay();
}

void PlanarTriangulation::keep_left() {
  std::vector<int> front;
  for (const auto& [a, b] : constraints_) {
    const int t = find_side(a, b).triangle;
    if (t < 0 || triangles_[t].inside) continue;
    triangles_[t].inside = true;
    front.push_back(t);
  }
  while (!front.empty()) {
    const Triangle t = triangles_[front.back()];
    front.pop_back();
    for (int k = 0; k < 3; ++k) {
      if (t.constrained[k] || t.across[k] < 0 || triangles_[t.across[k]].inside) continue;
      triangles_[t.across[k]].inside = true;
      front.push_back(t.across[k]);
    }
  }
}

std::vector<IndexTriangle> PlanarTriangulation::triangles() const {
  std::vector<IndexTriangle> result;
  for (const Triangle& t : triangles_) {
    const auto [a, b, c] = t.vertex;
    if (t.inside && a >= 3 && b >= 3 && c >= 3) result.push_back({a - 3, b - 3, c - 3});
  }
  return result;
}

std::vector<IndexTriangle> triangulate(std::span<const Vec2> points, const std::vector<std::vector<int>>& polygons) {
  if (points.empty()) return {};
  Vec2 lo = points[0], hi = points[0];
  for (const Vec2& p : points) {
    lo = glm::min(lo, p);
    hi = glm::max(hi, p);
  }
  PlanarTriangulation triangulation(lo, hi);
  // Points at the same place become one vertex, named by the first of them.
  std::vector<int> vertex(points.size());
  std::vector<int> source;
  for (size_t i = 0; i < points.size(); ++i) {
    vertex[i] = triangulation.insert(points[i]);
    if (vertex[i] == static_cast<int>(source.size())) source.push_back(static_cast<int>(i));
  }
  for (const std::vector<int>& polygon : polygons)
    for (size_t i = 0; i < polygon.size(); ++i)
      triangulation.constrain(vertex[polygon[i]], vertex[polygon[(i + 1) % polygon.size()]]);
  triangulation.keep_left();
  std::vector<IndexTriangle> result = triangulation.triangles();
  for (IndexTriangle& t : result)
    for (int& v : t) v = source[v];
  return result;
}

// The hull as a polygon by Andrew's monotone chains (1979), points on its sides included.
std::vector<IndexTriangle> delaunay(std::span<const Vec2> points) {
  std::vector<int> order(points.size());
  for (size_t i = 0; i < points.size(); ++i) order[i] = static_cast<int>(i);
  const auto before = [&](int a, int b) {
    return points[a].x != points[b].x ? points[a].x < points[b].x : points[a].y < points[b].y;
  };
  std::sort(order.begin(), order.end(), before);
  order.erase(std::unique(order.begin(), order.end(), [&](int a, int b) { return points[a] == points[b]; }),
              order.end());
  std::vector<int> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const size_t start = hull.size();
    for (int i : order) {
      while (hull.size() >= start + 2 && orient2d(points[hull[hull.size() - 2]], points[hull.back()], points[i]) < 0)
        hull.pop_back();
      hull.push_back(i);
    }
    if (!hull.empty()) hull.pop_back();
    std::reverse(order.begin(), order.end());
  }
  if (hull.size() < 3) return {};
  return triangulate(points, {hull});
}

}  // namespace lekalo::geometry
