// Jet: a Taylor polynomial in one variable, truncated after degree N, with the arithmetic of power series: a formula
// evaluated on jets yields its derivatives of all orders up to N exactly (up to rounding), never by differences.
//
//   c[k] = f^(k)(t0) / k!,   (a b)_k = sum a_i b_(k-i),   f = F(a):  f' = F'(a) a'  gives each c[k] from the earlier
//   ones
//
// Source: Griewank, Walther 2008, 13.2 (Taylor coefficient propagation); Knuth TAOCP 2, 4.7.
//
// S is double, long double, Interval, or any number class whose functions are found by argument-dependent lookup. Over
// Interval the coefficients are certified enclosures of f^(k)/k! on the whole argument. The functions abs, min, max,
// floor, ceil, round and sign act piecewise, by the value. Where the value is singular (sqrt at 0, 0/0) derivatives are
// infinite or NaN; roots and powers of zero have those that exist (|x|^1.5 the first, sqrt(x^4) all).
#pragma once

#include <limits>

#include "geometry/numerics/jet_operations.h"

namespace lekalo::geometry {

template <class S, int N>
struct Jet : JetOperations<Jet<S, N>, S, N + 1> {
  using Base = JetOperations<Jet<S, N>, S, N + 1>;
  using Base::c;
  static constexpr int kOrder = N;
  static constexpr int kFirst = 1;

  constexpr Jet() = default;
  template <JetScalar<S> A>
  constexpr Jet(const A& constant) {  // implicit: numbers mix freely with jets in formulas
    c[0] = S(constant);
  }

  // The identity t at t = value: derivative 1.
  static constexpr Jet variable(const S& value) {
    Jet r;
    r.c[0] = value;
    if constexpr (N >= 1) r.c[1] = S(1);
    return r;
  }

  // k-th derivative, 0 <= k <= N.
  constexpr S derivative(int k) const {
    double factorial = 1;
    for (int i = 2; i <= k; ++i) factorial *= i;
    return c[k] * S(factorial);
  }

  static constexpr Jet product(const Jet& a, const Jet& b) {
    Jet r;
    for (int k = 0; k <= N; ++k) {
      S sum = a.c[0] * b.c[k];
      for (int i = 1; i <= k; ++i) sum += a.c[i] * b.c[k - i];
      r.c[k] = sum;
    }
    return r;
  }
  static constexpr Jet quotient(const Jet& a, const Jet& b) {
    Jet r;
    for (int k = 0; k <= N; ++k) {
      S sum = a.c[k];
      for (int i = 0; i < k; ++i) sum -= r.c[i] * b.c[k - i];
      r.c[k] = sum / b.c[0];
    }
    return r;
  }
  // The jet f with f(t0) = value and f' = g a'.
  static constexpr Jet integral(const S& value, const Jet& g, const Jet& a) {
    Jet r;
    r.c[0] = value;
    for (int k = 1; k <= N; ++k) r.c[k] = chain_coefficient(g, a, k);
    return r;
  }
  // Coefficient k of that integral; needs g only up to k - 1.
  static constexpr S chain_coefficient(const Jet& g, const Jet& a, int k) {
    S sum = S(k) * a.c[k] * g.c[0];
    for (int i = 1; i < k; ++i) sum += S(i) * a.c[i] * g.c[k - i];
    return sum / S(k);
  }

