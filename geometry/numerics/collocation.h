// One step of an initial value problem y' = f(y) by collocation in the zeros of a Chebyshev polynomial (Clenshaw,
// Norton 1963; Wright 1970): the polynomial with y(0) = y0 whose derivative takes the rates f in kNodes places of the
// step.
//
//   y(x) = y0 + h/2 integral from -1 to x of sum c_k T_k,   x in [-1, 1],   c the Chebyshev series of f(y(x))
//
// It is found by Picard's iteration, which converges where the step is short against the scale on which f changes. The
// last coefficients tell the error: that of y at the end of the step is much smaller than h |c_last|. So the solution
// is known as a polynomial of degree kNodes on each step, not only where steps meet.
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "geometry/numerics/chebyshev.h"

namespace lekalo::geometry {

template <int N>
struct CollocationStep {
  static constexpr std::size_t kNodes = 16;
  using State = std::array<double, N>;

  double h = 0;
  std::array<State, kNodes> states;  // at x_j = chebyshev_point(j), which decrease
  State end;
  std::array<std::array<double, kNodes + 1>, N> series;  // of y by T_k
  std::array<double, N> tail;                            // h times the largest of the last two c_k

  // The polynomial of component i by powers of x.
  std::array<double, kNodes + 1> powers(int i) const { return powers_of_chebyshev(series[i]); }
};

namespace collocation {

// The integral from -1 of sum c_k T_k as a series.
template <std::size_t N>
std::array<double, N + 1> integral(const std::array<double, N>& c) {
  std::array<double, N + 1> result{};
  const auto at = [&](std::size_t k) { return k < N ? c[k] : 0.0; };
  double sign = 1, sum = 0;
  for (std::size_t k = 1; k <= N; ++k) {
    result[k] = (k == 1 ? at(0) - 0.5 * at(2) : (at(k - 1) - at(k + 1)) / (2.0 * static_cast<double>(k)));
    sum += sign * result[k];
    sign = -sign;
  }
  result[0] = sum;  // T_k(-1) = (-1)^k
  return result;
}

// integrals[j][i]: from -1 to x_j of the polynomial that is 1 in x_i and 0 in the other nodes; the last row to 1.
template <std::size_t N>
const std::array<std::array<double, N>, N + 1>& integrals() {
  static const auto table = [] {
    std::array<std::array<double, N>, N + 1> result;
    for (std::size_t i = 0; i < N; ++i) {
      std::array<double, N> one{};
      one[i] = 1;
      const auto series = integral(chebyshev_coefficients(one));
      for (std::size_t j = 0; j <= N; ++j) {
        const double angle = j < N ? std::acos(chebyshev_point(static_cast<int>(j), N)) : 0;
        result[j][i] = 0;
        for (std::size_t k = 0; k <= N; ++k) result[j][i] += series[k] * std::cos(static_cast<double>(k) * angle);
      }
    }
    return result;
  }();
  return table;
}

}  // namespace collocation

// The step of length h from y0, or none where the iteration does not converge. `rates(y)` gives f(y) as an optional;
// none ends the step without a result.
template <int N, class Rates>
std::optional<CollocationStep<N>> collocate(const std::array<double, N>& y0, double h, const Rates& rates) {
  constexpr std::size_t kNodes = CollocationStep<N>::kNodes;
  constexpr int kMaxTimes = 60;
  constexpr double kSettled = 4e-16, kNearlySettled = 1e-13;  // changes, of the size of the component
  const auto& table = collocation::integrals<kNodes>();
  CollocationStep<N> step;
  step.h = h;
  const auto first = rates(y0);
  if (!first) return std::nullopt;
  for (std::size_t j = 0; j < kNodes; ++j)
    for (int i = 0; i < N; ++i)
      step.states[j][i] = y0[i] + 0.5 * h * (1 + chebyshev_point(static_cast<int>(j), kNodes)) * (*first)[i];
  std::array<std::array<double, kNodes>, N> f;
  double before = INFINITY;
  for (int time = 0;; ++time) {
    for (std::size_t j = 0; j < kNodes; ++j) {
      const auto rate = rates(step.states[j]);
      if (!rate) return std::nullopt;
      for (int i = 0; i < N; ++i) f[i][j] = (*rate)[i];
    }
    double change = 0;
    const auto moved = [&](int i, std::size_t row) {
      double sum = 0;
      for (std::size_t k = 0; k < kNodes; ++k) sum += table[row][k] * f[i][k];
      return y0[i] + 0.5 * h * sum;
    };
    for (int i = 0; i < N; ++i) {
      double size = std::abs(y0[i]);
      for (const double x : f[i]) size = std::max(size, h * std::abs(x));
      for (std::size_t j = 0; j < kNodes; ++j) {
        const double to = moved(i, j);
        if (size > 0) change = std::max(change, std::abs(to - step.states[j][i]) / size);
        step.states[j][i] = to;
      }
      step.end[i] = moved(i, kNodes);
    }
    if (change <= kSettled || (change <= kNearlySettled && change >= 0.5 * before)) break;
    if (!(change < 1e3) || time == kMaxTimes) return std::nullopt;
    before = change;
  }
  for (int i = 0; i < N; ++i) {
    const auto c = chebyshev_coefficients(f[i]);
    step.tail[i] = h * std::max(std::abs(c[kNodes - 1]), std::abs(c[kNodes - 2]));
    step.series[i] = collocation::integral(c);
    for (double& x : step.series[i]) x *= 0.5 * h;
    step.series[i][0] += y0[i];
  }
  return step;
}

}  // namespace lekalo::geometry
