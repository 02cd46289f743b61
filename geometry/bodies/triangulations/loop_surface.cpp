// Limit surfaces of Loop's subdivision (Loop 1987; Stam 1998). A triangle with regular corners is one polynomial. Of
// others the children are, all but the one at the corner that is not regular: its children again, and so on. What lies
// beside two smaller ones is cut, so that triangles share whole sides.
#include "geometry/bodies/triangulations/loop_surface.h"

#include "geometry/bodies/triangulations/loop.h"
#include "geometry/surfaces/triangles/bezier_triangle.h"

namespace lekalo::geometry {

namespace {

using Corners = std::array<Vec2, 3>;  // in the plane of parameters
using ThreeSides = std::array<bool, 3>;

// The triangle cut at the middles of some sides, in barycentric coordinates.
std::vector<std::array<Barycentric, 3>> cut_at_middles(const ThreeSides& sides) {
  const std::array<Barycentric, 3> p{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  const std::array<Barycentric, 3> m{0.5 * (p[0] + p[1]), 0.5 * (p[1] + p[2]), 0.5 * (p[2] + p[0])};
  const int count = sides[0] + sides[1] + sides[2];
  if (count == 3) return {{p[0], m[0], m[2]}, {m[0], p[1], m[1]}, {m[2], m[1], p[2]}, {m[1], m[2], m[0]}};
  for (size_t k = 0; k < 3; ++k) {
    const size_t next = (k + 1) % 3, last = (k + 2) % 3;
    if (count == 1 && sides[k]) return {{p[k], m[k], p[last]}, {m[k], p[next], p[last]}};
    if (count == 2 && !sides[k])
      return {{p[k], p[next], m[next]}, {p[k], m[next], m[last]}, {m[next], p[last], m[last]}};
  }
  return {p};
}

void add_patches(const TriangularNet& net, const Corners& corners, const ThreeSides& cut,
                 std::vector<SurfacePtr>& patches) {
  const ParameterTriangle whole{corners};
  for (const std::array<Barycentric, 3>& part : cut_at_middles(cut))
    patches.push_back(std::make_shared<BezierTriangle>(
        part_of(net, part), ParameterTriangle{{whole.point(part[0]), whole.point(part[1]), whole.point(part[2])}}));
}

ThreeSides irregular_corners(const ConnectedMesh& mesh, int face) {
  ThreeSides result;
  for (int k = 0; k < 3; ++k) result[static_cast<size_t>(k)] = !is_regular_for_loop(mesh, mesh.corner(face, k));
  return result;
}

// Triangle 0 of a mesh that has at least one corner that is not regular.
void add_divided(const ConnectedMesh& mesh, const Corners& uv, const ThreeSides& irregular, int levels,
                 std::vector<SurfacePtr>& patches) {
  const RefinedMesh fine = refined_by_loop(mesh);
  const ConnectedMesh all(fine.mesh);
  const Corners m{0.5 * (uv[0] + uv[1]), 0.5 * (uv[1] + uv[2]), 0.5 * (uv[2] + uv[0])};
  const std::array<Corners, 4> children{
      {{uv[0], m[0], m[2]}, {m[0], uv[1], m[1]}, {m[2], m[1], uv[2]}, {m[1], m[2], m[0]}}};
  const bool goes_on = levels > 1;
  for (size_t k = 0; k < 3; ++k) {
    const int child = fine.first_child[0] + static_cast<int>(k);
    if (irregular[k] && goes_on) {
      ThreeSides one{};
      one[k] = true;
      add_divided(ConnectedMesh(all.around(child)), children[k], one, levels - 1, patches);
    } else {
      add_patches(loop_net(all, child), children[k], {}, patches);
    }
  }
  // Side k + 1 of the middle one lies beside child k.
  const ThreeSides cut{irregular[2] && goes_on, irregular[0] && goes_on, irregular[1] && goes_on};
  add_patches(loop_net(all, fine.first_child[0] + 3), children[3], cut, patches);
}

}  // namespace

std::vector<SurfacePtr> loop_surface(const ConnectedMesh& mesh, int levels) {
  std::vector<SurfacePtr> patches;
  const auto any = [](const ThreeSides& s) { return s[0] || s[1] || s[2]; };
  for (int f = 0; f < static_cast<int>(mesh.mesh().faces.size()); ++f) {
    const double x = 2.0 * f;
    const Corners uv{Vec2(x + 1, 0), Vec2(x, 1), Vec2(x, 0)};
    const ThreeSides irregular = irregular_corners(mesh, f);
    if (any(irregular)) {
      add_divided(ConnectedMesh(mesh.around(f)), uv, irregular, levels, patches);
      continue;
    }
    ThreeSides cut{};
    for (int k = 0; k < 3; ++k) {
      const ConnectedMesh::Side other = mesh.across(f, k);
      cut[static_cast<size_t>(k)] = other.face >= 0 && any(irregular_corners(mesh, other.face));
    }
    add_patches(loop_net(mesh, f), uv, cut, patches);
  }
  return patches;
}

}  // namespace lekalo::geometry
