#include "geometry/queries/measures/cell_diameters.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace lekalo::geometry {

namespace {

void check(const Surface& surface, int cells_u, int cells_v) {
  if (!surface.bounded()) throw std::invalid_argument("the surface is unbounded");
  if (cells_u < 1 || cells_v < 1) throw std::invalid_argument("there must be at least one cell each way");
}

Interval part(const Interval& whole, int i, int count) {
  const auto at = [&](int k) { return k == count ? whole.hi : whole.lo + whole.width() * k / count; };
  return {at(i), at(i + 1)};
}

double greatest_length(const Box3& box) { return glm::length(glm::max(glm::abs(box.lo), glm::abs(box.hi))); }

}  // namespace

CellDiameters cell_diameters(const Surface& surface, int cells_u, int cells_v) {
  check(surface, cells_u, cells_v);
  const Rectangle domain = surface.domain();
  CellDiameters result;
  result.chain = cells_u + cells_v - 1;
  for (int i = 0; i < cells_u; ++i)
    for (int j = 0; j < cells_v; ++j) {
      const Rectangle cell{part(domain.u, i, cells_u), part(domain.v, j, cells_v)};
      const SurfaceEnclosure box = surface.enclose(cell, 1);
      const double path = greatest_length(box.d(1, 0)) * cell.u.width() + greatest_length(box.d(0, 1)) * cell.v.width();
      result.largest = std::max(result.largest, path * (1 + 1e-14));
    }
  return result;
}

double farthest_node(const Surface& surface, int cells_u, int cells_v, const Line& line) {
  check(surface, cells_u, cells_v);
  const Rectangle domain = surface.domain();
  const Vec3 along = glm::normalize(line.direction);
  double farthest = 0;
  for (int i = 0; i <= cells_u; ++i)
    for (int j = 0; j <= cells_v; ++j) {
      const double u = i == cells_u ? domain.u.hi : part(domain.u, i, cells_u).lo;
      const double v = j == cells_v ? domain.v.hi : part(domain.v, j, cells_v).lo;
      const Vec3 way = surface.evaluate(u, v, 0).point() - line.origin;
      farthest = std::max(farthest, glm::length(way - glm::dot(way, along) * along));
    }
  return farthest;
}

}  // namespace lekalo::geometry
