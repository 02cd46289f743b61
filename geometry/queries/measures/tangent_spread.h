// The widest angle between two tangents of a curve. A curve is monotone if it is less than a right angle (Golovanov
// 2016, 3.3: the directrix of a translational surface).
#pragma once

#include "geometry/curve.h"

namespace lekalo::geometry {

struct TangentSpread {
  double angle = 0;     // radians, 0..pi
  double s = 0, t = 0;  // parameters of the tangents
  bool is_monotone() const { return angle < 0.5 * kPi; }
};

// Looked for among 256 tangents of each smooth piece, and from the best pair on. Throws std::invalid_argument for an
// unbounded curve.
TangentSpread tangent_spread(const Curve& curve);

}  // namespace lekalo::geometry
