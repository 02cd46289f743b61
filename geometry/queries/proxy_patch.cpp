// With D = r - P in local coordinates x, y in [-1, 1], D and its gradient vanish at the corners but for rounding, and
// every place is at most 1 from the nearest corner along x and along y. So bounds M on the second derivatives of D give
//
//   |D_x| <= |D_x(corner)| + M_xx + M_xy,   |D| <= |D(corner)| + |D_x(corner)| + |D_y(corner)| + M_xx/2 + M_xy + M_yy/2
//
// and M comes from the surface's enclosure and the hull of the patch's own second differences: of the order of the
// third power of the rectangle's size.
#include "geometry/queries/proxy_patch.h"

#include <algorithm>
#include <cmath>

namespace lekalo::geometry {

namespace {

// The largest distance between points of two boxes.
double farthest(const Box3& a, const Box3& b) { return glm::length(glm::max(a.hi - b.lo, b.hi - a.lo)); }

Box3 scaled(const Box3& box, double factor) { return {factor * box.lo, factor * box.hi}; }

}  // namespace

ProxyPatch proxy_of(const Surface& surface, const Rectangle& box) {
  ProxyPatch result;
  const double hu = 0.5 * box.u.width(), hv = 0.5 * box.v.width();
  double at_corner = 0, along_x = 0, along_y = 0, size = 0;
  const auto point = [&](int i, int j) -> Vec4& { return result.points[4 * i + j]; };
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      const double u = i == 0 ? box.u.lo : box.u.hi, v = j == 0 ? box.v.lo : box.v.hi;
      const SurfaceJet jet = surface.evaluate(u, v, 2);
      const double su = i == 0 ? 1 : -1, sv = j == 0 ? 1 : -1;
      const Vec3 p = jet.point(), du = (su * 2 / 3 * hu) * jet.du(), dv = (sv * 2 / 3 * hv) * jet.dv();
      const Vec3 twist = (su * sv * 4 / 9 * hu * hv) * jet.duv();
      point(3 * i, 3 * j) = Vec4(p, 1);
      point(i == 0 ? 1 : 2, 3 * j) = Vec4(p + du, 1);
      point(3 * i, j == 0 ? 1 : 2) = Vec4(p + dv, 1);
      point(i == 0 ? 1 : 2, j == 0 ? 1 : 2) = Vec4(p + du + dv + twist, 1);
      const SurfaceEnclosure here = surface.enclose({{u, u}, {v, v}}, 1);
      at_corner = std::max(at_corner, farthest(here.d(0, 0), {p, p}));
      along_x = std::max(along_x, hu * farthest(here.d(1, 0), {jet.du(), jet.du()}));
      along_y = std::max(along_y, hv * farthest(here.d(0, 1), {jet.dv(), jet.dv()}));
      size = std::max(size, std::abs(p.x) + std::abs(p.y) + std::abs(p.z));
    }
  const SurfaceEnclosure hull = surface.enclose(box, 2);
  Box3 xx, xy, yy;
  const auto at = [&](int i, int j) { return Vec3(point(i, j)); };
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      if (i < 2) xx.include(1.5 * (at(i, j) - 2.0 * at(i + 1, j) + at(i + 2, j)));
      if (j < 2) yy.include(1.5 * (at(i, j) - 2.0 * at(i, j + 1) + at(i, j + 2)));
      if (i < 3 && j < 3) xy.include(2.25 * (at(i, j) - at(i + 1, j) - at(i, j + 1) + at(i + 1, j + 1)));
    }
  const double m_xx = farthest(scaled(hull.d(2, 0), hu * hu), xx), m_xy = farthest(scaled(hull.d(1, 1), hu * hv), xy),
               m_yy = farthest(scaled(hull.d(0, 2), hv * hv), yy);
  // Rounding of the patch's own points and differences.
  const double rounding = 1e-14 * size;
  const double off = at_corner + along_x + along_y + 0.5 * m_xx + m_xy + 0.5 * m_yy + rounding;
  const double off_x = along_x + m_xx + m_xy + rounding, off_y = along_y + m_xy + m_yy + rounding;
  const bool finite = std::all_of(result.points.begin(), result.points.end(), [](const Vec4& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  });
  if (finite && off < kInfinity && off_x < kInfinity && off_y < kInfinity) {
    result.off = off;
    result.off_x = off_x;
    result.off_y = off_y;
  }
  return result;
}

}  // namespace lekalo::geometry
