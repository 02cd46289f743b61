// What Hausdorff's and Frechet's distances ask of a curve.
#pragma once

#include <stdexcept>
#include <string>

#include "geometry/curves/operations/smooth_pieces.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

// Throws std::invalid_argument for a curve that is not bounded, or whose pieces do not join: bounds by derivatives know
// nothing of steps.
inline void demand_continuous(const Curve& curve) {
  if (!(curve.domain().width() < kInfinity)) throw std::invalid_argument("the curve is not bounded");
  const std::vector<CurvePiece> pieces = curve.pieces();
  const double size = bounds(curve).diameter();
  for (size_t k = 0; k + 1 < pieces.size(); ++k) {
    const Vec3 before = evaluate_within(curve, pieces[k].domain, pieces[k].domain.hi, 0).d[0],
               behind = curve.point(pieces[k + 1].domain.lo);
    if (!(glm::length(behind - before) <= kSamePoint * size))
      throw std::invalid_argument("the curve jumps at t = " + std::to_string(pieces[k + 1].domain.lo));
  }
}

}  // namespace lekalo::geometry
