#include "geometry/queries/contours/mesh_contours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "geometry/curves/analytic/polyline.h"

namespace lekalo::geometry {

namespace {

// Triangles whose normals differ by less lie in one plane: what rounding of points leaves.
constexpr double kOnePlane = 1e-6;
constexpr double kSameNormal = 1e-3;

// A triangle at a side, which it may run along from the second point to the first.
struct Beside {
  int triangle;
  bool backwards;
};
struct Side {
  int a, b;  // points, a < b
  std::vector<Beside> triangles;
};

// Numbers of points with the same coordinates; the first of each.
std::vector<int> merged_points(const Mesh& mesh) {
  std::vector<int> order(mesh.points.size()), merged(mesh.points.size());
  for (size_t k = 0; k < order.size(); ++k) order[k] = static_cast<int>(k);
  const auto key = [&](int k) { return std::tuple(mesh.points[k].x, mesh.points[k].y, mesh.points[k].z); };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
  for (size_t k = 0; k < order.size(); ++k)
    merged[order[k]] = k > 0 && key(order[k]) == key(order[k - 1]) ? merged[order[k - 1]] : order[k];
  return merged;
}

// `point`: of merged_points().
std::vector<Side> sides_of(const Mesh& mesh, const std::vector<int>& point) {
  std::vector<std::tuple<int, int, int, bool>> all;  // points, triangle, backwards
  for (size_t k = 0; k < mesh.triangles.size(); ++k)
    for (int i = 0; i < 3; ++i) {
      const int a = point[mesh.triangles[k].point[i]], b = point[mesh.triangles[k].point[(i + 1) % 3]];
      if (a != b) all.emplace_back(std::min(a, b), std::max(a, b), static_cast<int>(k), a > b);
    }
  std::sort(all.begin(), all.end());
  std::vector<Side> sides;
  for (const auto& [a, b, triangle, backwards] : all) {
    if (sides.empty() || sides.back().a != a || sides.back().b != b) sides.push_back({a, b, {}});
    sides.back().triangles.push_back({triangle, backwards});
  }
  return sides;
}

class Sorting {
 public:
  Sorting(const Mesh& mesh, const ViewOf& view, const std::vector<int>& points)
      : mesh_(mesh), view_(view), points_(points) {}

  std::vector<MeshLineKind> kinds_of(const Side& side) const {
    if (side.triangles.size() == 1) return {MeshLineKind::boundary};
    if (side.triangles.size() > 2) return {MeshLineKind::sharp};
    const Beside &one = side.triangles[0], &other = side.triangles[1];
    const Vec3 n = normal_of(one.triangle);
    // Of two triangles that run along their side the same way one is turned round.
    const Vec3 m = one.backwards == other.backwards ? -normal_of(other.triangle) : normal_of(other.triangle);
    const double angle = std::atan2(glm::length(glm::cross(n, m)), glm::dot(n, m));
    // Within one plane there is a line only between faces.
    if (angle < kOnePlane) {
      if (mesh_.triangles[one.triangle].face == mesh_.triangles[other.triangle].face) return {};
      return {MeshLineKind::smooth};
    }
    if (angle > kCreaseAngle || !share_normals(side)) return {MeshLineKind::sharp};
    if (faces_viewer(n, side) != faces_viewer(m, side)) return {MeshLineKind::smooth, MeshLineKind::silhouette};
    return {MeshLineKind::smooth};
  }

 private:
  Vec3 normal_of(int triangle) const {
    const auto& p = mesh_.triangles[triangle].point;
    const Vec3 across = glm::cross(mesh_.points[p[1]] - mesh_.points[p[0]], mesh_.points[p[2]] - mesh_.points[p[0]]);
    const double length = glm::length(across);
    return length > 0 ? across / length : Vec3(0);
  }

  bool share_normals(const Side& side) const {
    if (mesh_.normals.empty()) return true;
    for (const int point : {side.a, side.b}) {
      std::array<Vec3, 2> normals{Vec3(0), Vec3(0)};
      for (int k = 0; k < 2; ++k) {
        const Mesh::Triangle& triangle = mesh_.triangles[side.triangles[k].triangle];
        for (int i = 0; i < 3; ++i)
          if (points_[triangle.point[i]] == point && triangle.normal[i] >= 0)
            normals[k] = mesh_.normals[triangle.normal[i]];
      }
      if (glm::length(normals[0] - normals[1]) > kSameNormal) return false;
    }
    return true;
  }

  bool faces_viewer(const Vec3& normal, const Side& side) const {
    const Vec3 sight = view_.central ? mesh_.points[side.a] - view_.direction_or_eye : view_.direction_or_eye;
    return glm::dot(normal, sight) < 0;
  }