  // The function with the Taylor coefficients `series` about a's value, of a.
  static constexpr Jet composed(const Jet& series, const Jet& a) {
    Jet r(series.c[N]);
    for (int n = N - 1; n >= 0; --n) {
      Jet next(series.c[n]);
      for (int k = 1; k <= N - n; ++k)
        for (int i = 1; i <= k; ++i) next.c[k] += a.c[i] * r.c[k - i];
      r = next;
    }
    return r;
  }
  // root(a) = a^p, p > 0, where the value of a is zero and a is not: with a = t^m b it is t^(m p) root(b), on the side
  // t > 0 as abs. The orders below m p are zero; if m p is no whole number those above are infinite.
  template <class Root>
  static Jet root_at_zero(const Jet& a, double p, Root root) {
    int m = 1;
    while (a.c[m] == S(0)) ++m;
    Jet b;
    for (int k = m; k <= N; ++k) b.c[k - m] = a.c[k];
    const Jet factor = root(b);
    const double first = m * p;
    const bool is_whole = first == std::floor(first);
    Jet r;
    for (int k = 0; k <= N; ++k) {
      if (k < first) continue;
      const int beyond = k - static_cast<int>(first);
      if (!is_whole)  // as (m p) (m p - 1) ... (m p - k + 1) / 0
        r.c[k] = (beyond % 2 == 1 ? factor.c[0] : -factor.c[0]) * S(std::numeric_limits<double>::infinity());
      else  // as far as a tells
        r.c[k] = beyond <= N - m ? factor.c[beyond] : S(std::numeric_limits<double>::quiet_NaN());
    }
    return r;
  }

  friend Jet atan2(const Jet& y, const Jet& x) {
    using std::atan2;
    const S angle = atan2(y.value(), x.value());
    if (y.is_constant() && x.is_constant()) return Jet(angle);
    // Interaction from the direction of the value, the angle turns by the arctangent of a quotient that starts at zero.
    Jet across = x.value() * y - y.value() * x;
    across.c[0] = S(0);
    Jet r = atan(across / (x.value() * x + y.value() * y));
    r.c[0] = angle;
    return r;
  }
  friend Jet hypot(const Jet& x, const Jet& y) {
    using std::hypot;
    Jet r = sqrt(sqr(x) + sqr(y));
    r.c[0] = hypot(x.value(), y.value());
    return r;
  }
  // A constant exponent is the ordinary power (a negative base is fine with an integer); else exp(exponent log(base)).
  friend Jet pow(const Jet& base, const Jet& exponent) {
    if constexpr (std::is_same_v<S, Interval>) {
      if (exponent.is_constant() && exponent.value().lo == exponent.value().hi) return pow(base, exponent.value().lo);
    } else {
      if (exponent.is_constant()) return power(base, exponent.value());
    }
    return exp(exponent * log(base));
  }
  template <class A>
  requires std::is_arithmetic_v<A>
  friend Jet pow(const Jet& base, A exponent) { return power(base, exponent); }

