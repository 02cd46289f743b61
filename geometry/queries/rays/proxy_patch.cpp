// With D = r - P in local coordinates x, y in [-1, 1], the points and the derivatives D_x, D_y, D_xy vanish at the
// corners but for rounding. M_ij are bounds on the derivatives of D, i times by x and j times by y, from the surface's
// enclosure and the hull of the patch's own differences.
//
// Every place is at most 1 from the nearest corner along x and along y, so that bounds of the second order give
//
//   |D_x| <= |D_x(corner)| + M_20 + M_11,   |D| <= |D(corner)| + |D_x(corner)| + |D_y(corner)| + M_20/2 + M_11 + M_02/2
//
// which is of the order of the third power of the rectangle's size. Where the surface encloses its fourth derivatives
// there are better ones. On an edge along x, D and D_x are zero at both ends: by the error of cubic Hermite
// interpolation (Birkhoff, Schultz, Varga 1968) |D| <= M_40/24 and |D_x| <= sqrt(3)/27 M_40 =: e. So are g = D_y and g'
// there: g'' is orthogonal to the polynomials of degree 1 and |g'''| <= M_31, hence with the kernel (1 + 3 x s)/2 that
// reproduces them |g''| <= 1.2 M_31, and from the nearest end |g'| <= 1.2 M_31 =: d and |g| <= 0.6 M_31. Across, from
// edge to edge at a fixed x, D differs from the cubic that has the edges' values and derivatives by M_04/24 at most,
// and D_x, whose third derivative by y is bounded, in the same way:
//
//   |D|   <= M_40/24 + 0.3 M_31 + M_04/24
//   |D_x| <= e + d/2 + 0.6 (M_13 + 3 (e + d))
//
// and with x and y exchanged: the fourth power of the size.
#include "geometry/queries/rays/proxy_patch.h"

#include <algorithm>
#include <cmath>

namespace lekalo::geometry {

namespace {

// The largest distance between points of two boxes.
double farthest(const Box3& a, const Box3& b) { return glm::length(glm::max(a.hi - b.lo, b.hi - a.lo)); }

constexpr double kChoose[5][5] = {{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}, {1, 4, 6, 4, 1}};
// A difference of that order of a cubic's control points is so often its derivative by x = 2 s - 1.
constexpr double kFactor[5] = {1, 1.5, 1.5, 0.75, 0};

double power(double x, int n) { return n == 0 ? 1 : x * power(x, n - 1); }

Box3 scaled(const Box3& box, double factor) { return {factor * box.lo, factor * box.hi}; }

}  // namespace

ProxyPatch proxy_of(const Surface& surface, const Rectangle& box) {
  ProxyPatch result;
  const int order = surface.enclosure_order() >= 4 ? 4 : 2;
  const SurfaceEnclosure hull = surface.enclose(box, order);
  if (!hull.d(2, 0).bounded() || !hull.d(1, 1).bounded() || !hull.d(0, 2).bounded()) return result;
  const double hu = 0.5 * box.u.width(), hv = 0.5 * box.v.width();
  double at_corner = 0, along_x = 0, along_y = 0, twisted = 0, size = 0;
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
      const SurfaceEnclosure here = surface.enclose({{u, u}, {v, v}}, 2);
      at_corner = std::max(at_corner, farthest(here.d(0, 0), {p, p}));
      along_x = std::max(along_x, hu * farthest(here.d(1, 0), {jet.du(), jet.du()}));
      along_y = std::max(along_y, hv * farthest(here.d(0, 1), {jet.dv(), jet.dv()}));
      twisted = std::max(twisted, hu * hv * farthest(here.d(1, 1), {jet.duv(), jet.duv()}));
      size = std::max(size, std::abs(p.x) + std::abs(p.y) + std::abs(p.z));
    }
  // The hull of the patch's derivatives i times by x and j times by y against the surface's.
  const auto bound = [&](int i, int j) {
    Box3 all;
    for (int k = 0; k + i < 4; ++k)
      for (int l = 0; l + j < 4; ++l) {
        Vec3 difference(0);
        for (int m = 0; m <= i; ++m)
          for (int n = 0; n <= j; ++n)
            difference +=
                ((i + j - m - n) % 2 == 0 ? 1.0 : -1.0) * kChoose[i][m] * kChoose[j][n] * Vec3(point(k + m, l + n));
        all.include(kFactor[i] * kFactor[j] * difference);
      }
    if (i > 3 || j > 3) all.include(Vec3(0));
    return farthest(scaled(hull.d(i, j), power(hu, i) * power(hv, j)), all);
  };
  // Rounding of the patch's own points and differences.
  const double rounding = 1e-14 * size;
  const double m_20 = bound(2, 0), m_11 = bound(1, 1), m_02 = bound(0, 2);
  double off = at_corner + along_x + along_y + 0.5 * m_20 + m_11 + 0.5 * m_02 + rounding;
  double off_x = along_x + m_20 + m_11 + rounding, off_y = along_y + m_11 + m_02 + rounding;
  if (order == 4) {
    // The patch that agrees exactly at the corners: its third differences are a little others.
    const double corner = 32 * (at_corner + along_x + along_y + twisted + rounding);
    const double m_40 = bound(4, 0), m_04 = bound(0, 4), m_31 = bound(3, 1) + corner, m_13 = bound(1, 3) + corner;
    const auto slope = [&](double along, double mixed, double other) {
      const double e = 0.0642 * along, d = 1.2 * mixed;
      return e + 0.5 * d + 0.6 * (other + 3 * (e + d)) + corner;
    };
    off = std::min(off, (m_40 + m_04) / 24 + 0.3 * std::min(m_31, m_13) + corner);
    off_x = std::min(off_x, slope(m_40, m_31, m_13));
    off_y = std::min(off_y, slope(m_04, m_13, m_31));
  }
  const bool finite = std::all_of(result.points.begin(), result.points.end(), [](const Vec4& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  });
  if (finite && off < kInfinity && off_x < kInfinity && off_y < kInfinity) {
    result.off = off;
    result.off_x = off_x;
    result.off_y = off_y;
    result.rounding = at_corner;
  }
  return result;
}

}  // namespace lekalo::geometry
