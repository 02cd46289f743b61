// Edges of neighbours that cross no shorter one (greedy triangulation, Golovanov 2016, 8.6, in the tangent planes);
// then the faces of the rotation system that their order around each point is (Edmonds 1960): after the side from a to
// b comes that to the neighbour of b before a. Each side has one face on its left, so the surface is oriented.
#include "geometry/tessellation/cloud_triangulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "geometry/tessellation/cloud_normals.h"
#include "geometry/tessellation/predicates.h"

namespace lekalo::geometry {

namespace {

// Edges join points each of which is among so many nearest ones of the other.
constexpr int kNeighbours = 16;
// Edges rise no more than this out of the tangent planes of their ends (sine of the angle).
constexpr double kSteepest = 0.7;
// Edges at one point stand no nearer to each other (cosine, of 8 degrees).
constexpr double kNearestEdges = 0.99;

// So many nearest points lie beside a point in the surface, not in another part of it.
constexpr size_t kSurelyBeside = 3;

using Edge = std::pair<int, int>;

std::string place_of(std::span<const Vec3> points, int i) {
  return fmt::format("point {} at ({:.6g}, {:.6g}, {:.6g})", i, points[i].x, points[i].y, points[i].z);
}

struct TangentPlane {
  Vec3 x, y;
  explicit TangentPlane(const Vec3& normal) {
    const Vec3 a = glm::abs(normal);
    const Vec3 other = a.x <= a.y && a.x <= a.z ? Vec3(1, 0, 0) : a.y <= a.z ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
    x = glm::normalize(glm::cross(other, normal));
    y = glm::cross(normal, x);
  }
  Vec2 at(const Vec3& p) const { return {glm::dot(p, x), glm::dot(p, y)}; }
};

bool segments_meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const auto sign = [](double value) { return (value > 0) - (value < 0); };
  const int ac = sign(orient2d(a, b, c)), ad = sign(orient2d(a, b, d)), ca = sign(orient2d(c, d, a)),
            cb = sign(orient2d(c, d, b));
  if (ac == 0 && ad == 0) {  // on one line
    const auto along = [&](const Vec2& p) { return glm::dot(p - a, b - a); };
    const auto [lo, hi] = std::minmax(along(c), along(d));
    return hi > 0 && lo < along(b);
  }
  return ac * ad <= 0 && ca * cb <= 0;
}

class CloudEdges {
 public:
  CloudEdges(std::span<const Vec3> points, const CloudOptions& options)
      : points_(points), nearest_(nearest_neighbours(points, kNeighbours)), beside_(points.size()) {
    normals_ = estimated_normals(points, nearest_);
    check_sides();
    for (const auto& [length, edge] : candidates(options.longest))
      if (allows(edge)) {
        beside_[edge.first].push_back(edge.second);
        beside_[edge.second].push_back(edge.first);
      }
    for (size_t i = 0; i < points.size(); ++i) sort_around(static_cast<int>(i));
  }

  const std::vector<Vec3>& normals() const { return normals_; }
  // Counterclockwise around each point, seen from where its normal looks.
  const std::vector<std::vector<int>>& beside() const { return beside_; }

 private:
  // Normals that were turned alike from neighbour to neighbour agree wherever the surface has two sides.
  void check_sides() const {
    for (int a = 0; a < static_cast<int>(points_.size()); ++a)
      for (size_t k = 0; k < std::min(nearest_[a].size(), kSurelyBeside); ++k) {
        const int b = nearest_[a][k];
        if (glm::dot(normals_[a], normals_[b]) < -kSteepest && is_along(a, b))
          throw std::invalid_argument(
              fmt::format("the normals of {} and of {} beside it are opposite: the surface has one side alone, or two "
                          "parts of it are nearer to each other than points of one",
                          place_of(points_, a), place_of(points_, b)));
      }
  }

  bool is_along(int a, int b) const {
    const Vec3 d = points_[b] - points_[a];
    const double steepest = kSteepest * glm::length(d);
    return std::abs(glm::dot(d, normals_[a])) <= steepest && std::abs(glm::dot(d, normals_[b])) <= steepest;
  }

  bool is_near(int a, int b) const { return std::find(nearest_[a].begin(), nearest_[a].end(), b) != nearest_[a].end(); }

  std::vector<std::pair<double, Edge>> candidates(double longest) const {
    std::vector<std::pair<double, Edge>> result;
    for (int a = 0; a < static_cast<int>(points_.size()); ++a)
      for (const int b : nearest_[a]) {
        const double length = glm::length(points_[b] - points_[a]);
        if (a < b && is_near(b, a) && length <= longest && is_along(a, b)) result.push_back({length, {a, b}});
      }
    std::sort(result.begin(), result.end());
    return result;
  }

  // Shorter edges that cross this one begin at a neighbour of its ends.
  bool allows(const Edge& e) const {
    const auto [a, b] = e;
    if (glm::dot(normals_[a], normals_[b]) <= 0) return false;
    const auto allowed_at = [&](int c) {
      for (const int d : beside_[c])
        if (glm::dot(normals_[c], normals_[a]) > 0 && glm::dot(normals_[d], normals_[a]) > 0 && meet(e, {c, d}))
          return false;
      return true;
    };
    if (!allowed_at(a) || !allowed_at(b)) return false;
    return std::all_of(nearest_[a].begin(), nearest_[a].end(), allowed_at) &&
           std::all_of(nearest_[b].begin(), nearest_[b].end(), allowed_at);
  }

