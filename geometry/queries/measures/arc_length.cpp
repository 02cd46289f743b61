#include "geometry/queries/measures/arc_length.h"

#include <cmath>
#include <stdexcept>

#include "geometry/queries/measures/mass_properties.h"

namespace lekalo::geometry {

// Newton's method on length(t) - s L, kept inside a bracket that bisection narrows where it leaves it.
double parameter_at_fraction(const Curve& curve, double s) {
  const Interval domain = curve.domain();
  const double whole = arc_length(curve, domain.lo, domain.hi).value;
  if (!(whole > 0)) throw std::invalid_argument("the curve has no length");
  if (s <= 0) return domain.lo;
  if (s >= 1) return domain.hi;
  constexpr int kMaxSteps = 100;
  double lo = domain.lo, hi = domain.hi, length_to_lo = 0;
  double t = lo + s * (hi - lo);
  for (int step = 0; step < kMaxSteps && lo < t && t < hi; ++step) {
    const double length = length_to_lo + arc_length(curve, lo, t).value;
    const double excess = length - s * whole;
    const double speed = glm::length(curve.evaluate(t, 1).d[1]);
    if (std::abs(excess) <= 4e-15 * whole) break;
    if (excess > 0) {
      hi = t;
    } else {
      lo = t;
      length_to_lo = length;
    }
    const double next = t - excess / speed;
    t = next > lo && next < hi ? next : 0.5 * (lo + hi);
  }
  return t;
}

}  // namespace lekalo::geometry
