// Local minima of a distance by sampling and pattern search: no derivatives, no interval arithmetic, no code of the
// library's queries. What it finds are minima; narrow ones may escape it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "geometry/describe.h"
#include "geometry/vectors.h"

namespace lekalo::tests {

// Points of polynomial Bezier curves and surfaces by de Casteljau's scheme.
inline geometry::Vec3 bezier_point(std::vector<geometry::Vec3> points, double t) {
  for (size_t n = points.size() - 1; n > 0; --n)
    for (size_t i = 0; i < n; ++i) points[i] = (1 - t) * points[i] + t * points[i + 1];
  return points[0];
}
inline geometry::Vec3 bezier_point(const geometry::Grid<geometry::Vec3>& net, double u, double v) {
  std::vector<geometry::Vec3> along_u;
  for (int i = 0; i < net.rows; ++i)
    along_u.push_back(bezier_point({net.values.begin() + static_cast<std::ptrdiff_t>(i) * net.columns,
                                    net.values.begin() + static_cast<std::ptrdiff_t>(i + 1) * net.columns},
                                   v));
  return bezier_point(along_u, u);
}

// Of the length of `way` over [0, 1]^N.
template <int N>
class DistanceOracle {
 public:
  using Place = std::array<double, N>;
  DistanceOracle(std::function<geometry::Vec3(const Place&)> way, int samples)
      : way_(std::move(way)), samples_(samples) {}

  double distance(const Place& x) const { return glm::length(way_(x)); }

  // No place within `far` in each parameter is nearer by more than rounding.
  bool is_minimum(const Place& x, double far) const {
    bool least = true;
    const double here = distance(x);
    each_neighbour(x, far, [&](const Place& y) { least = least && distance(y) >= here - 1e-14; });
    return least;
  }

  // Increasing.
  std::vector<double> minima() const {
    int count = 1;
    for (int i = 0; i < N; ++i) count *= samples_ + 1;
    std::vector<double> grid(count);
    for (int k = 0; k < count; ++k) grid[k] = distance(place(k));
    std::vector<Place> ends;
    for (int k = 0; k < count; ++k) {
      if (!is_least_of_grid(grid, k)) continue;
      const Place end = descended(place(k));
      const bool known = std::any_of(ends.begin(), ends.end(), [&](const Place& other) {
        double apart = 0;
        for (int i = 0; i < N; ++i) apart = std::max(apart, std::abs(end[i] - other[i]));
        return apart < 1e-4;
      });
      if (!known) ends.push_back(end);
    }
    std::vector<double> result;
    for (const Place& end : ends) result.push_back(distance(end));
    std::sort(result.begin(), result.end());
    return result;
  }

 private:
  Place place(int k) const {
    Place x;
    for (int i = 0; i < N; ++i, k /= samples_ + 1) x[i] = double(k % (samples_ + 1)) / samples_;
    return x;
  }
  template <class Visit>
  static void each_neighbour(const Place& x, double step, Visit&& visit) {
    int count = 1;
    for (int i = 0; i < N; ++i) count *= 3;
    for (int k = 0; k < count; ++k) {
      Place y = x;
      for (int i = 0, rest = k; i < N; ++i, rest /= 3) y[i] = std::clamp(x[i] + step * (rest % 3 - 1), 0.0, 1.0);
      if (y != x) visit(y);
    }
  }
  bool is_least_of_grid(const std::vector<double>& grid, int k) const {
    const Place x = place(k);
    bool least = true;
    each_neighbour(x, 1.0 / samples_, [&](const Place& y) {
      int index = 0;
      for (int i = N - 1; i >= 0; --i) index = index * (samples_ + 1) + int(std::lround(y[i] * samples_));
      least = least && grid[k] <= grid[index];
    });
    return least;
  }
  Place descended(Place x) const {
    double here = distance(x);
    for (double step = 0.5 / samples_; step > 1e-9;) {
      Place best = x;
      double least = here;
      each_neighbour(x, step, [&](const Place& y) {
        const double there = distance(y);
        if (there < least) least = there, best = y;
      });
      if (least < here)
        x = best, here = least;
      else
        step *= 0.5;
    }
    return x;
  }

  std::function<geometry::Vec3(const Place&)> way_;
  int samples_;
};

}  // namespace lekalo::tests
