#include "geometry/bodies/triangulations/spline_graph.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "geometry/bodies/topology/sew.h"

namespace lekalo::geometry {

namespace {

using Net = TriangularNetOf<double>;

// Heights that differ by less than this part of the largest are equal: roundings of the recurrences.
constexpr double kSameHeight = 1e-12;

SurfacePtr patch(const std::array<Vec2, 3>& corners, const Net& heights) {
  TriangularNet net{heights.degree, {}};
  const double n = heights.degree;
  each_index(heights.degree, [&](int i, int j, int k) {
    const Vec2 at = (static_cast<double>(i) * corners[0] + static_cast<double>(j) * corners[1] +
                     static_cast<double>(k) * corners[2]) /
                    n;
    net.points.emplace_back(at.x, at.y, heights.at(i, j), 1);
  });
  return std::make_shared<BezierTriangle>(std::move(net), ParameterTriangle{corners});
}

// Heights on the side from corner `from` to corner `to`.
std::vector<double> on_side(const Net& net, int from, int to) {
  std::vector<double> result;
  for (int m = 0; m <= net.degree; ++m) {
    int index[3] = {0, 0, 0};
    index[from] = net.degree - m;
    index[to] += m;
    result.push_back(net.at(index[0], index[1]));
  }
  return result;
}

// Between the heights along a side, upright.
SurfacePtr wall(const Vec2& from, const Vec2& to, const std::vector<double>& lower, const std::vector<double>& upper) {
  NurbsSurfaceForm form;
  const int n = static_cast<int>(lower.size()) - 1;
  form.degree_u = n, form.degree_v = 1;
  form.knots_u.assign(static_cast<size_t>(n) + 1, 0.0);
  form.knots_u.insert(form.knots_u.end(), static_cast<size_t>(n) + 1, 1.0);
  form.knots_v = {0, 0, 1, 1};
  for (int i = 0; i <= n; ++i) {
    const Vec2 at = from + (to - from) * (static_cast<double>(i) / n);
    form.points.emplace_back(at.x, at.y, lower[static_cast<size_t>(i)], 1);
    form.points.emplace_back(at.x, at.y, upper[static_cast<size_t>(i)], 1);
  }
  return std::make_shared<NurbsSurface>(form);
}

struct Side {
  Vec2 from, to;
  std::vector<std::vector<double>> heights;  // of each cell that has it, zeros of none
};

std::map<std::pair<int, int>, Side> sides_of(const PlanarCells& cells, const std::vector<Net>& nets) {
  std::map<std::pair<int, int>, Side> sides;
  for (size_t t = 0; t < nets.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      int from = k, to = (k + 1) % 3;
      const auto vertex = [&](int corner) { return cells.triangles[t][static_cast<size_t>(corner)]; };
      if (vertex(from) > vertex(to)) std::swap(from, to);
      Side& side = sides[{vertex(from), vertex(to)}];
      side.from = cells.points[static_cast<size_t>(vertex(from))];
      side.to = cells.points[static_cast<size_t>(vertex(to))];
      side.heights.push_back(on_side(nets[t], from, to));
    }
  for (auto& [key, side] : sides)
    if (side.heights.size() == 1) side.heights.emplace_back(side.heights[0].size(), 0.0);
  return sides;
}

void add_walls(std::vector<SurfacePtr>& patches, const PlanarCells& cells, const std::vector<Net>& nets, double near) {
  for (const auto& [key, side] : sides_of(cells, nets)) {
    const std::vector<double>&a = side.heights[0], &b = side.heights[1];
    double jump = 0;
    for (size_t i = 0; i < a.size(); ++i) jump = std::max(jump, std::abs(a[i] - b[i]));
    if (jump > near) patches.push_back(wall(side.from, side.to, std::min(a, b), std::max(a, b)));
  }
}

}  // namespace

Body surface_on(const PlanarCells& cells, const std::vector<TriangularNet>& nets) {
  std::vector<SurfacePtr> patches;
  for (size_t t = 0; t < nets.size(); ++t)
    patches.push_back(std::make_shared<BezierTriangle>(nets[t], ParameterTriangle{cells.corners(t)}));
  return sew(patches);
}

Body graph_of(const SplineOnCells& f, const GraphOptions& options) {
  std::vector<Net> nets;
  double highest = 0;
  for (const Net& given : f.nets) {
    Net net = given.degree == 0 ? elevated(given) : given;
    for (double& z : net.points) highest = std::max(highest, std::abs(z *= options.scale));
    nets.push_back(std::move(net));
  }
  if (!(highest > 0)) throw std::invalid_argument("the function is 0 everywhere");
  const double near = kSameHeight * highest;
  std::vector<SurfacePtr> patches;
  for (size_t t = 0; t < nets.size(); ++t) {
    // The border at the height 0 is that of the floor.
    for (double& z : nets[t].points)
      if (std::abs(z) <= near) z = 0;
    const bool is_zero = std::all_of(nets[t].points.begin(), nets[t].points.end(), [](double z) { return z == 0; });
    if (is_zero) continue;
    patches.push_back(patch(f.cells.corners(t), nets[t]));
    if (options.solid) patches.push_back(patch(f.cells.corners(t), Net{1, {0, 0, 0}}));
  }
  if (options.walls || options.solid) add_walls(patches, f.cells, nets, near);
  return options.solid ? enclosed_by(patches) : sew(patches);
}

}  // namespace lekalo::geometry
