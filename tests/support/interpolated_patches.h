// Polynomial patches in place of a surface without any, for oracles that know patches alone.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <vector>

#include "geometry/surfaces/splines/nurbs_surface.h"

namespace lekalo::tests {

using namespace geometry;

// The rational patch that polynomial formulas of degrees p and q are: values at p + 1 and q + 1 parameters, in long
// double, solved for the Bernstein coefficients.
inline SurfacePtr interpolated(int p, int q, const Rectangle& domain,
                               const std::function<Vec3(double u, double v)>& point) {
  using Real = long double;
  const auto basis = [](int n, int i, Real s) {
    Real choose = 1;
    for (int k = 0; k < i; ++k) choose = choose * (n - k) / (k + 1);
    return choose * std::pow(s, static_cast<Real>(i)) * std::pow(1 - s, static_cast<Real>(n - i));
  };
  // Gauss-Jordan elimination of B c = f along one direction.
  const auto solve = [&](int n, std::vector<std::array<Real, 3>> f) {
    std::vector<std::vector<Real>> b(n + 1, std::vector<Real>(n + 1));
    for (int r = 0; r <= n; ++r)
      for (int c = 0; c <= n; ++c) b[r][c] = basis(n, c, Real(r) / n);
    for (int k = 0; k <= n; ++k) {
      int pivot = k;
      for (int r = k; r <= n; ++r)
        if (std::abs(b[r][k]) > std::abs(b[pivot][k])) pivot = r;
      std::swap(b[k], b[pivot]);
      std::swap(f[k], f[pivot]);
      for (int r = 0; r <= n; ++r) {
        if (r == k) continue;
        const Real m = b[r][k] / b[k][k];
        for (int c = k; c <= n; ++c) b[r][c] -= m * b[k][c];
        for (int d = 0; d < 3; ++d) f[r][d] -= m * f[k][d];
      }
    }
    for (int k = 0; k <= n; ++k)
      for (int d = 0; d < 3; ++d) f[k][d] /= b[k][k];
    return f;
  };
  std::vector<std::vector<std::array<Real, 3>>> net(p + 1);
  for (int i = 0; i <= p; ++i) {
    for (int j = 0; j <= q; ++j) {
      const Vec3 x = point(domain.u.lo + domain.u.width() * i / p, domain.v.lo + domain.v.width() * j / q);
      net[i].push_back({x.x, x.y, x.z});
    }
    net[i] = solve(q, net[i]);
  }
  NurbsSurfaceForm form;
  form.degree_u = p, form.degree_v = q;
  form.knots_u.assign(2 * (p + 1), 0.0), form.knots_v.assign(2 * (q + 1), 0.0);
  std::fill(form.knots_u.begin() + p + 1, form.knots_u.end(), 1.0);
  std::fill(form.knots_v.begin() + q + 1, form.knots_v.end(), 1.0);
  form.points.assign(static_cast<size_t>(p + 1) * (q + 1), Vec4(0, 0, 0, 1));
  for (int j = 0; j <= q; ++j) {
    std::vector<std::array<Real, 3>> column;
    for (int i = 0; i <= p; ++i) column.push_back(net[i][j]);
    column = solve(p, column);
    for (int i = 0; i <= p; ++i)
      for (int d = 0; d < 3; ++d) form.points[i * (q + 1) + j][d] = static_cast<double>(column[i][d]);
  }
  return std::make_shared<NurbsSurface>(form);
}

namespace detail {

// Seven: what the ray oracle has room for.
inline constexpr int kDegree = 7;
inline constexpr double kAgrees = 1e-11;  // of the size
inline constexpr int kMaxHalvings = 10;

// Whether the patch has the surface's points between those that it was made of.
inline bool agrees(const Surface& surface, const Surface& patch, const Rectangle& part, double size) {
  for (int i = 0; i < kDegree; ++i)
    for (int j = 0; j < kDegree; ++j) {
      const double s = (i + 0.5) / kDegree, t = (j + 0.5) / kDegree;
      const Vec3 p = surface.point(part.u.lo + s * part.u.width(), part.v.lo + t * part.v.width());
      if (!(glm::length(patch.point(s, t) - p) <= kAgrees * size)) return false;
    }
  return true;
}

inline void add_patches(const Surface& surface, const Rectangle& part, double size, int halvings,
                        std::vector<SurfacePtr>& patches) {
  const auto at = [&](double u, double v) { return surface.point(u, v); };
  const SurfacePtr patch = interpolated(kDegree, kDegree, part, at);
  if (agrees(surface, *patch, part, size)) {
    patches.push_back(patch);
    return;
  }
  if (halvings == kMaxHalvings) throw std::runtime_error("the surface is not smooth enough for patches");
  const double u = part.u.middle(), v = part.v.middle();
  for (const Interval& of_u : {Interval(part.u.lo, u), Interval(u, part.u.hi)})
    for (const Interval& of_v : {Interval(part.v.lo, v), Interval(v, part.v.hi)})
      add_patches(surface, {of_u, of_v}, size, halvings + 1, patches);
}

}  // namespace detail

// The surface itself where all its pieces are rational; else patches that agree with it to 1e-11 of its size.
inline std::vector<SurfacePtr> patches_of(const SurfacePtr& surface) {
  const std::vector<SurfacePiece> pieces = surface->pieces();
  if (std::all_of(pieces.begin(), pieces.end(), [](const SurfacePiece& piece) { return piece.is_rational(); }))
    return {surface};
  std::vector<SurfacePtr> patches;
  const double size = bounds(*surface).diameter();
  for (const SurfacePiece& piece : pieces) detail::add_patches(*surface, piece.domain, size, 0, patches);
  return patches;
}

}  // namespace lekalo::tests
