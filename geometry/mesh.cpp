#include "geometry/mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace lekalo::geometry {

namespace {

Vec3 point(const Mesh& mesh, const Mesh::Triangle& t, int corner) { return mesh.points[t.point[corner]]; }

// Twice the area times the unit normal.
Vec3 area_vector(const Mesh& mesh, const Mesh::Triangle& t) {
  const Vec3 a = point(mesh, t, 0);
  return glm::cross(point(mesh, t, 1) - a, point(mesh, t, 2) - a);
}

double corner_angle(const Mesh& mesh, const Mesh::Triangle& t, int corner) {
  const Vec3 p = point(mesh, t, corner);
  const Vec3 a = point(mesh, t, (corner + 1) % 3) - p, b = point(mesh, t, (corner + 2) % 3) - p;
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

Vec3 unit_or(const Vec3& v, const Vec3& otherwise) {
  const double length = glm::length(v);
  return length > 0 ? v / length : otherwise;
}

// Disjoint sets over corners.
class Groups {
 public:
  explicit Groups(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  uint32_t find(uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(uint32_t a, uint32_t b) { parent_[find(a)] = find(b); }

 private:
  std::vector<uint32_t> parent_;
};

}  // namespace

Box3 bounds(const Mesh& mesh) {
  Box3 box;
  for (const Mesh::Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) box.include(point(mesh, t, k));
  return box;
}

MeshSides sides(const Mesh& mesh) {
  // Per side: how often it runs up (from the smaller index) and down.
  struct Uses {
    int up = 0, down = 0;
  };
  std::unordered_map<uint64_t, Uses> used;
  used.reserve(2 * mesh.triangles.size());
  MeshSides result;
  for (const Mesh::Triangle& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const uint32_t a = t.point[k], b = t.point[(k + 1) % 3];
      Uses& uses = used[(static_cast<uint64_t>(std::min(a, b)) << 32) | std::max(a, b)];
      if (uses.up + uses.down == 0) result.length += glm::length(mesh.points[a] - mesh.points[b]);
      ++(a < b ? uses.up : uses.down);
    }
  }
  result.count = used.size();
  for (const auto& [side, uses] : used) {
    if (uses.up + uses.down == 1)
      ++result.free;
    else if (uses.up + uses.down > 2)
      ++result.crowded;
    else if (uses.up != uses.down)
      ++result.turned;
  }
  return result;
}

bool is_closed(const Mesh& mesh) { return sides(mesh).closed(); }

void set_flat_normals(Mesh& mesh) {
  mesh.normals.clear();
  mesh.normals.reserve(mesh.triangles.size());
  for (Mesh::Triangle& t : mesh.triangles) {
    t.normal.fill(static_cast<int32_t>(mesh.normals.size()));
    mesh.normals.push_back(unit_or(area_vector(mesh, t), Vec3(0, 0, 1)));
  }
}

void set_smooth_normals(Mesh& mesh, double crease_angle) {
  const size_t count = mesh.triangles.size();
  std::vector<Vec3> facet(count);
  for (size_t i = 0; i < count; ++i) facet[i] = unit_or(area_vector(mesh, mesh.triangles[i]), Vec3(0));

  // Corners at one point share a normal when they are connected by sides that are not creases.
  Groups groups(3 * count);
  struct Use {
    uint32_t triangle;
    int corner;  // the side runs from here to the next corner
  };
  std::unordered_map<uint64_t, Use> sides;
  sides.reserve(3 * count / 2);
  const double cosine = std::cos(crease_angle);
  for (uint32_t i = 0; i < count; ++i) {
    for (int k = 0; k < 3; ++k) {
      const auto& p = mesh.triangles[i].point;
      const uint32_t a = p[k], b = p[(k + 1) % 3];
      const uint64_t key = (static_cast<uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
      const auto [found, is_new] = sides.try_emplace(key, Use{i, k});
      if (is_new) continue;
      const Use other = found->second;
      if (glm::dot(facet[i], facet[other.triangle]) < cosine) continue;
      const auto& q = mesh.triangles[other.triangle].point;
      const int first = other.corner, second = (other.corner + 1) % 3;
      const bool same_way = q[first] == p[k];
      groups.join(3 * i + k, 3 * other.triangle + (same_way ? first : second));
      groups.join(3 * i + (k + 1) % 3, 3 * other.triangle + (same_way ? second : first));
    }
  }
  std::vector<Vec3> sum(3 * count, Vec3(0));
  for (uint32_t i = 0; i < count; ++i)
    for (int k = 0; k < 3; ++k) sum[groups.find(3 * i + k)] += corner_angle(mesh, mesh.triangles[i], k) * facet[i];
  mesh.normals.clear();
  std::vector<int32_t> index(3 * count, -1);
  for (uint32_t i = 0; i < count; ++i) {
    for (int k = 0; k < 3; ++k) {
      const uint32_t group = groups.find(3 * i + k);
      if (index[group] < 0) {
        index[group] = static_cast<int32_t>(mesh.normals.size());
        mesh.normals.push_back(unit_or(sum[group], facet[i] != Vec3(0) ? facet[i] : Vec3(0, 0, 1)));
      }
      mesh.triangles[i].normal[k] = index[group];
    }
  }
}

Mesh transformed(const Mesh& mesh, const Affine& map) {
  Mesh result = mesh;
  for (Vec3& p : result.points) p = map.point(p);
  for (Vec3& n : result.normals) n = unit_or(map.normal(n), n);
  if (map.determinant() < 0) {
    for (Mesh::Triangle& t : result.triangles) {
      std::swap(t.point[1], t.point[2]);
      std::swap(t.normal[1], t.normal[2]);
      std::swap(t.parameter[1], t.parameter[2]);
    }
  }
  return result;
}

}  // namespace lekalo::geometry
