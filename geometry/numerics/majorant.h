// Majorant: bounds on the Taylor coefficients of a function of a box, for all directions at once. An interval for the
// values, c[0], and for orders 1 to N bounds on the magnitudes, as intervals about zero:
//
//   F(p + s w) = sum F_k(p, w) s^k   =>   F(p, w) in c[0],  |F_k(p, w)| <= magnitude(c[k])
//
// for every place p of the box and every direction w of a cube. Variables have the half sides of the cube for c[1].
// Products of majorants bound the coefficients of products, and a majorant of f with that of its argument put into it
// bounds those of f(a) (the method of majorants, Cauchy). The coefficients of several directions at once are bounded
// too: that of s^i t^j in F(p + s w + t v) by (i + j)! / (i! j!) magnitude(c[i + j]), since sums over i and j of
// products of binomials are binomials again (Vandermonde).
#pragma once

#include "geometry/numerics/composed_jet.h"
#include "geometry/numerics/jet.h"

namespace lekalo::geometry {

template <int N>
struct Majorant : JetOperations<Majorant<N>, Interval, N + 1>, ComposedJet<Majorant<N>, Interval, N> {
  using Base = JetOperations<Majorant<N>, Interval, N + 1>;
  using Base::c;
  static constexpr int kFirst = 0;  // bounds for all directions at once

  constexpr Majorant() = default;
  template <JetScalar<Interval> A>
  constexpr Majorant(const A& constant) {  // implicit: numbers mix freely with jets in formulas
    c[0] = Interval(constant);
  }
  static constexpr Majorant variable(const Interval& values, double half_side) {
    Majorant r(values);
    r.c[1] = about_zero(half_side);
    return r;
  }

  static constexpr Majorant product(const Majorant& a, const Majorant& b) {
    Majorant r(a.c[0] * b.c[0]);
    const auto x = a.magnitudes(), y = b.magnitudes();
    for (int k = 1; k <= N; ++k) {
      double sum = 0;
      for (int i = 0; i <= k; ++i) sum += x[i] * y[k - i];
      r.c[k] = about_zero(kUp * sum);
    }
    return r;
  }
  static constexpr Majorant quotient(const Majorant& a, const Majorant& b) {
    Majorant r(a.c[0] / b.c[0]);
    const auto x = a.magnitudes(), y = b.magnitudes();
    std::array<double, N + 1> z{magnitude(r.c[0])};
    for (int k = 1; k <= N; ++k) {
      double sum = x[k];
      for (int i = 0; i < k; ++i) sum += z[i] * y[k - i];
      z[k] = kUp * sum / mignitude(b.c[0]);
      r.c[k] = about_zero(z[k]);
    }
    return r;
  }
  // f of a majorant, where f takes jets in one variable.
  template <class F>
  static Majorant apply(F f, const Majorant& a) {
    if (a.is_constant()) return Majorant(f(Jet<Interval, N>(a.c[0])).c[0]);
    return composed(f(Jet<Interval, N>::variable(a.c[0])), a);
  }
  // The function with these Taylor coefficients over a's values, of a.
  static Majorant composed(const Jet<Interval, N>& function, const Majorant& a) {
    std::array<double, N + 1> off = a.magnitudes(), sum{magnitude(function.c[N])};
    for (int n = N - 1; n >= 0; --n) {
      // times a - a0, whose powers begin with that of s
      for (int k = N; k >= 1; --k) {
        double next = 0;
        for (int i = 1; i <= k; ++i) next += off[i] * sum[k - i];
        sum[k] = kUp * next;
      }
      sum[0] = magnitude(function.c[n]);
    }
    Majorant r(function.c[0]);
    for (int k = 1; k <= N; ++k) r.c[k] = about_zero(sum[k]);
    return r;
  }

 private:
  static constexpr double kUp = 1 + 0x1p-48;  // for the rounding of a sum of at most N + 1 products
  static constexpr Interval about_zero(double magnitude) { return {-magnitude, magnitude}; }
  constexpr std::array<double, N + 1> magnitudes() const {
    std::array<double, N + 1> r;
    for (int k = 0; k <= N; ++k) r[k] = magnitude(c[k]);
    return r;
  }
};

template <int N>
constexpr Majorant<N> sqr(const Majorant<N>& a) {
  Majorant<N> r = a * a;
  r.c[0] = sqr(a.c[0]);
  return r;
}

template <int N>
void sin_cos(const Majorant<N>& a, Majorant<N>& sine, Majorant<N>& cosine) {
  Jet<Interval, N> s, c;
  sin_cos(Jet<Interval, N>::variable(a.c[0]), s, c);
  sine = Majorant<N>::composed(s, a);
  cosine = Majorant<N>::composed(c, a);
}

}  // namespace lekalo::geometry
