// Where meshes meet curved faces, tubes, balls, implicit surfaces and one another: triangle by triangle, the section of
// the other shape by the triangle's plane as far as the triangle goes. Of two triangles with a common side both
// sections end where the side meets the other shape.
#include <algorithm>
#include <cmath>

#include "geometry/spatial/box_tree.h"
#include "geometry/transformed.h"
#include "render/lines/stroke_collector.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// Each of them asks for a section of the other shape.
constexpr size_t kMaxTriangles = 4000;
// Cells of a surface, by which triangles that are not near it are left out.
constexpr int kCells = 400;

std::vector<Box3> cells_of(const Surface& surface) {
  const std::vector<SurfacePiece> pieces = surface.pieces();
  const int steps = std::max(1, static_cast<int>(std::sqrt(kCells / static_cast<double>(pieces.size()))));
  std::vector<Box3> boxes;
  for (const SurfacePiece& piece : pieces)
    for (int i = 0; i < steps; ++i)
      for (int k = 0; k < steps; ++k) {
        const auto part = [&](const Interval& range, int at) {
          return Interval(range.lo + range.width() * at / steps, range.lo + range.width() * (at + 1) / steps);
        };
        boxes.push_back(surface.enclose({part(piece.domain.u, i), part(piece.domain.v, k)}, 0).d(0, 0));
      }
  return boxes;
}

// Whether a shape may come into a box, in its own coordinates.
std::function<bool(const Box3&)> intersection_boxes(const Entity& shape) {
  if (const auto* implicit = solid_of<ImplicitSurface>(shape))
    return [implicit](const Box3& box) {
      const ImplicitRegion& region = implicit->region();
      if (region.misses(box)) return false;
      const Interval range = implicit->enclose(box);
      return range.lo <= 0 && (range.hi >= 0 || implicit->is_closed());
    };
  std::vector<Box3> boxes;
  if (const auto* surface = std::get_if<SurfacePtr>(&shape))
    boxes = cells_of(**surface);
  else if (const auto* tube = solid_of<Tube>(shape))
    for (const BallSweep::Cell& cell : tube->sweep().cells()) boxes.push_back(cell.box);
  else if (const auto* balls = solid_of<Balls>(shape))
    for (const Balls::Ball& ball : balls->balls())
      boxes.push_back(Box3{ball.center, ball.center}.inflated(ball.radius));
  else if (const auto* mesh = std::get_if<MeshPtr>(&shape))
    for (const Mesh::Triangle& triangle : (*mesh)->triangles) {
      Box3& box = boxes.emplace_back();
      for (const int32_t corner : triangle.point) box.include((*mesh)->points[static_cast<size_t>(corner)]);
    }
  else
    boxes.push_back(bounds(shape));
  return [tree = BoxTree(boxes)](const Box3& box) {
    bool meets = false;
    tree.around(box, [&](int) { meets = true; });
    return meets;
  };
}

}  // namespace

void StrokeCollector::add_intersection_of_mesh(const PlacedShape& mesh, const PlacedShape& other, const Style& style,
                                               const HiddenLines& hidden) {
  to_world_ = other.to_world;
  const Mesh& triangles = *std::get<MeshPtr>(mesh.shape);
  const Affine to_other = other.to_world.inverse() * mesh.to_world;
  const auto may_meet = intersection_boxes(other.shape);
  std::vector<std::array<Vec3, 3>> near;
  for (const Mesh::Triangle& triangle : triangles.triangles) {
    std::array<Vec3, 3> corners;
    Box3 box;
    for (size_t k = 0; k < 3; ++k) {
      const Vec3& corner = triangles.points[static_cast<size_t>(triangle.point[k])];
      corners[k] = mesh.to_world.point(corner);
      box.include(to_other.point(corner));
    }
    if (may_meet(box)) near.push_back(corners);
  }
  if (near.size() > kMaxTriangles)
    return leave_out("intersections of a mesh, " + std::to_string(near.size()) +
                     " triangles of which come near what it meets (" + name_of_object() + ")");
  const size_t before = cutters_.size();
  for (const std::array<Vec3, 3>& corners : near) {
    const Vec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    if (!(glm::length(normal) > 0)) continue;
    for (size_t k = 0; k < 3; ++k) {
      const Vec3 outward = glm::cross(corners[(k + 1) % 3] - corners[k], normal);
      cutters_.push_back(cutter_of(ClipPlane{corners[k], outward, false}));
    }
    add_section(other.shape, {corners[0], glm::normalize(normal)}, style, hidden);
    cutters_.resize(before);
  }
}

}  // namespace lekalo::render
