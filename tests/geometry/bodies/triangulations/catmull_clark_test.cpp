#include "geometry/bodies/triangulations/catmull_clark.h"

#include <gtest/gtest.h>

#include <random>

namespace lekalo::geometry {
namespace {

PolygonMesh cube() {
  PolygonMesh mesh;
  for (const double z : {-1, 1})
    for (const double y : {-1, 1})
      for (const double x : {-1, 1}) mesh.points.emplace_back(x, y, z);
  mesh.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return mesh;
}

// A sheet of n by n squares, its border sharp, its corners kept.
PolygonMesh sheet(int n) {
  PolygonMesh mesh;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) mesh.points.emplace_back(i, j, 0);
  const auto at = [&](int i, int j) { return i * (n + 1) + j; };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) mesh.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  for (int i = 0; i < n; ++i)
    for (const int side : {0, n}) {
      mesh.sharp.insert(PolygonMesh::edge(at(i, side), at(i + 1, side)));
      mesh.sharp.insert(PolygonMesh::edge(at(side, i), at(side, i + 1)));
    }
  mesh.corners = {at(0, 0), at(n, 0), at(0, n), at(n, n)};
  return mesh;
}

PolygonMesh shaken(PolygonMesh mesh, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> off(-0.3, 0.3);
  for (Vec3& p : mesh.points) p += Vec3(off(random), off(random), off(random));
  return mesh;
}

double far(const Vec3& a, const Vec3& b) { return glm::length(a - b); }

TEST(CatmullClark, CornersOfACubeComeHalfWayIn) {
  const ConnectedMesh mesh(cube());
  for (int v = 0; v < 8; ++v) EXPECT_LT(far(catmull_clark_limit(mesh, v), 0.5 * mesh.point(v)), 1e-15);
  const RefinedMesh fine = refined_by_catmull_clark(mesh);
  EXPECT_EQ(fine.mesh.faces.size(), 24u);
  EXPECT_EQ(fine.mesh.points.size(), 26u);
  EXPECT_LT(far(fine.mesh.points[0], Vec3(-5.0 / 9)), 1e-15);
}

// A limit is the same however often the mesh has been divided.
TEST(CatmullClark, LimitsStay) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    PolygonMesh given = seed % 2 == 0 ? shaken(cube(), seed) : shaken(sheet(3), seed);
    if (seed % 4 == 0) given.sharp = {{0, 1}, {1, 3}, {2, 3}, {0, 2}};
    if (seed % 8 == 0) given.sharp.insert({{4, 5}, {0, 4}, {1, 5}});  // three at a corner
    const ConnectedMesh mesh(given), once(refined_by_catmull_clark(mesh).mesh),
        twice(refined_by_catmull_clark(once).mesh);
    for (int v = 0; v < static_cast<int>(given.points.size()); ++v) {
      EXPECT_LT(far(catmull_clark_limit(mesh, v), catmull_clark_limit(once, v)), 1e-14) << seed << ' ' << v;
      EXPECT_LT(far(catmull_clark_limit(mesh, v), catmull_clark_limit(twice, v)), 1e-14) << seed << ' ' << v;
    }
  }
}

// The B-spline patch of a net at a corner of it.
Vec3 corner_of(const PatchNet& net, int i, int j) {
  constexpr double kWeights[] = {1.0 / 6, 4.0 / 6, 1.0 / 6};
  Vec3 sum(0);
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) sum += kWeights[a] * kWeights[b] * net.points[static_cast<size_t>((i + a) * 4 + j + b)];
  return sum;
}

Vec3 middle_of(const PatchNet& net) {
  constexpr double kHalf[] = {1.0 / 48, 23.0 / 48, 23.0 / 48, 1.0 / 48};
  Vec3 sum(0);
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) sum += kHalf[a] * kHalf[b] * net.points[static_cast<size_t>(a * 4 + b)];
  return sum;
}

// Corners of the B-spline patch are limits, inside, at a border and at its corners; its middle is that of a child.
TEST(CatmullClark, PatchesEndInLimits) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    PolygonMesh given = shaken(sheet(4), seed);
    if (seed % 2 == 1)  // a crease across
      for (int i = 0; i < 4; ++i) given.sharp.insert(PolygonMesh::edge(i * 5 + 2, (i + 1) * 5 + 2));
    const ConnectedMesh mesh(given);
    for (int f = 0; f < 16; ++f) {
      const PatchNet net = patch_net(mesh, f);
      if (seed % 2 == 0) {
        ASSERT_TRUE(net.irregular.empty()) << f;
      }
      const ConnectedMesh part(mesh.around(f));
      const PatchNet alone = patch_net(part, 0);
      EXPECT_EQ(alone.irregular, net.irregular);
      if (!net.irregular.empty()) continue;
      constexpr int kAt[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
      for (int k = 0; k < 4; ++k) {
        const Vec3 limit = catmull_clark_limit(mesh, mesh.corner(f, k));
        EXPECT_LT(far(corner_of(net, kAt[k][0], kAt[k][1]), limit), 1e-14) << f << ' ' << k;
        EXPECT_LT(far(corner_of(alone, kAt[k][0], kAt[k][1]), limit), 1e-14);
      }
      const RefinedMesh fine = refined_by_catmull_clark(part);
      const ConnectedMesh children(fine.mesh);
      EXPECT_LT(far(catmull_clark_limit(children, children.corner(fine.first_child[0], 2)), middle_of(net)), 1e-14);
    }
  }
}

TEST(CatmullClark, KnowsWhatIsNoPatch) {
  const ConnectedMesh mesh(cube());
  EXPECT_EQ(patch_net(mesh, 0).irregular.size(), 4u);
  const RefinedMesh fine = refined_by_catmull_clark(mesh);
  const ConnectedMesh all(fine.mesh);
  for (int f = 0; f < 6; ++f)
    for (int k = 0; k < 4; ++k)
      EXPECT_EQ(patch_net(all, fine.first_child[static_cast<size_t>(f)] + k).irregular, std::vector<int>{k});
}

}  // namespace
}  // namespace lekalo::geometry