  const Mesh& mesh_;
  const ViewOf& view_;
  const std::vector<int>& points_;  // of merged_points()
};

// Sides between points that follow one another, as polylines: through every point at which just two of them meet.
std::vector<CurvePtr> chains(const std::vector<Vec3>& all, const std::vector<std::pair<int, int>>& sides) {
  std::vector<CurvePtr> lines;
  std::map<int, std::vector<int>> at;
  for (size_t k = 0; k < sides.size(); ++k)
    at[sides[k].first].push_back(static_cast<int>(k)), at[sides[k].second].push_back(static_cast<int>(k));
  std::vector<bool> used(sides.size(), false);
  const auto follow = [&](int side, int from) {
    std::vector<Vec3> points{all[from]};
    int point = from;
    while (side >= 0) {
      used[side] = true;
      point = sides[side].first == point ? sides[side].second : sides[side].first;
      points.push_back(all[point]);
      const std::vector<int>& here = at[point];
      side = here.size() != 2 ? -1 : used[here[0]] ? (used[here[1]] ? -1 : here[1]) : here[0];
    }
    const bool closed = point == from && points.size() > 3 && at[from].size() == 2;
    if (closed) points.pop_back();
    lines.push_back(std::make_shared<NurbsCurve>(polyline(points, closed)));
  };
  for (const auto& [point, here] : at)
    if (here.size() != 2)
      for (const int side : here)
        if (!used[side]) follow(side, point);
  for (size_t k = 0; k < sides.size(); ++k)
    if (!used[k]) follow(static_cast<int>(k), sides[k].first);
  return lines;
}

}  // namespace

std::vector<MeshLine> mesh_lines(const Mesh& mesh, const ViewOf& view) {
  const std::vector<int> points = merged_points(mesh);
  const Sorting sorting(mesh, view, points);
  std::map<MeshLineKind, std::vector<std::pair<int, int>>> of_kind;
  for (const Side& side : sides_of(mesh, points))
    for (const MeshLineKind kind : sorting.kinds_of(side)) of_kind[kind].emplace_back(side.a, side.b);
  std::vector<MeshLine> lines;
  for (const auto& [kind, sides] : of_kind)
    for (CurvePtr& curve : chains(mesh.points, sides)) lines.push_back({kind, std::move(curve)});
  return lines;
}

std::vector<CurvePtr> plane_section(const Mesh& mesh, const Vec3& origin, const Vec3& normal) {
  constexpr double kOnPlane = 1e-15;  // of the distances: points as near lie on it
  const Vec3 n = glm::normalize(normal);
  const std::vector<int> merged = merged_points(mesh);
  std::vector<double> height;  // 0: on the plane
  for (const Vec3& point : mesh.points) {
    const Vec3 from = point - origin;
    const double h = glm::dot(from, n);
    height.push_back(std::abs(h) <= kOnPlane * (glm::length(point) + glm::length(origin)) ? 0 : h);
  }
  // What is on the plane counts as above it, so that every triangle has two places where it goes through or none. A
  // place belongs to a side, or to the point at which that meets the plane.
  std::vector<Vec3> places;
  std::map<std::pair<int, int>, int> numbers;
  const auto place = [&](int a, int b) {
    if (height[a] == 0) b = a;
    if (height[b] == 0) a = b;
    const auto [known, is_new] = numbers.try_emplace(std::minmax(a, b), static_cast<int>(places.size()));
    if (is_new) {
      const auto& [p, q] = known->first;
      const double share = p == q ? 0 : height[p] / (height[p] - height[q]);
      places.push_back(mesh.points[p] + share * (mesh.points[q] - mesh.points[p]));
    }
    return known->second;
  };
  std::vector<std::pair<int, int>> sides;
  for (const Mesh::Triangle& triangle : mesh.triangles) {
    std::vector<int> ends;
    for (int i = 0; i < 3; ++i) {
      const int a = merged[triangle.point[i]], b = merged[triangle.point[(i + 1) % 3]];
      if ((height[a] < 0) != (height[b] < 0)) ends.push_back(place(a, b));
    }
    if (ends.size() == 2 && ends[0] != ends[1]) sides.push_back(std::minmax(ends[0], ends[1]));
  }
  // A side in the plane may be one of two triangles.
  std::sort(sides.begin(), sides.end());
  sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
  return chains(places, sides);
}

MeshTriangles::MeshTriangles(MeshPtr mesh) : mesh_(std::move(mesh)) {
  std::vector<Box3> boxes;
  for (const Mesh::Triangle& triangle : mesh_->triangles) {
    Box3 box;
    for (const int32_t point : triangle.point) box.include(mesh_->points[point]);
    bounds_.include(box.lo), bounds_.include(box.hi);
    boxes.push_back(box);
  }
  tree_ = BoxTree(boxes);
}

// Moeller and Trumbore (1997): o + t d = a + x (b - a) + y (c - a).
void MeshTriangles::add_crossings(const Line& line, const Interval& t, std::vector<double>& at) const {
  constexpr double kSlack = 1e-12;  // of a triangle: no line slips between two
  tree_.along(line, t, [&](int number) {
    const auto& p = mesh_->triangles[number].point;
    const Vec3 &a = mesh_->points[p[0]], ab = mesh_->points[p[1]] - a, ac = mesh_->points[p[2]] - a;
    const Vec3 across = glm::cross(line.direction, ac);
    const double volume = glm::dot(ab, across);
    if (volume == 0) return;
    const Vec3 from = line.origin - a;
    const double x = glm::dot(from, across) / volume;
    const Vec3 beside = glm::cross(from, ab);
    const double y = glm::dot(line.direction, beside) / volume;
    if (!(x >= -kSlack && y >= -kSlack && x + y <= 1 + kSlack)) return;
    const double place = glm::dot(ac, beside) / volume;
    if (t.contains(place)) at.push_back(place);
  });
}

}  // namespace lekalo::geometry
