// A corner of n faces that no longer meet in one point opens to n - 2 vertices of three faces each, and n - 3 edges: a
// triangulation of the n-gon whose corners are the faces and whose sides are the edges of the corner (Golovanov 2016,
// 6.7). It is the right one where in no face the lines that bound it cross.
#include "geometry/bodies/local/corner_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace lekalo::geometry {

namespace {

constexpr size_t kMaxSectors = 8;

using Triangles = std::vector<std::array<int, 3>>;

// Of the polygon's corners from i to j, with the side (i, j).
void each_triangulation(int i, int j, const std::function<void(const Triangles&)>& visit) {
  if (j - i < 2) return visit({});
  for (int m = i + 1; m < j; ++m)
    each_triangulation(i, m, [&](const Triangles& left) {
      each_triangulation(m, j, [&](const Triangles& right) {
        Triangles all = left;
        all.insert(all.end(), right.begin(), right.end());
        all.push_back({i, m, j});
        visit(all);
      });
    });
}

bool cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const auto side = [](const Vec2& p, const Vec2& q, const Vec2& r) {
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
  };
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

// The points of a sector's border from the spoke after it to the spoke before it.
std::vector<Vec3> border_of(const CornerTree& tree, int sector, int count) {
  int at = tree.of_spoke[sector];
  const int last = tree.of_spoke[(sector + count - 1) % count];
  std::vector<Vec3> points{tree.points[at]};
  std::vector<char> used(tree.joints.size(), 0);
  while (at != last) {
    size_t found = tree.joints.size();
    for (size_t k = 0; k < tree.joints.size(); ++k) {
      const CornerTree::Joint& j = tree.joints[k];
      if (!used[k] && (j.sectors[0] == sector || j.sectors[1] == sector) && (j.from == at || j.to == at)) found = k;
    }
    if (found == tree.joints.size()) break;
    used[found] = 1;
    at = tree.joints[found].from == at ? tree.joints[found].to : tree.joints[found].from;
    points.push_back(tree.points[at]);
  }
  return points;
}

bool is_simple(const CornerTree& tree, const std::vector<SectorSurface>& sectors) {
  const auto count = static_cast<int>(sectors.size());
  for (int i = 0; i < count; ++i) {
    std::vector<Vec3> line = border_of(tree, i, count);
    const int before = (i + count - 1) % count;
    // Along the lines where the face meets its neighbours, as far as the old edges went.
    const auto end_of = [&](const Vec3& p, const Vec3& old, int neighbour) -> std::optional<Vec3> {
      const Vec3 along = glm::cross(sectors[i].normal, sectors[neighbour].normal);
      if (!(glm::length(along) > 1e-9)) return old;
      const Vec3 d = glm::normalize(along);
      return p + glm::dot(old - p, d) * d;
    };
    const Frame plane = frame_about(line.front(), sectors[i].normal);
    std::vector<Vec2> flat{Vec2(plane.to_local_point(*end_of(line.front(), sectors[i].spoke_to, (i + 1) % count)))};
    for (const Vec3& p : line) flat.push_back(Vec2(plane.to_local_point(p)));
    flat.push_back(Vec2(plane.to_local_point(*end_of(line.back(), sectors[before].spoke_to, before))));
    for (size_t a = 0; a + 1 < flat.size(); ++a)
      for (size_t b = a + 2; b + 1 < flat.size(); ++b)
        if (cross(flat[a], flat[a + 1], flat[b], flat[b + 1])) return false;
  }
  return true;
}

std::optional<CornerTree> tree_of(const Triangles& triangles, const std::vector<SectorSurface>& sectors, double size) {
  const auto count = static_cast<int>(sectors.size());
  CornerTree tree;
  tree.of_spoke.assign(count, -1);
  std::vector<std::vector<int>> with(static_cast<size_t>(count) * count);
  for (const auto& [i, m, j] : triangles) {
    if (sectors[i].face == sectors[m].face || sectors[m].face == sectors[j].face || sectors[i].face == sectors[j].face)
      return std::nullopt;
    const auto p = common_point({sectors[i].on, sectors[m].on, sectors[j].on}, size);
    if (!p) return std::nullopt;
    const auto number = static_cast<int>(tree.points.size());
    tree.points.push_back(*p);
    for (const auto& [a, b] : {std::pair(i, m), std::pair(m, j), std::pair(i, j)})
      with[a * count + b].push_back(number);
  }
  for (int a = 0; a < count; ++a)
    for (int b = a + 1; b < count; ++b) {
      const std::vector<int>& ends = with[a * count + b];
      if (ends.empty()) continue;
      if (b == a + 1)
        tree.of_spoke[a] = ends[0];
      else if (a == 0 && b == count - 1)
        tree.of_spoke[b] = ends[0];
      else
        tree.joints.push_back({{a, b}, ends[0], ends[1]});
    }
  return tree;
}

// Joints without length taken out.
void contract(CornerTree& tree, double small) {
  std::vector<int> same(tree.points.size());
  for (size_t k = 0; k < same.size(); ++k) same[k] = static_cast<int>(k);
  std::vector<CornerTree::Joint> joints;
  for (const CornerTree::Joint& j : tree.joints) {
    if (glm::length(tree.points[j.to] - tree.points[j.from]) > small) {
      joints.push_back(j);
      continue;
    }
    const int from = same[j.from], to = same[j.to];
    for (int& p : same)
      if (p == to) p = from;
  }
  for (CornerTree::Joint& j : joints) j.from = same[j.from], j.to = same[j.to];
  for (int& p : tree.of_spoke) p = same[p];
  tree.joints = std::move(joints);
}

}  // namespace

std::optional<CornerTree> corner_tree(const std::vector<SectorSurface>& sectors, double size) {
  const auto count = static_cast<int>(sectors.size());
  if (sectors.size() < 3 || sectors.size() > kMaxSectors) return std::nullopt;
  std::optional<CornerTree> best;
  double shortest = kInfinity;
  each_triangulation(0, count - 1, [&](const Triangles& triangles) {
    auto tree = tree_of(triangles, sectors, size);
    if (!tree) return;
    contract(*tree, 1e-11 * size);
    double longest = 0;
    for (const CornerTree::Joint& j : tree->joints)
      longest = std::max(longest, glm::length(tree->points[j.to] - tree->points[j.from]));
    if (longest < shortest && is_simple(*tree, sectors)) {
      best = tree;
      shortest = longest;
    }
  });
  return best;
}

}  // namespace lekalo::geometry
