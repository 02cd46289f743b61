// Jet2: a Taylor polynomial in two variables, truncated after total degree N; the partial derivatives of a surface's
// formula. Coefficients stand by degree, then by the power of v: 1, u, v, u^2, uv, v^2, ...
//
//   coefficient(i, j) = d^(i+j) f / du^i dv^j / (i! j!),   i + j <= N
//
// An elementary function F of a jet a is composed: F(a) = sum F^(k)(a00)/k! (a - a00)^k, exact since a - a00 has no
// constant term; the series of F comes from Jet<S, N> (Griewank, Walther 2008, 13.3). Everything said in jet.h holds
// here.
#pragma once

#include "geometry/numerics/composed_jet.h"
#include "geometry/numerics/jet.h"

namespace lekalo::geometry {

template <class S, int N>
struct Jet2 : JetOperations<Jet2<S, N>, S, (N + 1) * (N + 2) / 2>, ComposedJet<Jet2<S, N>, S, N> {
  using Base = JetOperations<Jet2<S, N>, S, (N + 1) * (N + 2) / 2>;
  using Base::c;
  static constexpr int kOrder = N;
  static constexpr int kFirst = 2;

  constexpr Jet2() = default;
  template <JetScalar<S> A>
  constexpr Jet2(const A& constant) {  // implicit: numbers mix freely with jets in formulas
    c[0] = S(constant);
  }

  static constexpr Jet2 u_variable(const S& value) { return identity(value, 1, 0); }
  static constexpr Jet2 v_variable(const S& value) { return identity(value, 0, 1); }

  static constexpr int index(int i, int j) { return (i + j) * (i + j + 1) / 2 + j; }
  static constexpr int degree(int k) {
    int n = 0;
    while (index(0, n) < k) ++n;
    return n;
  }

  // The partial derivative i times by u and j times by v, i + j <= N.
  constexpr S derivative(int i, int j) const {
    double factorials = 1;
    for (int k = 2; k <= i; ++k) factorials *= k;
    for (int k = 2; k <= j; ++k) factorials *= k;
    return c[index(i, j)] * S(factorials);
  }

  static constexpr Jet2 product(const Jet2& a, const Jet2& b) {
    if (a.is_constant()) return b * a.c[0];
    if (b.is_constant()) return a * b.c[0];
    Jet2 r;
    for (int degree = 0; degree <= N; ++degree) {
      for (int j = 0; j <= degree; ++j) r.c[index(degree - j, j)] = convolution(a, b, degree - j, j, 0);
    }
    return r;
  }
  static constexpr Jet2 quotient(const Jet2& a, const Jet2& b) {
    if (b.is_constant()) return a / b.c[0];
    Jet2 r;
    for (int degree = 0; degree <= N; ++degree) {
      for (int j = 0; j <= degree; ++j) {
        const int i = degree - j, at = index(i, j);
        r.c[at] = degree == 0 ? a.c[0] / b.c[0] : (a.c[at] - convolution(b, r, i, j, 1)) / b.c[0];
      }
    }
    return r;
  }

  // The function with the Taylor coefficients `series` about a.value(), of a.
  static constexpr Jet2 compose(const Jet<S, N>& series, const Jet2& a) {
    Jet2 r(series.c[N]);
    if (a.is_constant()) return Jet2(series.c[0]);
    for (int k = N - 1; k >= 0; --k) {
      // Later steps multiply by a - a00 another k times: only the degrees up to N - k can still matter.
      Jet2 next(series.c[k]);
      for (int degree = 1; degree <= N - k; ++degree) {
        for (int j = 0; j <= degree; ++j) next.c[index(degree - j, j)] = convolution(a, r, degree - j, j, 1);
      }
      r = next;
    }
    return r;
  }

  // A jet as the argument of a function of one variable. Most arguments in surfaces depend on u or on v alone (cos u,
  // sin v): these need no composition.
  struct Argument {
    Jet<S, N> along;  // the argument itself, or a variable at its value
    bool only_u = true, only_v = true;
  };
  static Argument argument(const Jet2& a) {
    Argument r;
    Jet<S, N> along_v;
    for (int degree = 0; degree <= N; ++degree) {
      for (int j = 0; j <= degree; ++j) {
        const S& x = a.c[index(degree - j, j)];
        if (j == 0) r.along.c[degree] = x;
        if (j == degree) along_v.c[degree] = x;
        if (x == S(0)) continue;
        if (j > 0) r.only_u = false;
        if (j < degree) r.only_v = false;
      }
    }
    if (!r.only_u) r.along = r.only_v ? along_v : Jet<S, N>::variable(a.value());
    return r;
  }
  // The function's jet of the argument, as one in two variables.
  static Jet2 applied(const Jet<S, N>& function, const Argument& argument, const Jet2& a) {
    if (!argument.only_u && !argument.only_v) return compose(function, a);
    Jet2 r;
    for (int degree = 0; degree <= N; ++degree)
      r.c[argument.only_u ? index(degree, 0) : index(0, degree)] = function.c[degree];
    return r;
  }
  // f of a jet, where f takes jets in one variable.
  template <class F>
  static Jet2 apply(F f, const Jet2& a) {
    const Argument of = argument(a);
    return applied(f(of.along), of, a);
  }

 private:
  static constexpr Jet2 identity(const S& value, int du, int dv) {
    Jet2 r;
    r.c[0] = value;
    if constexpr (N >= 1) {
      r.c[1] = S(du);
      r.c[2] = S(dv);
    }
    return r;
  }
  // Coefficient (i, j) of a b, where the terms of a below degree `first` (0 or 1) are taken as zero.
  static constexpr S convolution(const Jet2& a, const Jet2& b, int i, int j, int first) {
    S sum(0);
    for (int k = 0; k <= i; ++k) {
      for (int l = k == 0 ? first : 0; l <= j; ++l) sum += a.c[index(k, l)] * b.c[index(i - k, j - l)];
    }
    return sum;
  }
};

// Equal factors are squared, not multiplied: tighter over intervals.
template <class S, int N>
constexpr Jet2<S, N> sqr(const Jet2<S, N>& a) {
  using J = Jet2<S, N>;
  J r;
  for (int degree = 0; degree <= N; ++degree) {
    for (int j = 0; j <= degree; ++j) {
      const int i = degree - j;
      S sum(0);
      // Every pair (k, l), (i - k, j - l) of different terms once: those with 2 (k, l) < (i, j) in lexicographic order.
      for (int k = 0; 2 * k <= i; ++k) {
        for (int l = 0; l <= j && (2 * k < i || 2 * l < j); ++l) {
          sum += a.c[J::index(k, l)] * a.c[J::index(i - k, j - l)];
        }
      }
      sum = S(2) * sum;
      r.c[J::index(i, j)] = i % 2 == 0 && j % 2 == 0 ? sum + sqr(a.c[J::index(i / 2, j / 2)]) : sum;
    }
  }
  return r;
}

template <class S, int N>
void sin_cos(const Jet2<S, N>& a, Jet2<S, N>& sine, Jet2<S, N>& cosine) {
  const auto of = Jet2<S, N>::argument(a);
  Jet<S, N> s, c;
  sin_cos(of.along, s, c);
  sine = Jet2<S, N>::applied(s, of, a);
  cosine = Jet2<S, N>::applied(c, of, a);
}

}  // namespace lekalo::geometry
