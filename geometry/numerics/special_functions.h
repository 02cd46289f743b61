// Functions without a closed form, of numbers, intervals, and jets of both:
//
//   erf(x) = 2/sqrt(pi) int_0^x exp(-v^2) dv
//   fresnel_s(x) = int_0^x sin(pi v^2/2) dv,   fresnel_c(x) = int_0^x cos(pi v^2/2) dv     (Abramowitz, Stegun
//   1964, 7.3) sinc(x) = sin(x)/x, sinc(0) = 1 factorial(n) for whole n >= 0;  binom(n, k) = n (n - 1) .. (n - k +
//   1)/k! for whole k >= 0; else no number
//
// Errors of doubles: erf that of the library, the others at most kSpecialError. Jets get the derivatives from those of
// the integrands; those of sinc are bounded over intervals by |sinc^(k)| <= 1/(k + 1), since sinc(x) is the integral of
// cos(s x) over s in [0, 1].
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "geometry/numerics/interval.h"
#include "geometry/numerics/jet.h"

namespace lekalo::geometry {

inline constexpr double kSpecialError = 2e-15;

double fresnel_s(double x);
double fresnel_c(double x);
double sinc(double x);
double factorial(double n);

Interval erf(const Interval& x);
Interval fresnel_s(const Interval& x);
Interval fresnel_c(const Interval& x);
Interval sinc(const Interval& x);
Interval factorial(const Interval& n);

// Taylor coefficients of sinc about x, the first `count`, at most 7 (order 6).
void sinc_series(double x, int count, double* coefficients);
void sinc_series(const Interval& x, int count, Interval* coefficients);

namespace detail {
template <class S>
S half_pi() {
  if constexpr (std::is_same_v<S, Interval>)
    return Interval(1.5707963267948966, next_up(1.5707963267948966));
  else
    return S(1.5707963267948966);
}
template <class S>
S erf_factor() {
  if constexpr (std::is_same_v<S, Interval>)
    return Interval(next_down(1.1283791670955126), next_up(1.1283791670955126));
  else
    return S(1.1283791670955126);
}
}  // namespace detail

template <class S, int N>
Jet<S, N> erf(const Jet<S, N>& a) {
  using std::erf;
  return Jet<S, N>::integral(S(erf(a.c[0])), detail::erf_factor<S>() * exp(-sqr(a)), a);
}
template <class S, int N>
Jet<S, N> fresnel_s(const Jet<S, N>& a) {
  return Jet<S, N>::integral(fresnel_s(a.c[0]), sin(detail::half_pi<S>() * sqr(a)), a);
}
template <class S, int N>
Jet<S, N> fresnel_c(const Jet<S, N>& a) {
  return Jet<S, N>::integral(fresnel_c(a.c[0]), cos(detail::half_pi<S>() * sqr(a)), a);
}
template <class S, int N>
Jet<S, N> sinc(const Jet<S, N>& a) {
  Jet<S, N> series;
  sinc_series(a.c[0], N + 1, series.c.data());
  return Jet<S, N>::composed(series, a);
}
// Of numbers that do not change only.
template <class S, int N>
Jet<S, N> factorial(const Jet<S, N>& a) {
  if (a.is_constant()) return Jet<S, N>(factorial(a.c[0]));
  return Jet<S, N>(factorial(S(std::numeric_limits<double>::quiet_NaN())));
}

// Jets in several variables, by those in one.
template <class J>
concept ComposedOfJets = requires(const J& a) {
  J::apply([](const auto& x) { return x; }, a);
};
#define LEKALO_COMPOSED_SPECIAL(function)                          \
  template <ComposedOfJets J>                                      \
  J function(const J& a) {                                         \
    return J::apply([](const auto& x) { return function(x); }, a); \
  }
LEKALO_COMPOSED_SPECIAL(erf)
LEKALO_COMPOSED_SPECIAL(fresnel_s)
LEKALO_COMPOSED_SPECIAL(fresnel_c)
LEKALO_COMPOSED_SPECIAL(sinc)
LEKALO_COMPOSED_SPECIAL(factorial)
#undef LEKALO_COMPOSED_SPECIAL

// `k` is one whole number, at most 1000.
template <class T>
T binom(const T& n, double k) {
  if (!(k >= 0 && k <= 1000 && k == std::floor(k))) return T(0.0) * T(std::numeric_limits<double>::quiet_NaN());
  T result(1.0);
  for (int j = 0; j < static_cast<int>(k); ++j)
    result = result * (n - static_cast<double>(j)) / static_cast<double>(j + 1);
  return result;
}

}  // namespace lekalo::geometry
