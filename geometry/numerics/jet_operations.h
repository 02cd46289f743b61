// What truncated Taylor polynomials in one and in two variables share: everything that acts coefficient by coefficient,
// and the functions that choose a branch by the value (abs, min, max, floor). Included by jet.h and jet2.h.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <type_traits>

#include "geometry/numerics/interval.h"

namespace lekalo::geometry {

// A number that multiplies a jet over S coefficient by coefficient.
template <class A, class S>
concept JetScalar = std::is_arithmetic_v<A> || std::same_as<A, S>;

// J is the jet (Jet<S, N>, Jet2<S, N>), Count its number of coefficients; J supplies product(a, b), quotient(a, b), and
// kFirst: c[1] to c[kFirst] are the first derivatives, by one variable each.
template <class J, class S, int Count>
struct JetOperations {
  using Scalar = S;
  static constexpr int kCount = Count;

  std::array<S, Count> c{};  // Taylor coefficients; c[0] is the value

  constexpr const S& value() const { return c[0]; }
  // All derivatives are zero: functions that are singular at the value (sqrt at 0) are then still plain numbers.
  constexpr bool is_constant() const {
    for (int k = 1; k < Count; ++k) {
      if (!(c[k] == S(0))) return false;
    }
    return true;
  }

  friend constexpr J operator+(const J& a) { return a; }
  friend constexpr J operator-(const J& a) {
    J r;
    for (int k = 0; k < Count; ++k) r.c[k] = -a.c[k];
    return r;
  }
  friend constexpr J operator+(const J& a, const J& b) {
    J r;
    for (int k = 0; k < Count; ++k) r.c[k] = a.c[k] + b.c[k];
    return r;
  }
  friend constexpr J operator-(const J& a, const J& b) {
    J r;
    for (int k = 0; k < Count; ++k) r.c[k] = a.c[k] - b.c[k];
    return r;
  }
  friend constexpr J operator*(const J& a, const J& b) { return J::product(a, b); }
  friend constexpr J operator/(const J& a, const J& b) { return J::quotient(a, b); }

  template <JetScalar<S> A>
  friend constexpr J operator+(const J& a, const A& s) {
    J r = a;
    r.c[0] = r.c[0] + S(s);
    return r;
  }
  template <JetScalar<S> A>
  friend constexpr J operator+(const A& s, const J& a) {
    return a + s;
  }
  template <JetScalar<S> A>
  friend constexpr J operator-(const J& a, const A& s) {
    J r = a;
    r.c[0] = r.c[0] - S(s);
    return r;
  }
  template <JetScalar<S> A>
  friend constexpr J operator-(const A& s, const J& a) {
    return -a + s;
  }
  template <JetScalar<S> A>
  friend constexpr J operator*(const J& a, const A& s) {
    J r;
    for (int k = 0; k < Count; ++k) r.c[k] = a.c[k] * S(s);
    return r;
  }
  template <JetScalar<S> A>
  friend constexpr J operator*(const A& s, const J& a) {
    return a * s;
  }
  template <JetScalar<S> A>
  friend constexpr J operator/(const J& a, const A& s) {
    J r;
    for (int k = 0; k < Count; ++k) r.c[k] = a.c[k] / S(s);
    return r;
  }
  template <JetScalar<S> A>
  friend constexpr J operator/(const A& s, const J& a) {
    return J(s) / a;
  }
  template <class A>
  constexpr J& operator+=(const A& b) {
    return self() = self() + b;
  }
  template <class A>
  constexpr J& operator-=(const A& b) {
    return self() = self() - b;
  }
  template <class A>
  constexpr J& operator*=(const A& b) {
    return self() = self() * b;
  }
  template <class A>
  constexpr J& operator/=(const A& b) {
    return self() = self() / b;
  }

  // The branch functions. Where an Interval value does not decide, every coefficient becomes the hull of both branches.
  // At 0 abs takes the branch +x; where a = b, min takes b and max takes a.
  friend constexpr J abs(const J& a) {
    const Truth negative = less(a.c[0], S(0));
    if (negative == Truth::no) return a;
    if (negative == Truth::yes) return -a;
    using std::abs;
    return either(a, -a, abs(a.c[0]));
  }
  friend constexpr J min(const J& a, const J& b) {
    const Truth a_less = less(a.c[0], b.c[0]);
    if (a_less != Truth::unknown) return a_less == Truth::yes ? a : b;
    using std::min;
    return either(a, b, min(a.c[0], b.c[0]));
  }
  friend constexpr J max(const J& a, const J& b) {
    const Truth a_less = less(a.c[0], b.c[0]);
    if (a_less != Truth::unknown) return a_less == Truth::yes ? b : a;
    using std::max;
    return either(a, b, max(a.c[0], b.c[0]));
  }
  // Step functions: their derivatives are zero, also at a step; over an interval with a step there are no bounds for
  // how fast they rise.
  friend constexpr J floor(const J& a) {
    using std::floor;
    return steps(S(floor(a.c[0])), a);
  }
  friend constexpr J ceil(const J& a) {
    using std::ceil;
    return steps(S(ceil(a.c[0])), a);
  }
  friend constexpr J round(const J& a) {
    using std::round;
    return steps(S(round(a.c[0])), a);
  }
  friend constexpr J sign(const J& a) {
    using ::lekalo::geometry::sign;  // argument-dependent lookup adds the scalar's own
    return steps(S(sign(a.c[0])), a);
  }

 private:
  constexpr J& self() { return static_cast<J&>(*this); }
  static constexpr J either(const J& a, const J& b, const S& value) {
    J r = a;
    if constexpr (std::is_same_v<S, Interval>) {
      for (int k = 1; k < Count; ++k) r.c[k] = hull(a.c[k], b.c[k]);
    } else {
      (void)b;
    }
    r.c[0] = value;
    return r;
  }
  static constexpr J steps(const S& value, const J& a) {
    J r(value);
    if constexpr (std::is_same_v<S, Interval>)
      if (value.lo != value.hi)
        for (int k = 1; k < Count; ++k)
          if (k > J::kFirst || !(a.c[k] == S(0))) r.c[k] = Interval::entire();
    return r;
  }
};

}  // namespace lekalo::geometry
