#include "geometry/queries/differential/divided_difference.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "geometry/numerics/divided_differences.h"

namespace lekalo::geometry {

namespace {

// Equal nodes put together, in the order of their first ones.
std::vector<double> grouped(std::span<const double> nodes) {
  std::vector<double> result;
  for (const double node : nodes) {
    const auto last = std::find(result.rbegin(), result.rend(), node);
    result.insert(last == result.rend() ? result.end() : last.base(), node);
  }
  return result;
}

}  // namespace

DividedDifferences divided_differences(const Curve& curve, std::span<const double> given) {
  if (given.empty()) throw std::invalid_argument("divided differences need a node");
  DividedDifferences result{grouped(given), {}};
  const std::vector<double>& t = result.nodes;
  std::vector<Vec3> values;  // of equal nodes r, r', r'', ..
  for (size_t i = 0, first = 0; i < t.size(); ++i) {
    if (t[i] != t[first]) first = i;
    if (i - first > kMaxCurveOrder)
      throw std::invalid_argument("a node stands at most " + std::to_string(kMaxCurveOrder + 1) + " times");
    values.push_back(curve.evaluate(t[i], kMaxCurveOrder).d[i - first]);
  }
  result.differences = divided_differences(t, values);
  return result;
}

}  // namespace lekalo::geometry
