#include "geometry/queries/differential/divided_difference.h"

#include <algorithm>
#include <stdexcept>
#include <string>

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
  std::vector<CurveJet> jets;
  for (const double node : t) {
    if (std::count(t.begin(), t.end(), node) > kMaxCurveOrder + 1)
      throw std::invalid_argument("a node stands at most " + std::to_string(kMaxCurveOrder + 1) + " times");
    jets.push_back(curve.evaluate(node, kMaxCurveOrder));
  }
  std::vector<Vec3> column;  // r[t_i .. t_(i+k)]
  for (const CurveJet& jet : jets) column.push_back(jet.d[0]);
  double factorial = 1;
  for (size_t k = 0; k < t.size(); ++k) {
    result.differences.push_back(column[0]);
    factorial *= static_cast<double>(k + 1);
    for (size_t i = 0; i + k + 1 < t.size(); ++i)
      column[i] =
          t[i + k + 1] == t[i] ? jets[i].d[k + 1] / factorial : (column[i + 1] - column[i]) / (t[i + k + 1] - t[i]);
  }
  return result;
}

}  // namespace lekalo::geometry
