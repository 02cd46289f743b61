#include "geometry/bodies/triangulations/loop.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/bodies/triangulations/loop_surface.h"
#include "geometry/surfaces/triangles/bezier_triangle.h"

namespace lekalo::geometry::loop_test {
namespace {

PolygonMesh octahedron() {
  PolygonMesh mesh;
  mesh.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  return mesh;
}

PolygonMesh shaken(PolygonMesh mesh, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> off(-0.3, 0.3);
  for (Vec3& p : mesh.points) p += Vec3(off(random), off(random), off(random));
  return mesh;
}

// Smooth, with the equator sharp, with a corner, open with a border and a vertex of the border with one triangle.
PolygonMesh sample(unsigned kind) {
  PolygonMesh mesh = shaken(octahedron(), kind);
  if (kind % 4 == 1) mesh.sharp = {{0, 2}, {1, 2}, {1, 3}, {0, 3}};
  if (kind % 4 == 2) mesh.corners = {4};
  if (kind % 4 == 3) {
    mesh.faces.resize(5);
    mesh.sharp = {{0, 3}, {1, 3}, {1, 2}, {0, 5}, {2, 5}};
    mesh.corners = {5};
  }
  return mesh;
}

TEST(Loop, LimitsStay) {
  for (unsigned kind = 0; kind < 8; ++kind) {
    const ConnectedMesh mesh(sample(kind)), once(refined_by_loop(mesh).mesh), twice(refined_by_loop(once).mesh);
    for (int v = 0; v < 6; ++v) {
      EXPECT_LT(glm::length(loop_limit(mesh, v) - loop_limit(once, v)), 1e-14) << kind << ' ' << v;
      EXPECT_LT(glm::length(loop_limit(mesh, v) - loop_limit(twice, v)), 1e-14) << kind << ' ' << v;
    }
  }
}

// Vertices of a mesh that has been divided again and again come to where the patches have these parameters.
TEST(Loop, PatchesGoThroughLimitsOfDividedMeshes) {
  constexpr int kTimes = 4;
  for (unsigned kind = 0; kind < 4; ++kind) {
    const PolygonMesh given = sample(kind);
    std::vector<const BezierTriangle*> patches;
    const std::vector<SurfacePtr> surface = loop_surface(ConnectedMesh(given), 12);
    for (const SurfacePtr& one : surface) patches.push_back(dynamic_cast<const BezierTriangle*>(one.get()));
    ConnectedMesh mesh(given);
    std::vector<std::array<Vec2, 3>> corners;  // parameters of the faces
    for (size_t f = 0; f < given.faces.size(); ++f) {
      const double x = 2.0 * static_cast<double>(f);
      corners.push_back({Vec2(x + 1, 0), Vec2(x, 1), Vec2(x, 0)});
    }
    for (int time = 0; time < kTimes; ++time) {
      const RefinedMesh fine = refined_by_loop(mesh);
      std::vector<std::array<Vec2, 3>> children;
      for (const std::array<Vec2, 3>& c : corners) {
        const Vec2 a = 0.5 * (c[0] + c[1]), b = 0.5 * (c[1] + c[2]), d = 0.5 * (c[2] + c[0]);
        children.insert(children.end(), {{c[0], a, d}, {a, c[1], b}, {d, b, c[2]}, {b, d, a}});
      }
      corners = children;
      mesh = ConnectedMesh(fine.mesh);
    }
    for (size_t f = 0; f < corners.size(); f += 7)
      for (int k = 0; k < 3; ++k) {
        const Vec2 at = corners[f][static_cast<size_t>(k)];
        const Vec3 limit = loop_limit(mesh, mesh.corner(static_cast<int>(f), k));
        bool found = false;
        for (const BezierTriangle* patch : patches) {
          if (!patch->triangle().contains(at)) continue;
          found = true;
          EXPECT_LT(glm::length(patch->evaluate_over_triangle(at, 0).point() - limit), 1e-13) << kind << ' ' << f;
        }
        EXPECT_TRUE(found);
      }
  }
}

// Limit tangents are sum cos(2 pi k / n) e_k and the same of sines (Hoppe et al. 1994), to the first order of what the
// last levels leave out.
TEST(Loop, TangentPlaneAtAVertex) {
  const ConnectedMesh mesh(sample(0));
  const int ring[] = {0, 2, 1, 3};
  Vec3 a(0), b(0);
  for (int k = 0; k < 4; ++k) {
    a += std::cos(kPi * k / 2) * mesh.point(ring[k]);
    b += std::sin(kPi * k / 2) * mesh.point(ring[k]);
  }
  const Vec3 normal = glm::normalize(glm::cross(a, b));
  for (const auto& [levels, near] : {std::pair(6, 1e-2), std::pair(12, 1e-4)}) {
    const std::vector<SurfacePtr> surface = loop_surface(mesh, levels);
    for (const SurfacePtr& one : surface) {
      const auto* patch = dynamic_cast<const BezierTriangle*>(one.get());
      if (patch->triangle().corners[2] != Vec2(0, 0)) continue;
      const SurfaceJet jet = patch->evaluate_over_triangle({0, 0}, 1);
      EXPECT_LT(glm::length(glm::normalize(glm::cross(jet.du(), jet.dv())) - normal), near) << levels;
    }
  }
}

}  // namespace
}  // namespace lekalo::geometry::loop_test
