#include "geometry/tessellation/planar_triangulations.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "geometry/tessellation/predicates.h"

namespace lekalo::geometry {

namespace {

using Edge = std::pair<int, int>;  // smaller index first

Edge edge(int a, int b) { return std::minmax(a, b); }

// Whether c, on the line of a and b, lies between them.
bool is_between(const Vec2& a, const Vec2& b, const Vec2& c) {
  return orient2d(a, b, c) == 0 && glm::dot(c - a, c - b) < 0;
}

// Whether two segments have more in common than end points.
bool cross(std::span<const Vec2> p, const Edge& s, const Edge& t) {
  const Vec2 &a = p[s.first], &b = p[s.second], &c = p[t.first], &d = p[t.second];
  if (s == t || is_between(a, b, c) || is_between(a, b, d) || is_between(c, d, a) || is_between(c, d, b)) return true;
  const double c_side = orient2d(a, b, c), d_side = orient2d(a, b, d);
  const double a_side = orient2d(c, d, a), b_side = orient2d(c, d, b);
  return ((c_side > 0 && d_side < 0) || (c_side < 0 && d_side > 0)) &&
         ((a_side > 0 && b_side < 0) || (a_side < 0 && b_side > 0));
}

std::vector<int> distinct(std::span<const Vec2> points) {
  std::map<std::pair<double, double>, int> first;
  std::vector<int> result;
  for (int i = 0; i < static_cast<int>(points.size()); ++i)
    if (first.emplace(std::pair(points[i].x, points[i].y), i).second) result.push_back(i);
  return result;
}

bool encloses(std::span<const Vec2> p, const IndexTriangle& t, const std::vector<int>& vertices) {
  return std::any_of(vertices.begin(), vertices.end(), [&](int v) {
    if (v == t[0] || v == t[1] || v == t[2]) return false;
    return orient2d(p[t[0]], p[t[1]], p[v]) > 0 && orient2d(p[t[1]], p[t[2]], p[v]) > 0 &&
           orient2d(p[t[2]], p[t[0]], p[v]) > 0;
  });
}

// The empty triangles that edges make.
std::vector<IndexTriangle> triangles_of(std::span<const Vec2> p, const std::set<Edge>& edges,
                                        const std::vector<int>& vertices) {
  std::map<int, std::set<int>> beyond;  // the neighbours of a vertex that come after it
  for (const auto& [a, b] : edges) beyond[a].insert(b);
  std::vector<IndexTriangle> result;
  for (const auto& [a, b] : edges)
    for (const int c : beyond[b]) {
      if (!beyond[a].count(c)) continue;
      const double side = orient2d(p[a], p[b], p[c]);
      const IndexTriangle t = side > 0 ? IndexTriangle{a, b, c} : IndexTriangle{a, c, b};
      if (side != 0 && !encloses(p, t, vertices)) result.push_back(t);
    }
  return result;
}

// How many points lie on the border of the convex hull, between its corners too (Andrew 1979).
size_t count_on_hull(std::span<const Vec2> p, std::vector<int> vertices) {
  std::sort(vertices.begin(), vertices.end(),
            [&](int a, int b) { return std::pair(p[a].x, p[a].y) < std::pair(p[b].x, p[b].y); });
  std::set<int> on_hull;
  for (const double side : {1.0, -1.0}) {
    std::vector<int> chain;
    for (const int v : vertices) {
      while (chain.size() > 1 && side * orient2d(p[chain[chain.size() - 2]], p[chain.back()], p[v]) < 0)
        chain.pop_back();
      chain.push_back(v);
    }
    on_hull.insert(chain.begin(), chain.end());
  }
  return on_hull.size();
}

// Edges that do not cross each other, and the vertices, by the cells of a grid that they may lie in.
class KeptEdges {
 public:
  KeptEdges(std::span<const Vec2> points, const std::vector<int>& vertices) : points_(points) {
    Vec2 hi(-kInfinity);
    lo_ = Vec2(kInfinity);
    for (const int v : vertices) lo_ = glm::min(lo_, points[v]), hi = glm::max(hi, points[v]);
    side_ = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(vertices.size()))));
    const Vec2 size = hi - lo_;
    cell_ = Vec2(size.x > 0 ? size.x / side_ : 1, size.y > 0 ? size.y / side_ : 1);
    cells_.resize(static_cast<size_t>(side_) * side_);
    for (const int v : vertices) {
      const Vec2 at = in_cells(v);
      cells_[number(column(at.x), column(at.y))].vertices.push_back(v);
    }
  }

  const std::set<Edge>& edges() const { return edges_; }

  // Whether an edge crosses no other one and goes through no vertex.
  bool allows(const Edge& e) const {
    return each_cell(e, [&](size_t number) {
      const Cell& cell = cells_[number];
      return std::none_of(cell.edges.begin(), cell.edges.end(),
                          [&](const Edge& other) { return cross(points_, e, other); }) &&
             std::none_of(cell.vertices.begin(), cell.vertices.end(),
                          [&](int v) { return is_between(points_[e.first], points_[e.second], points_[v]); });
    });
  }
  void add(const Edge& e) {
    edges_.insert(e);
    each_cell(e, [&](size_t number) {
      cells_[number].edges.push_back(e);
      return true;
    });
  }

 private:
  struct Cell {
    std::vector<Edge> edges;
    std::vector<int> vertices;
  };

  // Coordinates in units of the cells, and the cell that holds one.
  Vec2 in_cells(int v) const { return (points_[v] - lo_) / cell_; }
  int column(double x) const { return std::clamp(static_cast<int>(std::floor(x)), 0, side_ - 1); }
  size_t number(int i, int j) const { return static_cast<size_t>(i) * side_ + j; }

  // Visits all cells that a segment may lie in, until one says no.
  template <class Visit>
  bool each_cell(const Edge& e, const Visit& visit) const {
    constexpr double kRounding = 1e-6;
    Vec2 a = in_cells(e.first), b = in_cells(e.second);
    if (a.x > b.x) std::swap(a, b);
    for (int i = column(a.x - kRounding); i <= column(b.x + kRounding); ++i) {
      // What of the segment lies over this column.
      const auto height = [&](double x) {
        return b.x - a.x > kRounding ? a.y + (b.y - a.y) * std::clamp((x - a.x) / (b.x - a.x), 0.0, 1.0) : a.y;
      };
      double lo = std::min(height(i - kRounding), height(i + 1 + kRounding)),
             hi = std::max(height(i - kRounding), height(i + 1 + kRounding));
      if (!(b.x - a.x > kRounding)) lo = std::min(a.y, b.y), hi = std::max(a.y, b.y);
      for (int j = column(lo - kRounding); j <= column(hi + kRounding); ++j)
        if (!visit(number(i, j))) return false;
    }
    return true;
  }

  std::span<const Vec2> points_;
  Vec2 lo_, cell_;
  int side_ = 1;
  std::vector<Cell> cells_;
  std::set<Edge> edges_;
};

