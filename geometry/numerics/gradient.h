// Gradient: a value and its three partial derivatives, the first-order jet of a function of x, y, z. Everything said in
// jet.h holds here; an elementary function f of it is f(a) + f'(a) (a - a0).
#pragma once

#include "geometry/numerics/jet.h"

namespace lekalo::geometry {

template <class S>
struct Gradient : JetOperations<Gradient<S>, S, 4> {
  using Base = JetOperations<Gradient<S>, S, 4>;
  using Base::c;  // value, d/dx, d/dy, d/dz

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

  friend Gradient atan2(const Gradient& y, const Gradient& x) {  // as for Jet
    using std::atan2;
    const S angle = atan2(y.value(), x.value());
    if (y.is_constant() && x.is_constant()) return Gradient(angle);
    Gradient across = x.value() * y - y.value() * x;
    across.c[0] = S(0);
    Gradient r = across / (x.value() * x + y.value() * y);
    r.c[0] = angle;
    return r;
  }
  friend Gradient hypot(const Gradient& x, const Gradient& y) {
    using std::hypot;
    Gradient r = sqrt(sqr(x) + sqr(y));
    r.c[0] = hypot(x.value(), y.value());
    return r;
  }
  friend Gradient pow(const Gradient& base, const Gradient& exponent) {
    if (!exponent.is_constant()) return exp(exponent * log(base));
    const Jet<S, 1> constant(exponent.value());
    return apply([&](const Jet<S, 1>& x) { return pow(x, constant); }, base);
  }
  template <class A>
  requires std::is_arithmetic_v<A>
  friend Gradient pow(const Gradient& base, A exponent) {
    return apply([&](const Jet<S, 1>& x) { return pow(x, exponent); }, base);
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

#define LEKALO_COMPOSED_FUNCTION(function)                                        \
  template <class S>                                                              \
  Gradient<S> function(const Gradient<S>& a) {                                    \
    return Gradient<S>::apply([](const Jet<S, 1>& x) { return function(x); }, a); \
  }

LEKALO_FOR_COMPOSED_FUNCTIONS(LEKALO_COMPOSED_FUNCTION)

#undef LEKALO_COMPOSED_FUNCTION

}  // namespace lekalo::geometry
