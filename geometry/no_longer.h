// A vector with a bound of its length, for formulas over numbers, jets and intervals: over an interval where such a
// formula divides by zero, as that of a direction does where a derivative may vanish, the bound is all there is to
// know.
#pragma once

#include "geometry/numerics/interval.h"
#include "geometry/numerics/triple.h"

namespace lekalo::geometry {

namespace detail {

inline double no_farther(double x, double) { return x; }
inline Interval no_farther(const Interval& x, const Interval& reach) {
  const double most = (1 + 1e-14) * magnitude(reach);  // unit vectors are of unit length to rounding only
  return intersect(x, {-most, most});
}
// Of derivatives the bound tells nothing.
template <template <class, int> class J, class S, int N>
J<S, N> no_farther(J<S, N> x, const J<S, N>& reach) {
  x.c[0] = no_farther(x.c[0], reach.c[0]);
  return x;
}

}  // namespace detail

// The vector, known to be no longer than this.
template <class T>
Triple<T> no_longer(const Triple<T>& vector, const T& length) {
  return {detail::no_farther(vector.x, length), detail::no_farther(vector.y, length),
          detail::no_farther(vector.z, length)};
}

}  // namespace lekalo::geometry
