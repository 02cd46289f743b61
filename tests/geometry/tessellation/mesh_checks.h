// Facts that every mesh of a closed surface or body must satisfy.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "geometry/mesh.h"
#include "geometry/surface.h"
#include "support/worst.h"

namespace lekalo::geometry {

// V - E + F over the points that triangles use.
inline int euler_characteristic(const Mesh& mesh) {
  std::set<int> points;
  std::set<std::pair<int, int>> sides;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      points.insert(t.point[k]);
      sides.insert(std::minmax(t.point[k], t.point[(k + 1) % 3]));
    }
  return static_cast<int>(points.size()) - static_cast<int>(sides.size()) + static_cast<int>(mesh.triangles.size());
}

// No two used points share a place: what is welded by index is welded for good.
inline bool points_are_distinct(const Mesh& mesh) {
  std::map<std::array<double, 3>, int> places;
  for (const auto& t : mesh.triangles)
    for (int p : t.point) {
      const Vec3& x = mesh.points[p];
      if (places.try_emplace({x.x, x.y, x.z}, p).first->second != p) return false;
    }
  return true;
}

// Unit normals that agree with the triangles' own orientation.
inline void expect_good_normals(const Mesh& mesh, double min_cosine = 0.5) {
  double worst = 1;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.points[t.point[0]], b = mesh.points[t.point[1]], c = mesh.points[t.point[2]];
    const Vec3 n = glm::cross(b - a, c - a);
    ASSERT_GT(glm::length(n), 0);
    for (int k = 0; k < 3; ++k) {
      const Vec3& m = mesh.normals.at(t.normal[k]);
      EXPECT_NEAR(glm::length(m), 1, 1e-12);
      worst = std::min(worst, glm::dot(glm::normalize(n), m));
    }
  }
  EXPECT_GE(worst, min_cosine);
}

// Largest distance of surface points from their triangle's plane, over a fine set of places in every triangle. The
// parameters of corners are taken where the triangle's are.
inline double measured_sag(const Mesh& mesh, const Surface& surface, int face = -1) {
  double worst = 0;
  for (const auto& t : mesh.triangles) {
    if (face >= 0 && t.face != face) continue;
    const Vec3 a = mesh.points[t.point[0]], b = mesh.points[t.point[1]], c = mesh.points[t.point[2]];
    const Vec3 n = glm::normalize(glm::cross(b - a, c - a));
    const Vec2 p = mesh.parameters[t.parameter[0]], q = mesh.parameters[t.parameter[1]],
               r = mesh.parameters[t.parameter[2]];
    constexpr int kSteps = 8;
    for (int i = 0; i <= kSteps; ++i)
      for (int j = 0; i + j <= kSteps; ++j) {
        const double x = double(i) / kSteps, y = double(j) / kSteps;
        const Vec2 uv = (1 - x - y) * p + x * q + y * r;
        worst = tests::worse(worst, std::abs(glm::dot(surface.point(uv.x, uv.y) - a, n)));
      }
  }
  return worst;
}

}  // namespace lekalo::geometry
