// What queries ask of a smooth piece of a curve or surface: derivatives of this side at its ends, and products of
// enclosures.
#pragma once

#include <algorithm>

#include "geometry/surface.h"

namespace lekalo::geometry {

inline Interval along(const Box3& box, int axis) { return {box.lo[axis], box.hi[axis]}; }

inline Interval product(const Box3& a, const Box3& b) {
  return along(a, 0) * along(b, 0) + along(a, 1) * along(b, 1) + along(a, 2) * along(b, 2);
}
// (p - r) . d
inline Interval product(const Vec3& p, const Box3& r, const Box3& d) {
  Interval sum(0);
  for (int k = 0; k < 3; ++k) sum += (Interval(p[k]) - along(r, k)) * along(d, k);
  return sum;
}
inline Interval square(const Box3& a) { return sqr(along(a, 0)) + sqr(along(a, 1)) + sqr(along(a, 2)); }

// The parameter, a little inside of the piece at its upper end, where evaluate() looks at the next one: however far
// from zero the piece lies.
inline double within(const Interval& piece, double t) {
  return std::clamp(t, piece.lo, std::max(piece.lo, std::min(piece.hi - 1e-15 * piece.width(), next_down(piece.hi))));
}
inline CurveJet evaluate_within(const Curve& curve, const Interval& piece, double t, int order) {
  return curve.evaluate(within(piece, t), order);
}
inline SurfaceJet evaluate_within(const Surface& surface, const Rectangle& piece, double u, double v, int order) {
  return surface.evaluate(within(piece.u, u), within(piece.v, v), order);
}

}  // namespace lekalo::geometry