// Triangles by their sides in the direction in which they run.
std::map<Edge, int> corner_over(const std::vector<IndexTriangle>& triangles) {
  std::map<Edge, int> result;
  for (const IndexTriangle& t : triangles)
    for (size_t k = 0; k < 3; ++k) result[{t[k], t[(k + 1) % 3]}] = t[(k + 2) % 3];
  return result;
}

// A diagonal a b that may become c d: c left of it, d right.
struct Flip {
  int a, b, c, d;
};

std::vector<Flip> possible_flips(std::span<const Vec2> p, const std::vector<IndexTriangle>& triangles) {
  const std::map<Edge, int> corners = corner_over(triangles);
  std::vector<Flip> result;
  for (const auto& [side, c] : corners) {
    const auto [a, b] = side;
    const auto other = corners.find({b, a});
    if (a > b || other == corners.end()) continue;
    const int d = other->second;
    if (orient2d(p[c], p[d], p[b]) > 0 && orient2d(p[c], p[d], p[a]) < 0) result.push_back({a, b, c, d});
  }
  return result;
}

IndexTriangle from_least(int a, int b, int c) {
  IndexTriangle t{a, b, c};
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

// In a normal form: sorted.
std::vector<IndexTriangle> flipped(std::vector<IndexTriangle> triangles, const Flip& f) {
  for (IndexTriangle& t : triangles) t = from_least(t[0], t[1], t[2]);
  const IndexTriangle left = from_least(f.a, f.b, f.c), right = from_least(f.b, f.a, f.d);
  std::replace(triangles.begin(), triangles.end(), left, from_least(f.a, f.d, f.c));
  std::replace(triangles.begin(), triangles.end(), right, from_least(f.b, f.c, f.d));
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

double length_of_edges(std::span<const Vec2> p, const std::vector<IndexTriangle>& triangles) {
  std::set<Edge> edges;
  for (const IndexTriangle& t : triangles)
    for (size_t k = 0; k < 3; ++k) edges.insert(edge(t[k], t[(k + 1) % 3]));
  double sum = 0;
  for (const auto& [a, b] : edges) sum += glm::length(p[a] - p[b]);
  return sum;
}

// The front of algorithm 5: directed edges with the region on their left, and the vertices that may still be joined.
class Front {
 public:
  Front(std::span<const Vec2> points, const std::vector<std::vector<int>>& polygons) : points_(points) {
    std::set<int> on_polygons;
    for (const std::vector<int>& polygon : polygons)
      for (size_t i = 0; i < polygon.size(); ++i) {
        active_.push_back({polygon[i], polygon[(i + 1) % polygon.size()]});
        on_polygons.insert(polygon[i]);
      }
    // The region's own triangles tell which points lie inside, and that polygons are in order.
    for (const IndexTriangle& t : triangulate(points, polygons)) vertices_.insert(t.begin(), t.end());
    if (vertices_.empty()) throw std::invalid_argument("the polygons have no region on their left");
    for (const int v : vertices_)
      if (!on_polygons.count(v)) inner_.insert(v);
  }

  bool is_done() const { return active_.empty(); }

  // One triangle over the first edge that allows one with its nearest vertex, else with any.
  IndexTriangle advance() {
    for (const bool nearest_alone : {true, false})
      for (size_t i = 0; i < active_.size(); ++i)
        for (const int v : candidates(active_[i])) {
          if (is_possible(active_[i], v)) return build(i, v);
          if (nearest_alone) break;
        }
    throw std::invalid_argument("the polygons leave a region that has no triangles: they touch or cross");
  }

 private:
  // Active vertices left of an edge, the nearest first; ties by index.
  std::vector<int> candidates(const Edge& e) const {
    std::vector<std::pair<double, int>> found;
    for (const int v : vertices_)
      if (orient2d(points_[e.first], points_[e.second], points_[v]) > 0)
        found.push_back({circumcenter_parameter(points_[e.first], points_[e.second], points_[v]), v});
    std::sort(found.begin(), found.end());
    std::vector<int> result;
    for (const auto& [t, v] : found) result.push_back(v);
    return result;
  }

  bool is_possible(const Edge& e, int v) const {
    if (encloses(points_, {e.first, e.second, v}, {vertices_.begin(), vertices_.end()})) return false;
    for (const Edge& side : {Edge(e.second, v), Edge(v, e.first)}) {
      if (is_active(side)) continue;
      for (const Edge& other : active_)
        if (edge(other.first, other.second) == edge(side.first, side.second) || cross(points_, side, other))
          return false;
      for (const int inner : inner_)
        if (is_between(points_[side.first], points_[side.second], points_[inner])) return false;
    }
    return true;
  }

  bool is_active(const Edge& e) const { return std::find(active_.begin(), active_.end(), e) != active_.end(); }

  IndexTriangle build(size_t i, int v) {
    const auto [a, b] = active_[i];
    active_.erase(active_.begin() + static_cast<std::ptrdiff_t>(i));
    inner_.erase(v);
    // Sides b v and v a of the triangle: on the front they end there, else the front goes on along their other side.
    for (const Edge& side : {Edge(b, v), Edge(v, a)}) {
      const auto found = std::find(active_.begin(), active_.end(), side);
      if (found != active_.end())
        active_.erase(found);
      else
        active_.push_back({side.second, side.first});
    }
    // A vertex counts no more when no active edge meets it.
    for (const int w : {a, b, v})
      if (std::none_of(active_.begin(), active_.end(), [&](const Edge& e) { return e.first == w || e.second == w; }))
        vertices_.erase(w);
    return {a, b, v};
  }

  std::span<const Vec2> points_;
  std::vector<Edge> active_;
  std::set<int> vertices_, inner_;
};

}  // namespace

double circumcenter_parameter(const Vec2& a, const Vec2& b, const Vec2& v) {
  const Vec2 from_a = v - a, from_b = v - b, side = b - a;
  const double area = from_b.y * side.x - from_b.x * side.y;
  return area == 0 ? kInfinity : 0.5 * glm::dot(from_b, from_a) / area;
}

std::vector<std::pair<int, int>> greedy_edges(std::span<const Vec2> points) {
  const std::vector<int> vertices = distinct(points);
  std::vector<std::pair<double, Edge>> pairs;
  for (const int a : vertices)
    for (const int b : vertices)
      if (a < b) pairs.push_back({glm::length(points[a] - points[b]), {a, b}});
  std::sort(pairs.begin(), pairs.end());
  // All triangulations have so many edges, those of points on one line less.
  const size_t all = 3 * vertices.size() - 3 - count_on_hull(points, vertices);
  KeptEdges kept(points, vertices);
  std::vector<Edge> result;
  for (const auto& [length, e] : pairs) {
    if (result.size() == all) break;
    if (!kept.allows(e)) continue;
    kept.add(e);
    result.push_back(e);
  }
  return result;
}

std::vector<IndexTriangle> greedy_triangulation(std::span<const Vec2> points, std::optional<int> steps) {
  std::vector<Edge> edges = greedy_edges(points);
  if (steps && static_cast<size_t>(*steps) < edges.size()) edges.resize(static_cast<size_t>(*steps));
  return triangles_of(points, {edges.begin(), edges.end()}, distinct(points));
}

std::vector<IndexTriangle> optimal_triangulation(std::span<const Vec2> points, std::optional<int> steps) {
  if (points.size() > kMaxOptimalPoints)
    throw std::invalid_argument(
        "the optimal triangulation is sought among all: that takes too long for so many points");
  using Triangles = std::vector<IndexTriangle>;
  Triangles start = greedy_triangulation(points);
  for (IndexTriangle& t : start) t = from_least(t[0], t[1], t[2]);
  std::sort(start.begin(), start.end());
  // Each with the one that a flip led from, by as few flips as can be.
  std::map<Triangles, Triangles> before{{start, {}}};
  std::vector<Triangles> reached{start};
  std::pair<double, Triangles> best{length_of_edges(points, start), start};
  for (size_t k = 0; k < reached.size(); ++k) {
    const Triangles here = reached[k];
    for (const Flip& flip : possible_flips(points, here)) {
      Triangles next = flipped(here, flip);
      if (!before.emplace(next, here).second) continue;
      best = std::min(best, {length_of_edges(points, next), next});
      reached.push_back(std::move(next));
    }
  }
  std::vector<Triangles> way{best.second};
  while (way.back() != start) way.push_back(before.at(way.back()));
  const size_t flips = way.size() - 1;
  return way[flips - std::min(flips, steps ? static_cast<size_t>(*steps) : flips)];
}

std::vector<IndexTriangle> triangulation_by_flips(std::span<const Vec2> points, std::optional<int> steps) {
  std::vector<IndexTriangle> result = greedy_triangulation(points);
  for (int done = 0; !steps || done < *steps; ++done) {
    const std::vector<Flip> flips = possible_flips(points, result);
    const auto bad = std::find_if(flips.begin(), flips.end(), [&](const Flip& f) {
      return surely_in_circle(points[f.a], points[f.b], points[f.c], points[f.d]);
    });
    if (bad == flips.end()) break;
    result = flipped(std::move(result), *bad);
  }
  return result;
}

std::vector<IndexTriangle> advancing_front(std::span<const Vec2> points, const std::vector<std::vector<int>>& polygons,
                                           std::optional<int> steps) {
  Front front(points, polygons);
  std::vector<IndexTriangle> result;
  while (!front.is_done() && (!steps || static_cast<int>(result.size()) < *steps)) result.push_back(front.advance());
  return result;
}

}  // namespace lekalo::geometry
