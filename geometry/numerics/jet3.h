// Jet3: a Taylor polynomial in three variables, truncated after total degree N; the partial derivatives of a formula of
// x, y, z. Coefficients stand by degree, then by falling powers of x, then of y: 1, x, y, z, x^2, xy, xz, y^2, yz, z^2,
// ... Everything said in jet.h and jet2.h holds here.
//
//   coefficient(i, j, k) = d^(i+j+k) f / dx^i dy^j dz^k / (i! j! k!),   i + j + k <= N
#pragma once

#include <array>
#include <cstdint>

#include "geometry/numerics/composed_jet.h"
#include "geometry/numerics/jet.h"

namespace lekalo::geometry {

namespace detail {

constexpr int jet3_index(int i, int j, int k) {
  const int n = i + j + k, rest = j + k;
  return n * (n + 1) * (n + 2) / 6 + rest * (rest + 1) / 2 + k;
}

// All pairs of coefficients whose product belongs to a coefficient of a product, in the order of the latter.
struct Jet3Term {
  std::uint8_t to, a, b;
};
template <int N>
constexpr auto kJet3Terms = [] {
  std::array<Jet3Term, (N + 1) * (N + 2) * (N + 3) * (N + 4) * (N + 5) * (N + 6) / 720> terms{};
  int count = 0;
  for (int n = 0; n <= N; ++n)
    for (int i = n; i >= 0; --i)
      for (int j = n - i; j >= 0; --j)
        for (int p = 0; p <= i; ++p)
          for (int q = 0; q <= j; ++q)
            for (int s = 0, k = n - i - j; s <= k; ++s)
              terms[count++] = {static_cast<std::uint8_t>(jet3_index(i, j, k)),
                                static_cast<std::uint8_t>(jet3_index(p, q, s)),
                                static_cast<std::uint8_t>(jet3_index(i - p, j - q, k - s))};
  return terms;
}();

}  // namespace detail

template <class S, int N>
struct Jet3 : JetOperations<Jet3<S, N>, S, (N + 1) * (N + 2) * (N + 3) / 6>, ComposedJet<Jet3<S, N>, S, N> {
  using Base = JetOperations<Jet3<S, N>, S, (N + 1) * (N + 2) * (N + 3) / 6>;
  using Base::c;
  using Base::kCount;
  static constexpr int kOrder = N;
  static constexpr int kFirst = 3;

  constexpr Jet3() = default;
  template <JetScalar<S> A>
  constexpr Jet3(const A& constant) {  // implicit: numbers mix freely with jets in formulas
    c[0] = S(constant);
  }
  // The coordinate `axis` (0, 1, 2) where it has the value.
  static constexpr Jet3 variable(const S& value, int axis) {
    Jet3 r(value);
    r.c[1 + axis] = S(1);
    return r;
  }

  static constexpr int index(int i, int j, int k) { return detail::jet3_index(i, j, k); }
  static constexpr int degree(int k) {
    int n = 0;
    while (index(0, 0, n) < k) ++n;
    return n;
  }

  static constexpr Jet3 product(const Jet3& a, const Jet3& b) {
    Jet3 r;
    for (const auto& term : detail::kJet3Terms<N>) r.c[term.to] += a.c[term.a] * b.c[term.b];
    return r;
  }
  static constexpr Jet3 quotient(const Jet3& a, const Jet3& b) {
    // Degree by degree, as the terms stand: all others that make a coefficient are known when its own turn comes.
    Jet3 r = a;
    int done = -1;
    for (const auto& term : detail::kJet3Terms<N>) {
      for (; done < term.to; ++done)
        if (done >= 0) r.c[done] = r.c[done] / b.c[0];
      if (term.a != 0) r.c[term.to] -= b.c[term.a] * r.c[term.b];
    }
    r.c[done] = r.c[done] / b.c[0];
    return r;
  }

  // The function with the Taylor coefficients `series` about a.value(), of a.
  static constexpr Jet3 compose(const Jet<S, N>& series, const Jet3& a) {
    Jet3 off = a, r(series.c[N]);
    off.c[0] = S(0);
    for (int k = N - 1; k >= 0; --k) {
      r = product(off, r);
      r.c[0] = series.c[k];
    }
    return r;
  }

  // A jet as the argument of a function of one variable. Most arguments depend on one coordinate alone (sin x): these
  // need no composition.
  struct Argument {
    Jet<S, N> along;  // the argument itself, or a variable at its value
    int axis = -1;    // of that coordinate; -1: there are several
  };
  static Argument argument(const Jet3& a) {
    Argument r;
    for (int axis = 0; axis < 3; ++axis) {
      Jet3 others = a;
      for (int n = 0; n <= N; ++n) {
        r.along.c[n] = a.c[power(axis, n)];
        others.c[power(axis, n)] = S(0);
      }
      if (!others.is_constant()) continue;
      r.axis = axis;
      return r;
    }
    r.along = Jet<S, N>::variable(a.value());
    return r;
  }
  // The function's jet of the argument, as one in three variables.
  static Jet3 applied(const Jet<S, N>& function, const Argument& argument, const Jet3& a) {
    if (argument.axis < 0) return compose(function, a);
    Jet3 r;
    for (int n = 0; n <= N; ++n) r.c[power(argument.axis, n)] = function.c[n];
    return r;
  }
  // f of a jet, where f takes jets in one variable.
  template <class F>
  static Jet3 apply(F f, const Jet3& a) {
    const Argument of = argument(a);
    return applied(f(of.along), of, a);
  }

 private:
  static constexpr int power(int axis, int n) {
    return axis == 0 ? index(n, 0, 0) : axis == 1 ? index(0, n, 0) : index(0, 0, n);
  }
};

template <class S, int N>
constexpr Jet3<S, N> sqr(const Jet3<S, N>& a) {
  return a * a;
}

template <class S, int N>
void sin_cos(const Jet3<S, N>& a, Jet3<S, N>& sine, Jet3<S, N>& cosine) {
  const auto of = Jet3<S, N>::argument(a);
  Jet<S, N> s, c;
  sin_cos(of.along, s, c);
  sine = Jet3<S, N>::applied(s, of, a);
  cosine = Jet3<S, N>::applied(c, of, a);
}

}  // namespace lekalo::geometry
