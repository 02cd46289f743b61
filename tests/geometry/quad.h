// Quad: __float128 (113 bits) as a number class, so that formulas written over a number type, and jets, can be
// evaluated to 34 digits as references for double. Linked with libquadmath by the tests only.
#pragma once

#include <quadmath.h>

#include <type_traits>

namespace lekalo {

struct Quad {
  __float128 v = 0;

  Quad() = default;
  Quad(__float128 v) : v(v) {}
  template <class A>
  requires std::is_arithmetic_v<A> Quad(A v) : v(v) {}
  explicit operator double() const { return static_cast<double>(v); }
  explicit operator int() const { return static_cast<int>(v); }

  friend Quad operator-(Quad a) { return -a.v; }
  friend Quad operator+(Quad a, Quad b) { return a.v + b.v; }
  friend Quad operator-(Quad a, Quad b) { return a.v - b.v; }
  friend Quad operator*(Quad a, Quad b) { return a.v * b.v; }
  friend Quad operator/(Quad a, Quad b) { return a.v / b.v; }
  Quad& operator+=(Quad b) { return *this = *this + b; }
  Quad& operator-=(Quad b) { return *this = *this - b; }
  Quad& operator*=(Quad b) { return *this = *this * b; }
  Quad& operator/=(Quad b) { return *this = *this / b; }
  friend bool operator==(Quad a, Quad b) { return a.v == b.v; }
  friend bool operator<(Quad a, Quad b) { return a.v < b.v; }
  friend bool operator>(Quad a, Quad b) { return a.v > b.v; }
  friend bool operator<=(Quad a, Quad b) { return a.v <= b.v; }
  friend bool operator>=(Quad a, Quad b) { return a.v >= b.v; }

  friend Quad abs(Quad x) { return fabsq(x.v); }
  friend Quad floor(Quad x) { return floorq(x.v); }
  friend Quad ceil(Quad x) { return ceilq(x.v); }
  friend Quad round(Quad x) { return roundq(x.v); }
  friend Quad min(Quad a, Quad b) { return b < a ? b : a; }
  friend Quad max(Quad a, Quad b) { return a < b ? b : a; }
  friend Quad sqrt(Quad x) { return sqrtq(x.v); }
  friend Quad cbrt(Quad x) { return cbrtq(x.v); }
  friend Quad exp(Quad x) { return expq(x.v); }
  friend Quad log(Quad x) { return logq(x.v); }
  friend Quad log10(Quad x) { return log10q(x.v); }
  friend Quad sin(Quad x) { return sinq(x.v); }
  friend Quad cos(Quad x) { return cosq(x.v); }
  friend Quad tan(Quad x) { return tanq(x.v); }
  friend Quad asin(Quad x) { return asinq(x.v); }
  friend Quad acos(Quad x) { return acosq(x.v); }
  friend Quad atan(Quad x) { return atanq(x.v); }
  friend Quad sinh(Quad x) { return sinhq(x.v); }
  friend Quad cosh(Quad x) { return coshq(x.v); }
  friend Quad tanh(Quad x) { return tanhq(x.v); }
  friend Quad asinh(Quad x) { return asinhq(x.v); }
  friend Quad acosh(Quad x) { return acoshq(x.v); }
  friend Quad atanh(Quad x) { return atanhq(x.v); }
  friend Quad atan2(Quad y, Quad x) { return atan2q(y.v, x.v); }
  friend Quad hypot(Quad x, Quad y) { return hypotq(x.v, y.v); }
  friend Quad pow(Quad x, Quad y) { return powq(x.v, y.v); }
};

}  // namespace lekalo
