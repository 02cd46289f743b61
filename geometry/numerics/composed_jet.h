// Functions of jets in several variables, by composition with those of jets in one (jet.h): what Jet2, Jet3 and
// Gradient have in common. J has S for scalars, the order N, and
//
//   template <class F> static J apply(F f, const J& a)    f of a jet, where f takes a Jet<S, N>
//   static int degree(int k)                              of coefficient k (not over intervals)
#pragma once

#include <cmath>
#include <type_traits>

#include "geometry/numerics/interval.h"

namespace lekalo::geometry {

template <class S, int N>
struct Jet;

template <class J, class S, int N>
struct ComposedJet {
#define LEKALO_COMPOSED_FUNCTION(function)                              \
  friend J function(const J& a) {                                       \
    return J::apply([](const Jet<S, N>& x) { return function(x); }, a); \
  }
  LEKALO_COMPOSED_FUNCTION(exp)
  LEKALO_COMPOSED_FUNCTION(log)
  LEKALO_COMPOSED_FUNCTION(log10)
  LEKALO_COMPOSED_FUNCTION(sin)
  LEKALO_COMPOSED_FUNCTION(cos)
  LEKALO_COMPOSED_FUNCTION(tan)
  LEKALO_COMPOSED_FUNCTION(asin)
  LEKALO_COMPOSED_FUNCTION(acos)
  LEKALO_COMPOSED_FUNCTION(atan)
  LEKALO_COMPOSED_FUNCTION(sinh)
  LEKALO_COMPOSED_FUNCTION(cosh)
  LEKALO_COMPOSED_FUNCTION(tanh)
  LEKALO_COMPOSED_FUNCTION(asinh)
  LEKALO_COMPOSED_FUNCTION(acosh)
  LEKALO_COMPOSED_FUNCTION(atanh)
#undef LEKALO_COMPOSED_FUNCTION

  friend J sqrt(const J& a) {
    return power(a, 0.5, [](const Jet<S, N>& x) { return sqrt(x); });
  }
  friend J cbrt(const J& a) {
    return power(a, 1.0 / 3, [](const Jet<S, N>& x) { return cbrt(x); });
  }
  friend J atan2(const J& y, const J& x) {  // as for Jet
    using std::atan2;
    const S angle = atan2(y.value(), x.value());
    if (y.is_constant() && x.is_constant()) return J(angle);
    J across = x.value() * y - y.value() * x;
    across.c[0] = S(0);
    J r = atan(across / (x.value() * x + y.value() * y));
    r.c[0] = angle;
    return r;
  }
  friend J hypot(const J& x, const J& y) {
    using std::hypot;
    J r = sqrt(sqr(x) + sqr(y));
    r.c[0] = hypot(x.value(), y.value());
    return r;
  }
  friend J pow(const J& base, const J& exponent) {
    if (!exponent.is_constant()) return exp(exponent * log(base));
    const Jet<S, N> constant(exponent.value());
    return power(base, exponent.value(), [&](const Jet<S, N>& x) { return pow(x, constant); });
  }
  template <class A>
  requires std::is_arithmetic_v<A>
  friend J pow(const J& base, A exponent) {
    return power(base, exponent, [&](const Jet<S, N>& x) { return pow(x, exponent); });
  }

 private:
  // f(a) = a^p. At a zero the infinite derivatives of f make no numbers with those of a that vanish. Of an a of the
  // order m of the distance f(a) is of the order m p, and its derivatives of lower orders are zero.
  template <class F, class P>
  static J power(const J& a, const P& p, F f) {
    J r = J::apply(f, a);
    if constexpr (!std::is_same_v<S, Interval>) {
      if (a.value() == S(0) && p > P(0)) {
        int first = 1;
        while (first < J::kCount && a.c[first] == S(0)) ++first;
        for (int k = 1; first < J::kCount && k < J::kCount && J::degree(k) < J::degree(first) * p; ++k) r.c[k] = S(0);
      }
    }
    return r;
  }
};

}  // namespace lekalo::geometry
