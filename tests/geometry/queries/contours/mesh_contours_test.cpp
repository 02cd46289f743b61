// Lines of meshes against what is known of cubes, cylinders and spheres of triangles.
#include "geometry/queries/contours/mesh_contours.h"

#include <gtest/gtest.h>

#include <map>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/tessellation/tessellate.h"

namespace lekalo::geometry::mesh_contours_test {
namespace {

struct Count {
  int lines = 0;
  double length = 0;
};
std::map<MeshLineKind, Count> count(const Mesh& mesh, const ViewOf& view) {
  std::map<MeshLineKind, Count> result;
  for (const MeshLine& line : mesh_lines(mesh, view)) {
    Count& one = result[line.kind];
    ++one.lines;
    const Interval t = line.curve->domain();
    for (int k = 0; k < std::lround(t.width()); ++k)
      one.length += glm::length(line.curve->point(t.lo + k + 1) - line.curve->point(t.lo + k));
  }
  return result;
}

Mesh box_of_triangles() { return tessellate(box(frame_from({0, 0, 0}, {0, 0, 1}, {1, 0, 0}), {1, 2, 3}), {}); }

TEST(MeshContours, EdgesOfABox) {
  Mesh mesh = box_of_triangles();
  const ViewOf view{false, glm::normalize(Vec3(-1, -2, -1.5))};
  auto found = count(mesh, view);
  // Twelve edges: the diagonals lie in planes; edges meet in threes, so that none goes on.
  EXPECT_EQ(found.size(), 1u);
  EXPECT_EQ(found[MeshLineKind::sharp].lines, 12);
  EXPECT_NEAR(found[MeshLineKind::sharp].length, 4 * (1 + 2 + 3), 1e-12);
  // The angle alone tells, where all normals are shared.
  set_smooth_normals(mesh);
  EXPECT_NEAR(count(mesh, view)[MeshLineKind::sharp].length, 4 * (1 + 2 + 3), 1e-12);
  mesh.normals.clear();
  for (Mesh::Triangle& triangle : mesh.triangles) triangle.normal = {-1, -1, -1};
  EXPECT_NEAR(count(mesh, view)[MeshLineKind::sharp].length, 4 * (1 + 2 + 3), 1e-12);
  // Without one of its triangles: a border of three sides, two of which were edges.
  mesh.triangles.pop_back();
  found = count(mesh, view);
  EXPECT_EQ(found[MeshLineKind::boundary].lines, 1);
  // As of files that do not share points, and with triangles turned round.
  Mesh loose;
  for (size_t k = 0; k < mesh.triangles.size(); ++k) {
    Mesh::Triangle triangle;
    for (int i = 0; i < 3; ++i) {
      triangle.point[k % 2 ? i : 2 - i] = static_cast<int32_t>(loose.points.size());
      loose.points.push_back(mesh.points[mesh.triangles[k].point[i]]);
    }
    loose.triangles.push_back(triangle);
  }
  auto again = count(loose, view);
  EXPECT_EQ(again[MeshLineKind::boundary].lines, 1);
  EXPECT_NEAR(again[MeshLineKind::sharp].length, found[MeshLineKind::sharp].length, 1e-12);
}

TEST(MeshContours, SectionsOfABox) {
  const Mesh mesh = box_of_triangles();
  const auto expect = [&](const Vec3& origin, const Vec3& normal, double length) {
    const auto lines = plane_section(mesh, origin, normal);
    ASSERT_EQ(lines.size(), length > 0 ? 1u : 0u);
    if (lines.empty()) return;
    EXPECT_GT(lines[0]->period(), 0);
    const Interval t = lines[0]->domain();
    double found = 0;
    for (int k = 0; k < std::lround(t.width()); ++k) {
      const Vec3 from = lines[0]->point(t.lo + k), to = lines[0]->point(t.lo + k + 1);
      EXPECT_NEAR(glm::dot(from - origin, glm::normalize(normal)), 0, 1e-15);
      found += glm::length(to - from);
    }
    EXPECT_NEAR(found, length, 1e-12);
  };
  expect({0.4, 0, 0}, {3, 0, 0}, 2 * (2 + 3));
  expect({0.4, 0, 0}, {-1, 0, 0}, 2 * (2 + 3));
  expect({0, 0, 1.25}, {0, 0, 1}, 2 * (1 + 2));
  expect({0, 0, 0}, {2, -1, 0}, 2 * (std::sqrt(5.0) + 3));  // along four edges and the diagonals of two sides
  // The six corners of a hexagon lie on edges: its sides are three pairs, each in a face.
  const double side = 0.5 * (std::hypot(1.0, 2.0) + std::hypot(1.0, 3.0) + std::hypot(2.0, 3.0));
  expect({0.5, 1, 1.5}, {6, 3, 2}, 2 * side);
  // A face in the plane is cut round where the body is below.
  expect({0, 0, 0}, {-1, 0, 0}, 2 * (2 + 3));
  expect({0, 0, 0}, {1, 0, 0}, 0);
  expect({2, 0, 0}, {1, 0, 0}, 0);
}

TEST(MeshContours, OutlineOfABallIsNearItsCircle) {
  TessellationTolerance tolerance;
  tolerance.angle = 0.05;
  const Mesh mesh = tessellate(ball(frame_from({0, 0, 0}, {0.3, 0.2, 1}, {1, 0, 0}), 2), tolerance);
  for (const bool central : {false, true}) {
    const ViewOf view{central, central ? Vec3(5, 1, 2) : glm::normalize(Vec3(1, 0.4, -0.3))};
    auto found = count(mesh, view);
    EXPECT_EQ(found.count(MeshLineKind::boundary), 0u);
    EXPECT_EQ(found.count(MeshLineKind::sharp), 0u);
    int closed = 0;
    for (const MeshLine& line : mesh_lines(mesh, view)) {
      if (line.kind != MeshLineKind::silhouette) continue;
      closed += line.curve->period() > 0;
      const Interval t = line.curve->domain();
      for (double x = t.lo; x < t.hi; x += 1) {
        const Vec3 p = line.curve->point(x);
        const Vec3 sight = central ? glm::normalize(p - view.direction_or_eye) : view.direction_or_eye;
        // A vertex of the outline has triangles that face the viewer and others that do not: its angle is that of one.
        EXPECT_LT(std::abs(glm::dot(glm::normalize(p), sight)), 0.15);
      }
    }
    EXPECT_GE(closed, 1);
  }
}

TEST(MeshContours, LinesMeetTrianglesWhereTheyMeetTheBox) {
  const MeshTriangles triangles(std::make_shared<Mesh>(box_of_triangles()));
  std::vector<double> at;
  triangles.add_crossings({{-1, 0.4, 1.3}, {4, 0, 0}}, {0, 1}, at);
  std::sort(at.begin(), at.end());
  ASSERT_EQ(at.size(), 2u);
  EXPECT_NEAR(at[0], 0.25, 1e-15);
  EXPECT_NEAR(at[1], 0.5, 1e-15);
  at.clear();
  triangles.add_crossings({{-1, 0.4, 1.3}, {4, 0, 0}}, {0, 0.4}, at);
  EXPECT_EQ(at.size(), 1u);
  at.clear();
  triangles.add_crossings({{-1, 2.4, 1.3}, {4, 0, 0}}, {0, 1}, at);
  EXPECT_TRUE(at.empty());
}

}  // namespace
}  // namespace lekalo::geometry::mesh_contours_test