  bool meet(const Edge& e, const Edge& f) const {
    const Vec3 sum = normals_[e.first] + normals_[e.second] + normals_[f.first] + normals_[f.second];
    const TangentPlane plane(glm::normalize(sum));
    const auto at = [&](int i) { return plane.at(points_[i] - points_[e.first]); };
    const auto [a, b] = e;
    const auto [c, d] = f;
    for (const auto& [end, own, other] : {std::tuple(a == c, b, d), std::tuple(a == d, b, c)})
      if (end) return too_near(at(own) - at(a), at(other) - at(a));
    for (const auto& [end, own, other] : {std::tuple(b == c, a, d), std::tuple(b == d, a, c)})
      if (end) return too_near(at(own) - at(b), at(other) - at(b));
    return segments_meet(at(a), at(b), at(c), at(d));
  }

  static bool too_near(const Vec2& a, const Vec2& b) {
    return glm::dot(a, b) > kNearestEdges * glm::length(a) * glm::length(b);
  }

  void sort_around(int i) {
    const TangentPlane plane(normals_[i]);
    const auto angle = [&](int j) {
      const Vec2 d = plane.at(points_[j] - points_[i]);
      return std::atan2(d.y, d.x);
    };
    std::sort(beside_[i].begin(), beside_[i].end(), [&](int j, int k) { return angle(j) < angle(k); });
  }

  std::span<const Vec3> points_;
  std::vector<std::vector<int>> nearest_;
  std::vector<Vec3> normals_;
  std::vector<std::vector<int>> beside_;
};

std::vector<std::vector<int>> faces_of(const std::vector<std::vector<int>>& beside) {
  std::set<Edge> used;
  std::vector<std::vector<int>> faces;
  for (int i = 0; i < static_cast<int>(beside.size()); ++i)
    for (const int j : beside[i]) {
      std::vector<int> face;
      for (Edge side{i, j}; used.insert(side).second;) {
        face.push_back(side.first);
        const std::vector<int>& around = beside[side.second];
        const auto back = std::find(around.begin(), around.end(), side.first);
        side = {side.second, back == around.begin() ? around.back() : *std::prev(back)};
      }
      if (!face.empty()) faces.push_back(std::move(face));
    }
  return faces;
}

// The triangles of a face that is nearly plane; nothing of one that runs round a border.
std::vector<IndexTriangle> triangles_of_face(std::span<const Vec3> points, const std::vector<Vec3>& normals,
                                             const std::vector<int>& face) {
  Vec3 sum(0);
  for (const int i : face) sum += normals[i];
  if (!(glm::length(sum) > 0)) return {};
  const TangentPlane plane(glm::normalize(sum));
  std::vector<Vec2> corners;
  std::vector<int> order;
  for (const int i : face) {
    if (glm::dot(normals[i], sum) <= 0) return {};
    order.push_back(static_cast<int>(corners.size()));
    corners.push_back(plane.at(points[i] - points[face.front()]));
  }
  double area = 0;
  for (size_t k = 0; k < corners.size(); ++k) {
    const Vec2 &a = corners[k], &b = corners[(k + 1) % corners.size()];
    area += a.x * b.y - a.y * b.x;
  }
  if (!(area > 0) || std::set<int>(face.begin(), face.end()).size() < face.size()) return {};
  std::vector<IndexTriangle> result;
  try {
    for (const IndexTriangle& t : triangulate(corners, {{order}}))
      result.push_back({face[t[0]], face[t[1]], face[t[2]]});
  } catch (const std::invalid_argument&) {
    return {};  // its sides cross in the plane: it stays open
  }
  return result.size() == face.size() - 2 ? result : std::vector<IndexTriangle>();
}

}  // namespace

std::vector<IndexTriangle> triangulation_of_cloud(std::span<const Vec3> points, const CloudOptions& options) {
  if (points.size() < 4) throw std::invalid_argument("a surface needs four points at least");
  const CloudEdges edges(points, options);
  for (size_t i = 0; i < points.size(); ++i)
    if (edges.beside()[i].size() < 2)
      throw std::invalid_argument(fmt::format("{} has {} to be joined with", place_of(points, static_cast<int>(i)),
                                              edges.beside()[i].empty() ? "no point" : "one point"));
  std::vector<IndexTriangle> result;
  std::set<int> on_border;
  for (const std::vector<int>& face : faces_of(edges.beside())) {
    const bool is_small = face.size() <= static_cast<size_t>(options.largest_hole);
    const std::vector<IndexTriangle> filled =
        is_small ? triangles_of_face(points, edges.normals(), face) : std::vector<IndexTriangle>();
    result.insert(result.end(), filled.begin(), filled.end());
    if (!filled.empty()) continue;
    for (const int i : face)
      if (!on_border.insert(i).second)
        throw std::invalid_argument(
            fmt::format("at {} parts of the surface touch in this point alone: the points are "
                        "too far apart there",
                        place_of(points, i)));
  }
  return result;
}

}  // namespace lekalo::geometry
