// Each cube is cut into the six tetrahedra around its diagonal (Kuhn), so that neighbours agree on their common faces.
#include "shape_mesh.h"

#include <array>
#include <unordered_map>

#include "geometry/shape.h"

namespace lekalo::benchmarks {

using geometry::Line;
using geometry::Mesh;
using geometry::SurfaceHit;
using geometry::Vec3;

namespace {

struct Grid {
  Vec3 origin;
  double step;
  std::array<int, 3> cubes;
  int64_t vertex(int x, int y, int z) const {
    return (static_cast<int64_t>(z) * (cubes[1] + 1) + y) * (cubes[0] + 1) + x;
  }
  Vec3 place(int64_t vertex) const {
    const int64_t row = cubes[0] + 1, layer = row * (cubes[1] + 1);
    return origin + step * Vec3(static_cast<double>(vertex % row), static_cast<double>(vertex % layer / row),
                                static_cast<double>(vertex / layer));
  }
};

std::vector<bool> inside_of(const geometry::Shape& shape, const Grid& grid) {
  std::vector<bool> inside(static_cast<size_t>(grid.vertex(grid.cubes[0], grid.cubes[1], grid.cubes[2])) + 1);
  std::vector<SurfaceHit> hits;
  for (int z = 0; z <= grid.cubes[2]; ++z)
    for (int y = 0; y <= grid.cubes[1]; ++y) {
      hits.clear();
      const Line line{grid.place(grid.vertex(0, y, z)), Vec3(1, 0, 0)};
      shape.all_hits(line, {-geometry::kInfinity, geometry::kInfinity}, hits);
      size_t passed = 0;
      for (int x = 0; x <= grid.cubes[0]; ++x) {
        while (passed < hits.size() && hits[passed].t <= x * grid.step) ++passed;
        inside[static_cast<size_t>(grid.vertex(x, y, z))] = passed % 2 == 1;
      }
    }
  return inside;
}

}  // namespace

Mesh marching_mesh(const geometry::Shape& shape, int steps) {
  const geometry::Box3 box = shape.bounds();
  const Vec3 size = box.size();
  const double step = std::max({size.x, size.y, size.z}) / steps;
  Grid grid{box.lo - Vec3(0.513, 0.507, 0.519) * step, step, {}};
  for (int k = 0; k < 3; ++k) grid.cubes[k] = static_cast<int>(size[k] / step) + 2;
  const std::vector<bool> inside = inside_of(shape, grid);

  Mesh mesh;
  std::unordered_map<int64_t, int32_t> known;  // vertices on the grid's edges, by their ends
  const auto crossing = [&](int64_t a, int64_t b) {
    if (a > b) std::swap(a, b);
    const auto [entry, fresh] = known.try_emplace(a * static_cast<int64_t>(inside.size()) + b, 0);
    if (fresh) {
      entry->second = static_cast<int32_t>(mesh.points.size());
      const Vec3 from = grid.place(a), to = grid.place(b);
      SurfaceHit hit;
      const bool found = shape.first_hit({from, to - from}, {0, 1}, hit);
      mesh.points.push_back(from + (found ? hit.t : 0.5) * (to - from));
    }
    return entry->second;
  };
  const auto add = [&](int32_t a, int32_t b, int32_t c) {
    if (a != b && b != c && c != a) mesh.triangles.push_back({{a, b, c}});
  };
  constexpr int kOrders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  for (int z = 0; z < grid.cubes[2]; ++z)
    for (int y = 0; y < grid.cubes[1]; ++y)
      for (int x = 0; x < grid.cubes[0]; ++x)
        for (const auto& order : kOrders) {
          int64_t in[4], out[4];
          int ins = 0, outs = 0;
          std::array<int, 3> at{x, y, z};
          for (int corner = 0; corner < 4; ++corner) {
            const int64_t vertex = grid.vertex(at[0], at[1], at[2]);
            if (inside[static_cast<size_t>(vertex)])
              in[ins++] = vertex;
            else
              out[outs++] = vertex;
            if (corner < 3) ++at[order[corner]];
          }
          if (ins == 1) {
            add(crossing(in[0], out[0]), crossing(in[0], out[1]), crossing(in[0], out[2]));
          } else if (ins == 3) {
            add(crossing(in[0], out[0]), crossing(in[1], out[0]), crossing(in[2], out[0]));
          } else if (ins == 2) {
            const int32_t a = crossing(in[0], out[0]), b = crossing(in[0], out[1]), c = crossing(in[1], out[1]),
                          d = crossing(in[1], out[0]);
            add(a, b, c);
            add(a, c, d);
          }
        }
  return mesh;
}

}  // namespace lekalo::benchmarks