 private:
  // Small integer exponents by repeated squaring, exact about zero; others by the recurrence of a f' = p f a', and over
  // intervals, where that would divide by all that a may be, from the derivatives of the power.
  template <class A>
  static Jet power(const Jet& a, const A& exponent) {
    using std::floor;
    using std::pow;
    if (exponent == floor(exponent) && exponent <= A(64) && exponent >= A(-64)) {
      const bool negative = exponent < A(0);
      Jet r(1), square = a;
      for (int rest = static_cast<int>(negative ? -exponent : exponent); rest > 0; rest >>= 1) {
        if (rest & 1) r = r * square;
        if (rest > 1) square = sqr(square);
      }
      return negative ? S(1) / r : r;
    }
    Jet r(S(pow(a.c[0], exponent)));
    if (a.is_constant()) return r;
    const S p(exponent);
    if constexpr (std::is_same_v<S, Interval>) {
      S choose(1);
      for (int k = 1; k <= N; ++k) {
        choose = choose * (p - S(k - 1)) / S(k);
        r.c[k] = choose * pow(a.c[0], exponent - k);
      }
      return composed(r, a);
    } else if (a.c[0] == S(0) && exponent > A(0)) {
      return root_at_zero(a, static_cast<double>(exponent), [&](const Jet& b) { return power(b, exponent); });
    }
    for (int k = 1; k <= N; ++k) {
      S sum(0);
      for (int i = 1; i <= k; ++i) sum += (p * S(i) - S(k - i)) * a.c[i] * r.c[k - i];
      r.c[k] = sum / (S(k) * a.c[0]);
    }
    return r;
  }
};

template <class S, int N>
constexpr Jet<S, N> sqr(const Jet<S, N>& a) {
  Jet<S, N> r;
  for (int k = 0; k <= N; ++k) {
    S sum(0);
    for (int i = 0; 2 * i < k; ++i) sum += a.c[i] * a.c[k - i];
    sum = S(2) * sum;
    r.c[k] = k % 2 == 0 ? sum + sqr(a.c[k / 2]) : sum;
  }
  return r;
}

template <class S, int N>
Jet<S, N> sqrt(const Jet<S, N>& a) {
  using std::sqrt;
  Jet<S, N> r(S(sqrt(a.c[0])));
  if (a.is_constant()) return r;
  if constexpr (!std::is_same_v<S, Interval>) {
    if (a.c[0] == S(0)) return Jet<S, N>::root_at_zero(a, 0.5, [](const Jet<S, N>& b) { return sqrt(b); });
  }
  for (int k = 1; k <= N; ++k) {
    S sum = a.c[k];
    for (int i = 1; i < k; ++i) sum -= r.c[i] * r.c[k - i];
    r.c[k] = sum / (S(2) * r.c[0]);
  }
  return r;
}

// From 3 a f' = f a'; over intervals as powers of the root.
template <class S, int N>
Jet<S, N> cbrt(const Jet<S, N>& a) {
  using std::cbrt;
  Jet<S, N> r(S(cbrt(a.c[0])));
  if (a.is_constant()) return r;
  if constexpr (std::is_same_v<S, Interval>) {
    S choose(1);
    for (int k = 1; k <= N; ++k) {
      choose = choose * S(4 - 3 * k) / S(3 * k);
      r.c[k] = choose * pow(r.c[0], 1 - 3 * k);
    }
    return Jet<S, N>::composed(r, a);
  } else if (a.c[0] == S(0)) {
    return Jet<S, N>::root_at_zero(a, 1.0 / 3, [](const Jet<S, N>& b) { return cbrt(b); });
  }
  for (int k = 1; k <= N; ++k) {
    S sum(0);
    for (int i = 1; i <= k; ++i) sum += S(4 * i - 3 * k) * a.c[i] * r.c[k - i];
    r.c[k] = sum / (S(3 * k) * a.c[0]);
  }
  return r;
}

template <class S, int N>
Jet<S, N> exp(const Jet<S, N>& a) {
  using std::exp;
  Jet<S, N> r(S(exp(a.c[0])));
  for (int k = 1; k <= N; ++k) r.c[k] = Jet<S, N>::chain_coefficient(r, a, k);
  return r;
}

template <class S, int N>
Jet<S, N> log(const Jet<S, N>& a) {
  using std::log;
  const S value = log(a.c[0]);
  if (a.is_constant()) return value;
  return Jet<S, N>::integral(value, S(1) / a, a);
}

template <class S, int N>
Jet<S, N> log10(const Jet<S, N>& a) {
  using std::log;
  using std::log10;
  const S value = log10(a.c[0]);
  if (a.is_constant()) return value;
  return Jet<S, N>::integral(value, S(1) / (S(log(S(10))) * a), a);
}

// Sine and cosine together: each needs the other.
template <class S, int N>
void sin_cos(const Jet<S, N>& a, Jet<S, N>& sine, Jet<S, N>& cosine) {
  using std::cos;
  using std::sin;
  sine = Jet<S, N>(S(sin(a.c[0])));
  cosine = Jet<S, N>(S(cos(a.c[0])));
  for (int k = 1; k <= N; ++k) {
    sine.c[k] = Jet<S, N>::chain_coefficient(cosine, a, k);
    cosine.c[k] = -Jet<S, N>::chain_coefficient(sine, a, k);
  }
}

template <class S, int N>
void sinh_cosh(const Jet<S, N>& a, Jet<S, N>& sine, Jet<S, N>& cosine) {
  using std::cosh;
  using std::sinh;
  sine = Jet<S, N>(S(sinh(a.c[0])));
  cosine = Jet<S, N>(S(cosh(a.c[0])));
  for (int k = 1; k <= N; ++k) {
    sine.c[k] = Jet<S, N>::chain_coefficient(cosine, a, k);
    cosine.c[k] = Jet<S, N>::chain_coefficient(sine, a, k);
  }
}

template <class S, int N>
Jet<S, N> sin(const Jet<S, N>& a) {
  Jet<S, N> s, c;
  sin_cos(a, s, c);
  return s;
}

template <class S, int N>
Jet<S, N> cos(const Jet<S, N>& a) {
  Jet<S, N> s, c;
  sin_cos(a, s, c);
  return c;
}

template <class S, int N>
Jet<S, N> sinh(const Jet<S, N>& a) {
  Jet<S, N> s, c;
  sinh_cosh(a, s, c);
  return s;
}

template <class S, int N>
Jet<S, N> cosh(const Jet<S, N>& a) {
  Jet<S, N> s, c;
  sinh_cosh(a, s, c);
  return c;
}

// tan' = 1 + tan^2, tanh' = 1 - tanh^2: the square grows with the series.
template <class S, int N>
Jet<S, N> tangent_series(const S& value, const Jet<S, N>& a, double curvature_sign) {
  Jet<S, N> r(value), g(S(1) + S(curvature_sign) * sqr(value));
  for (int k = 1; k <= N; ++k) {
    r.c[k] = Jet<S, N>::chain_coefficient(g, a, k);
    S square(0);
    for (int i = 0; i <= k; ++i) square += r.c[i] * r.c[k - i];
    g.c[k] = S(curvature_sign) * square;
  }
  return r;
}

template <class S, int N>
Jet<S, N> tan(const Jet<S, N>& a) {
  using std::tan;
  return tangent_series(S(tan(a.c[0])), a, 1);
}

template <class S, int N>
Jet<S, N> tanh(const Jet<S, N>& a) {
  using std::tanh;
  return tangent_series(S(tanh(a.c[0])), a, -1);
}

// 1 - a^2 as a product: over intervals and near 1 it loses less than the difference.
template <class S, int N>
Jet<S, N> asin(const Jet<S, N>& a) {
  using std::asin;
  const S value = asin(a.c[0]);
  if (a.is_constant()) return value;
  return Jet<S, N>::integral(value, S(1) / sqrt((S(1) - a) * (S(1) + a)), a);
}

template <class S, int N>
Jet<S, N> acos(const Jet<S, N>& a) {
  using std::acos;
  const S value = acos(a.c[0]);
  if (a.is_constant()) return value;
  return Jet<S, N>::integral(value, S(-1) / sqrt((S(1) - a) * (S(1) + a)), a);
}

template <class S, int N>
Jet<S, N> atan(const Jet<S, N>& a) {
  using std::atan;
  return Jet<S, N>::integral(S(atan(a.c[0])), S(1) / (S(1) + sqr(a)), a);
}

template <class S, int N>
Jet<S, N> asinh(const Jet<S, N>& a) {
  using std::asinh;
  return Jet<S, N>::integral(S(asinh(a.c[0])), S(1) / sqrt(S(1) + sqr(a)), a);
}

template <class S, int N>
Jet<S, N> acosh(const Jet<S, N>& a) {
  using std::acosh;
  const S value = acosh(a.c[0]);
  if (a.is_constant()) return value;
  return Jet<S, N>::integral(value, S(1) / sqrt((a - S(1)) * (a + S(1))), a);
}

template <class S, int N>
Jet<S, N> atanh(const Jet<S, N>& a) {
  using std::atanh;
  const S value = atanh(a.c[0]);
  if (a.is_constant()) return value;
  return Jet<S, N>::integral(value, S(1) / ((S(1) - a) * (S(1) + a)), a);
}

}  // namespace lekalo::geometry

#include "geometry/numerics/jet2.h"  // IWYU pragma: export
