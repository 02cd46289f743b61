// Taylor polynomials of what lies on a surface: S(u(t), v(t)) and its partial derivatives along the way, by the formula
// of Faa di Bruno, as numbers or certified ranges (S double or Interval).
#pragma once

#include "geometry/numerics/jet.h"
#include "geometry/numerics/triple.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

inline Triple<double> derivative_of(const SurfaceJet& jet, int i, int j) {
  const Vec3& d = jet.d(i, j);
  return {d.x, d.y, d.z};
}
inline Triple<Interval> derivative_of(const SurfaceEnclosure& boxes, int i, int j) {
  const Box3& d = boxes.d(i, j);
  return {{d.lo.x, d.hi.x}, {d.lo.y, d.hi.y}, {d.lo.z, d.hi.z}};
}

// The derivative i0 times by u and j0 times by v along (u(t), v(t)); `derivatives` holds those up to the order
// i0 + j0 + N at (u.c[0], v.c[0]), or over these ranges. Where that is more than kMaxSurfaceOrder the coefficients
// beyond mean nothing; where a derivative is NaN, for its order is unknown, so are those of its order and above alone.
template <class S, int N, class Derivatives>
Triple<Jet<S, N>> along_surface(const Derivatives& derivatives, const Jet<S, N>& u, const Jet<S, N>& v, int i0 = 0,
                                int j0 = 0) {
  const int most = std::min(N, kMaxSurfaceOrder - i0 - j0);
  Jet<S, N> du = u, dv = v;
  du.c[0] = dv.c[0] = S(0);
  Triple<Jet<S, N>> sum;
  Jet<S, N> power_u(S(1));
  double factorial_i = 1;
  for (int i = 0; i <= most; ++i) {
    if (i > 0) power_u = power_u * du, factorial_i *= i;
    Jet<S, N> term = power_u;
    double factorial_j = 1;
    for (int j = 0; i + j <= most; ++j) {
      if (j > 0) term = term * dv, factorial_j *= j;
      const Triple<S> d = (S(1) / S(factorial_i * factorial_j)) * derivative_of(derivatives, i0 + i, j0 + j);
      for (int k = i + j; k <= N; ++k)
        sum.x.c[k] += term.c[k] * d.x, sum.y.c[k] += term.c[k] * d.y, sum.z.c[k] += term.c[k] * d.z;
    }
  }
  return sum;
}

}  // namespace lekalo::geometry
