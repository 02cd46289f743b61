// Gradient: a value and its three partial derivatives, the first-order jet of a function of x, y, z. Everything said in
// jet.h holds here; an elementary function f of it is f(a) + f'(a) (a - a0).
#pragma once

#include "geometry/numerics/composed_jet.h"
#include "geometry/numerics/jet.h"

namespace lekalo::geometry {

template <class S>
struct Gradient : JetOperations<Gradient<S>, S, 4>, ComposedJet<Gradient<S>, S, 1> {
  using Base = JetOperations<Gradient<S>, S, 4>;
  using Base::c;  // value, d/dx, d/dy, d/dz
  static constexpr int kFirst = 3;

  constexpr Gradient() = default;
  template <JetScalar<S> A>
  constexpr Gradient(const A& constant) {  // implicit: numbers mix freely with jets in formulas
    c[0] = S(constant);
  }
  // The coordinate `axis` (0, 1, 2) where it has the value.
  static constexpr Gradient variable(const S& value, int axis) {
    Gradient r(value);
    r.c[1 + axis] = S(1);
    return r;
  }

  static constexpr int degree(int k) { return k > 0 ? 1 : 0; }

  static constexpr Gradient product(const Gradient& a, const Gradient& b) {
    Gradient r(a.c[0] * b.c[0]);
    for (int k = 1; k < 4; ++k) r.c[k] = a.c[0] * b.c[k] + a.c[k] * b.c[0];
    return r;
  }
  static constexpr Gradient quotient(const Gradient& a, const Gradient& b) {
    Gradient r(a.c[0] / b.c[0]);
    for (int k = 1; k < 4; ++k) r.c[k] = (a.c[k] - r.c[0] * b.c[k]) / b.c[0];
    return r;
  }

  // The function with that value and derivative at a.value(), of a.
  static constexpr Gradient chained(const Jet<S, 1>& function, const Gradient& a) {
    Gradient r(function.c[0]);
    for (int k = 1; k < 4; ++k) r.c[k] = a.c[k] == S(0) ? S(0) : function.c[1] * a.c[k];
    return r;
  }
  // f of a jet, where f takes jets in one variable.
  template <class F>
  static Gradient apply(F f, const Gradient& a) {
    return a.is_constant() ? Gradient(f(Jet<S, 1>(a.c[0])).c[0]) : chained(f(Jet<S, 1>::variable(a.c[0])), a);
  }
};

template <class S>
constexpr Gradient<S> sqr(const Gradient<S>& a) {
  Gradient<S> r(sqr(a.c[0]));
  for (int k = 1; k < 4; ++k) r.c[k] = S(2) * a.c[0] * a.c[k];
  return r;
}

template <class S>
void sin_cos(const Gradient<S>& a, Gradient<S>& sine, Gradient<S>& cosine) {
  using std::cos;
  using std::sin;
  const S s = sin(a.c[0]), c = cos(a.c[0]);
  const auto pair = [](const S& value, const S& slope) {
    Jet<S, 1> r(value);
    r.c[1] = slope;
    return r;
  };
  sine = Gradient<S>::chained(pair(s, c), a);
  cosine = Gradient<S>::chained(pair(c, -s), a);
}

}  // namespace lekalo::geometry
