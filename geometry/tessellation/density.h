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

  // Makes the density larger where steps of the lines were too long: excess[i] > 1 by so many times the tolerance
  // between lines[i] and lines[i + 1]. Deviations grow with the square of the step. Only these steps' own density is
  // raised: what bends in one place, or is singular there, makes no others shorter. False when none was too long.
  bool raise(const std::vector<double>& lines, const std::vector<double>& excess) {
    bool any = false;
    LineDensity raised{{at.front()}, {}};
    raised.at.reserve(at.size() + lines.size());
    raised.value.reserve(at.size() + lines.size());
    size_t i = 0;  // the interval that goes on from raised.at.back()
    const auto extend = [&](double to, double least, double factor) {
      for (; i < value.size() && raised.at.back() < to; i += at[i + 1] <= raised.at.back()) {
        raised.at.push_back(std::min(to, at[i + 1]));
        raised.value.push_back(std::max(value[i], least) * factor);
      }
    };
    for (size_t k = 0; k + 1 < lines.size(); ++k) {
      if (!(excess[k] > 1)) continue;
      const double from = std::max(lines[k], at.front()), to = std::min(lines[k + 1], at.back());
      if (!(from < to)) continue;
      any = true;
      extend(from, 0, 1);
      // A part that asked for next to nothing still gets its share of the step.
      extend(to, 0.5 / (lines[k + 1] - lines[k]), std::min(2.0, std::sqrt(excess[k]) * 1.02));
    }
    extend(at.back(), 0, 1);
    *this = std::move(raised);
    return any;
  }
};

}  // namespace lekalo::geometry
