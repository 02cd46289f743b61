// Interpolation by Chebyshev polynomials on [-1, 1] in the points cos(pi (j + 1/2)/n), which lie inside (Trefethen
// 2013, ch. 3): near best, and its last coefficients tell how good it is.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

namespace lekalo::geometry {

inline double chebyshev_point(int j, int n) { return std::cos(std::numbers::pi * (j + 0.5) / n); }

// The coefficients c with sum c_k T_k = f in the points, from f there; T_k(x) = cos(k arccos x).
template <class T, std::size_t N>
std::array<T, N> chebyshev_coefficients(const std::array<T, N>& f) {
  std::array<T, N> c;
  for (std::size_t k = 0; k < N; ++k) {
    T sum(0);
    for (std::size_t j = 0; j < N; ++j)
      sum += f[j] * std::cos(std::numbers::pi * static_cast<double>(k) * (j + 0.5) / N);
    c[k] = sum * ((k == 0 ? 1.0 : 2.0) / N);
  }
  return c;
}

// The same polynomial in powers of x.
template <class T, std::size_t N>
std::array<T, N> powers_of_chebyshev(const std::array<T, N>& c) {
  std::array<double, N> before{}, now{};  // T_(k-1), T_k
  now[0] = 1;
  std::array<T, N> result;
  result.fill(T(0));
  for (std::size_t k = 0; k < N; ++k) {
    for (std::size_t i = 0; i <= k; ++i) result[i] += now[i] * c[k];
    std::array<double, N> next{};
    for (std::size_t i = 0; i < N; ++i) next[i] = (i > 0 ? (k == 0 ? 1 : 2) * now[i - 1] : 0) - before[i];
    if (k == 0) next[0] = 0;
    before = now;
    now = next;
  }
  return result;
}

}  // namespace lekalo::geometry
