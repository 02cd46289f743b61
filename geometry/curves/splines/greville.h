// Where the control points of a spline stand that is the identity (Greville 1964).
#pragma once

#include <span>

namespace lekalo::geometry {

// The mean of the `degree` >= 1 inner knots of the basis function i.
inline double greville(std::span<const double> knots, int degree, int i) {
  double sum = 0;
  for (int k = 1; k <= degree; ++k) sum += knots[static_cast<size_t>(i + k)];
  return sum / degree;
}

}  // namespace lekalo::geometry
