// The worst of many differences, for tests. std::max forgets a difference that is no number: max(worst, NaN) is
// `worst`.
#pragma once

#include <cmath>
#include <limits>

namespace lekalo::tests {

// The larger one; NaN is worse than any number.
inline double worse(double worst, double difference) {
  return std::isnan(difference) ? std::numeric_limits<double>::infinity() : difference > worst ? difference : worst;
}

}  // namespace lekalo::tests
