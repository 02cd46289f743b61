#include "geometry/tessellation/face_border.h"

#include <algorithm>
#include <cmath>

namespace lekalo::geometry {

std::vector<BorderPoint> border_of(const Body& body, int loop, bool with_face_on_left,
                                   const std::vector<EdgePolygon>& edges) {
  std::vector<BorderPoint> result;
  std::vector<int> order = body.loops[loop].coedges;
  if (!with_face_on_left) std::reverse(order.begin(), order.end());
  for (int c : order) {
    const Coedge& coedge = body.coedges[c];
    const EdgePolygon& polygon = edges[coedge.edge];
    const bool forward = coedge.forward == with_face_on_left;
    // Points along a grid line stand exactly on it: rounding must not make triangles between them.
    const int constant = constant_coordinate(*coedge.image);
    const Vec2 first(coedge.image->point(polygon.t.front()));
    // The last point is the next coedge's first.
    for (size_t k = 0; k + 1 < polygon.t.size(); ++k) {
      const size_t index = forward ? k : polygon.t.size() - 1 - k;
      Vec2 uv(coedge.image->point(polygon.t[index]));
      if (constant >= 0) uv[constant] = first[constant];
      result.push_back({uv, coedge.edge, index});
    }
  }
  return result;
}

std::array<int, 2> border_node(const SurfaceGrid& grid, const Vec2& uv) {
  const auto index = [](const std::vector<double>& lines, double x) {
    const double gap = 1e-9 * (lines.back() - lines.front());
    const auto at = std::upper_bound(lines.begin(), lines.end(), x + gap) - 1;
    return at >= lines.begin() && std::abs(*at - x) <= gap ? static_cast<int>(at - lines.begin()) : -1;
  };
  return {index(grid.u, uv.x), index(grid.v, uv.y)};
}

double side_of(const Body& body, int face) {
  return body.faces[face].forward == (body.faces[face].surface->normal_sign() > 0) ? 1 : -1;
}

std::array<bool, 4> matched_sides(const SurfaceGrid& grid, const std::vector<BorderPoint>& border) {
  std::array<bool, 4> matched{true, true, true, true};
  std::array<std::vector<char>, 4> seen;
  const int m = grid.columns(), n = grid.rows();
  seen[0].assign(n + 1, 0), seen[1].assign(n + 1, 0), seen[2].assign(m + 1, 0), seen[3].assign(m + 1, 0);
  const Vec2 lo(grid.u.front(), grid.v.front()), hi(grid.u.back(), grid.v.back()), gap = 1e-9 * (hi - lo);
  for (const BorderPoint& p : border) {
    const auto [i, j] = border_node(grid, p.uv);
    const std::array<bool, 4> on{p.uv.x <= lo.x + gap.x, p.uv.x >= hi.x - gap.x, p.uv.y <= lo.y + gap.y,
                                 p.uv.y >= hi.y - gap.y};
    for (int side = 0; side < 4; ++side) {
      if (!on[side]) continue;
      const int at = side < 2 ? j : i;
      if (at < 0)
        matched[side] = false;
      else
        seen[side][at] = 1;
    }
    if (!(on[0] || on[1] || on[2] || on[3])) matched.fill(false);
  }
  for (int side = 0; side < 4; ++side) {
    const std::vector<double>& lines = side < 2 ? grid.v : grid.u;
    for (size_t k = 0; k < lines.size(); ++k)
      if (!seen[side][k] && !(k + 1 < lines.size() && lines[k] == lines[k + 1])) matched[side] = false;
  }
  return matched;
}

bool is_all_grid(const Body& body, int face, const SurfaceGrid& grid, const std::vector<EdgePolygon>& edges) {
  if (body.faces[face].trimmed) return false;
  std::vector<BorderPoint> border;
  for (int loop : body.faces[face].loops) {
    const auto part = border_of(body, loop, side_of(body, face) > 0, edges);
    border.insert(border.end(), part.begin(), part.end());
  }
  const std::array<bool, 4> matched = matched_sides(grid, border);
  return matched[0] && matched[1] && matched[2] && matched[3];
}

}  // namespace lekalo::geometry
