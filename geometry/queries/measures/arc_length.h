// Points of a curve by arc length.
//
//   integral of |r'| from the domain's beginning to t = s L, L the length of the curve          (Golovanov 2016, 2.1)
#pragma once

#include "geometry/curve.h"

namespace lekalo::geometry {

// The parameter t at the fraction s in [0, 1] of the curve's length. Where several parameters belong to one length
// (the curve rests) any of them. Throws std::invalid_argument for an unbounded curve or one without length.
double parameter_at_fraction(const Curve& curve, double s);

}  // namespace lekalo::geometry
