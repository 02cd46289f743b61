// How densely polygon points or grid lines must stand along a parameter.
#pragma once

#include <cmath>
#include <vector>

namespace lekalo::geometry {

// Lines wanted per unit of the parameter, constant on each interval [at[i], at[i + 1]].
struct LineDensity {
  std::vector<double> at;
  std::vector<double> value;  // at.size() - 1

  // Number of steps that the densities ask for in all.
  double total() const {
    double sum = 0;
    for (size_t i = 0; i < value.size(); ++i) sum += value[i] * (at[i + 1] - at[i]);
    return sum;
  }

  // Parameters from at.front() to at.back(), ends exact, spread so that every step takes the same share of the total;
  // at least `fewest` steps.
  std::vector<double> lines(int fewest = 1) const {
    // An exact count must not be rounded up because of the sum's last digits.
    const double wanted = total() * (1 - 1e-9);
    const int steps = std::max(fewest, static_cast<int>(std::ceil(wanted)));
    std::vector<double> result{at.front()};
    result.reserve(steps + 1);
    if (steps > 1 && !(wanted > 0)) {
      for (int k = 1; k < steps; ++k) result.push_back(at.front() + (at.back() - at.front()) * k / steps);
    } else {
      const double share = total() / steps;
      double sum = 0;
      size_t i = 0;
      for (int k = 1; k < steps; ++k) {
        const double target = k * share;
        while (i + 1 < value.size() && sum + value[i] * (at[i + 1] - at[i]) < target) {
          sum += value[i] * (at[i + 1] - at[i]);
          ++i;
        }
        result.push_back(std::min(at[i + 1], at[i] + (target - sum) / value[i]));
      }
    }
    result.push_back(at.back());
    return result;
  }

  // Multiplies the density where it overlaps [a, b].
  void raise(double a, double b, double factor) {
    for (size_t i = 0; i < value.size(); ++i)
      if (at[i] < b && at[i + 1] > a) value[i] = std::max(value[i], 0.5 / (b - a)) * factor;
  }
};

}  // namespace lekalo::geometry
