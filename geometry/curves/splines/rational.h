// The quotient rule: derivatives of r = A/w from those of the homogeneous (A, w) (Golovanov 2016, 2.9.8 and 3.8; Piegl,
// Tiller 1997, 4.3 and 4.5).
//
//   r^(k) = (A^(k) - sum_{i=1..k} C(k, i) w^(i) r^(k-i)) / w, and with double sums for surfaces.
#pragma once

#include "geometry/surface.h"

namespace lekalo::geometry {

inline constexpr double kBinomial[7][7] = {{1, 0, 0, 0, 0, 0, 0},   {1, 1, 0, 0, 0, 0, 0}, {1, 2, 1, 0, 0, 0, 0},
                                           {1, 3, 3, 1, 0, 0, 0},   {1, 4, 6, 4, 1, 0, 0}, {1, 5, 10, 10, 5, 1, 0},
                                           {1, 6, 15, 20, 15, 6, 1}};

// a[0..order]: homogeneous point and derivatives.
inline void divide_by_weight(const Vec4* a, int order, Vec3* r) {
  const double reciprocal = 1 / a[0].w;
  for (int k = 0; k <= order; ++k) {
    Vec3 sum(a[k]);
    for (int i = 1; i <= k; ++i) sum -= (kBinomial[k][i] * a[i].w) * r[k - i];
    r[k] = reciprocal * sum;
  }
}

// a and r by SurfaceJet::index, all derivatives of total order up to `order`.
inline void divide_by_weight_2d(const Vec4* a, int order, Vec3* r) {
  const auto index = SurfaceJet::index;
  const double reciprocal = 1 / a[0].w;
  for (int n = 0; n <= order; ++n)
    for (int q = 0; q <= n; ++q) {
      const int p = n - q;
      Vec3 sum(a[index(p, q)]);
      for (int s = 0; s <= p; ++s)
        for (int t = s == 0 ? 1 : 0; t <= q; ++t)
          sum -= (kBinomial[p][s] * kBinomial[q][t] * a[index(s, t)].w) * r[index(p - s, q - t)];
      r[index(p, q)] = reciprocal * sum;
    }
}

}  // namespace lekalo::geometry
