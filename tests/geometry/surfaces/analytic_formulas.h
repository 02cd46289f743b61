// Formulas of surfaces in a frame, written out over any number type for comparison in 113 bits.
#pragma once

#include "geometry/surfaces/surface_checks.h"

namespace lekalo::geometry::checks {

// local(u, v) -> Triple<T> in the coordinates of the frame.
template <class Local>
auto placed(const Frame& frame, const Local& local) {
  return [=](auto u, auto v) {
    const auto triple = [](const Vec3& w) { return Triple<Quad>{w.x, w.y, w.z}; };
    const auto p = local(u, v);
    return p.x * triple(frame.x) + p.y * triple(frame.y) + p.z * triple(frame.z) + triple(frame.origin);
  };
}

inline const Frame kSkewFrame = frame_from({0.3, -1.2, 2.5}, {1, 2, 2}, {1, 0.2, -0.4});

// Mean and Gaussian curvature (Golovanov 2016, 3.1.12), signed by the surface's normal.
struct Curvatures {
  double mean, gaussian;
};
inline Curvatures curvatures(const Surface& surface, double u, double v) {
  const SurfaceJet r = surface.evaluate(u, v, 2);
  const Vec3 m = surface.normal(u, v);
  const double g11 = glm::dot(r.du(), r.du()), g12 = glm::dot(r.du(), r.dv()), g22 = glm::dot(r.dv(), r.dv());
  const double b11 = glm::dot(r.duu(), m), b12 = glm::dot(r.duv(), m), b22 = glm::dot(r.dvv(), m);
  const double g = g11 * g22 - g12 * g12;
  return {(b11 * g22 + b22 * g11 - 2 * b12 * g12) / (2 * g), (b11 * b22 - b12 * b12) / g};
}

// Area over the domain by Gauss-Legendre quadrature, 8 x 8 cells of 6 x 6 points.
inline double area(const Surface& surface) {
  constexpr double x[3] = {0.2386191860831969, 0.6612093864662645, 0.9324695142031521};
  constexpr double w[3] = {0.4679139345726910, 0.3607615730481386, 0.1713244923791704};
  const Rectangle d = surface.domain();
  constexpr int kCells = 8;
  double sum = 0;
  for (int a = 0; a < kCells * 6; ++a) {
    for (int b = 0; b < kCells * 6; ++b) {
      const auto node = [&](int k) { return (k / 6 + 0.5 + 0.5 * (k % 2 ? 1 : -1) * x[k % 6 / 2]) / kCells; };
      const SurfaceJet r = surface.evaluate(d.u.lo + d.u.width() * node(a), d.v.lo + d.v.width() * node(b), 1);
      sum += w[a % 6 / 2] * w[b % 6 / 2] * glm::length(glm::cross(r.du(), r.dv()));
    }
  }
  return sum * d.u.width() * d.v.width() / (4 * kCells * kCells);
}

}  // namespace lekalo::geometry::checks
