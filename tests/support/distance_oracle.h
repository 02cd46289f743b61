// Local minima of a distance, without interval arithmetic, Newton's iteration or code of the library's queries: by
// sampling and pattern search, whose ends are minima but which narrow ones may escape; and by halving of Bernstein
// forms (support/root_oracle.h), which none can.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "geometry/describe.h"
#include "geometry/vectors.h"
#include "support/root_oracle.h"

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

  // Whether a stationary place (on a border: along it) is a minimum: the square grows from the border inwards, and its
  // second differences along the border are positive definite (Cholesky). `way` must be a polynomial beyond [0, 1] too.
  bool is_strict_minimum(const Place& x) const {
    constexpr double kStep = 1e-4;
    const auto square = [&](int i, double by_i, int j, double by_j) {
      Place y = x;
      y[i] += kStep * by_i;
      y[j] += kStep * by_j;
      return glm::dot(way_(y), way_(y));
    };
    std::vector<int> free;
    for (int i = 0; i < N; ++i) {
      if (x[i] > 0 && x[i] < 1)
        free.push_back(i);
      else if ((square(i, 1, i, 0) - square(i, -1, i, 0)) * (x[i] > 0 ? -1 : 1) < 0)
        return false;
    }
    const size_t n = free.size();
    std::vector<double> h(n * n);
    for (size_t i = 0; i < n; ++i)
      for (size_t j = 0; j < n; ++j)
        h[i * n + j] = i == j ? square(free[i], 1, free[i], 0) + square(free[i], -1, free[i], 0) -
                                    2 * square(free[i], 0, free[i], 0)
                              : 0.25 * (square(free[i], 1, free[j], 1) + square(free[i], -1, free[j], -1) -
                                        square(free[i], 1, free[j], -1) - square(free[i], -1, free[j], 1));
    for (size_t k = 0; k < n; ++k) {
      if (!(h[k * n + k] > 0)) return false;
      for (size_t i = k + 1; i < n; ++i)
        for (size_t j = k + 1; j < n; ++j) h[i * n + j] -= h[i * n + k] * h[k * n + j] / h[k * n + k];
    }
    return true;
  }

  // Increasing.
  std::vector<double> minima() const {
    int count = 1;
    for (int i = 0; i < N; ++i) count *= samples_ + 1;
    std::vector<double> grid(count);
    for (int k = 0; k < count; ++k) grid[k] = distance(place(k));
    std::vector<Place> ends;
    for (int k = 0; k < count; ++k) {
      if (!is_minimum_of_grid(grid, k)) continue;
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
  bool is_minimum_of_grid(const std::vector<double>& grid, int k) const {
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

// A polynomial with some of its parameters set to 0 or 1 (-1: left free).
inline Bernstein<3> on_border(const Bernstein<3>& all, const std::array<int, 3>& held) {
  Bernstein<3> r;
  for (int k = 0; k < 3; ++k) r.degree[k] = held[k] < 0 ? all.degree[k] : 0;
  for (int i = 0; i <= r.degree[0]; ++i)
    for (int j = 0; j <= r.degree[1]; ++j)
      for (int k = 0; k <= r.degree[2]; ++k)
        r.c.push_back(all.c[all.index(held[0] > 0 ? all.degree[0] : i, held[1] > 0 ? all.degree[1] : j,
                                      held[2] > 0 ? all.degree[2] : k)]);
  return r;
}

// Places on the border `held` of [0, 1]^N (or inside, all free) where the length of `way` is stationary along it.
template <int N, int F>
void add_stationary(const Bernstein<3>& way, const std::array<int, 3>& held, const std::array<int, F>& free,
                    std::vector<std::array<double, N>>& places, bool& unclear) {
  using State = std::array<Bernstein<1>, F>;
  const Bernstein<3> part = on_border(way, held);
  State equations;
  for (int i = 0; i < F; ++i) equations[i] = dot(part, derivative(part, free[i]));
  const auto roots = roots_by_halving<F, State>(
      equations, 1e-9, [](const State& f) { return std::all_of(f.begin(), f.end(), changes_sign); },
      [&](const State& f, int axis, bool upper) {
        State half = f;
        for (Bernstein<1>& one : half) one = one.half(free[axis], upper);
        return half;
      },
      unclear);
  for (const auto& root : roots) {
    std::array<double, N> place;
    for (int i = 0; i < N; ++i) place[i] = held[i];
    for (int i = 0; i < F; ++i) place[free[i]] = root[i];
    places.push_back(place);
  }
}

// All minima of the length of `way` over [0, 1]^N, N = 2 or 3.
template <int N>
std::vector<std::array<double, N>> minima_by_halving(const Bernstein<3>& way, const DistanceOracle<N>& oracle,
                                                     bool& unclear) {
  std::vector<std::array<double, N>> places, result;
  int borders = 1;
  for (int i = 0; i < N; ++i) borders *= 3;
  for (int border = 0; border < borders; ++border) {
    std::array<int, 3> held{0, 0, 0};
    std::vector<int> free;
    for (int i = 0, rest = border; i < N; ++i, rest /= 3) {
      held[i] = rest % 3 - 1;
      if (held[i] < 0) free.push_back(i);
    }
    if (free.empty()) {
      std::array<double, N> corner;
      for (int i = 0; i < N; ++i) corner[i] = held[i];
      places.push_back(corner);
    } else if (free.size() == 1) {
      add_stationary<N, 1>(way, held, {free[0]}, places, unclear);
    } else if (free.size() == 2) {
      add_stationary<N, 2>(way, held, {free[0], free[1]}, places, unclear);
    } else {
      add_stationary<N, 3>(way, held, {0, 1, 2}, places, unclear);
    }
  }
  for (const auto& place : places)
    if (oracle.is_strict_minimum(place)) result.push_back(place);
  return result;
}

}  // namespace lekalo::tests
