// What the operations of formulas do to numbers of every kind: doubles, intervals, and jets of either. Where intervals
// leave a condition open the result holds both answers.
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

#include "geometry/expression/operations.h"
#include "geometry/numerics/gradient.h"
#include "geometry/numerics/interval.h"
#include "geometry/numerics/jet.h"
#include "geometry/numerics/sine_cosine.h"
#include "geometry/numerics/special_functions.h"

namespace lekalo::geometry::operations {

template <class T>
struct ScalarOf {
  using Type = T;
};
template <class T>
requires requires { typename T::Scalar; }
struct ScalarOf<T> {
  using Type = typename T::Scalar;
};
template <class T>
using Scalar = typename ScalarOf<T>::Type;
template <class T>
constexpr bool kIsJet = !std::is_same_v<T, Scalar<T>>;

template <class T>
const Scalar<T>& value(const T& x) {
  if constexpr (kIsJet<T>) {
    return x.c[0];
  } else {
    return x;
  }
}

inline Truth opposite(Truth a) { return a == Truth::yes ? Truth::no : a == Truth::no ? Truth::yes : Truth::unknown; }
inline Truth both(Truth a, Truth b) {
  if (a == Truth::no || b == Truth::no) return Truth::no;
  return a == Truth::yes && b == Truth::yes ? Truth::yes : Truth::unknown;
}

inline Truth equal(double a, double b) { return a == b ? Truth::yes : Truth::no; }
inline Truth equal(const Interval& a, const Interval& b) {
  if (a.lo == a.hi && a == b) return Truth::yes;
  return intersects(a, b) ? Truth::unknown : Truth::no;
}
inline Truth at_most(double a, double b) { return a <= b ? Truth::yes : Truth::no; }
inline Truth at_most(const Interval& a, const Interval& b) { return opposite(less(b, a)); }

template <class T>
T number(Truth truth) {
  if constexpr (std::is_same_v<Scalar<T>, Interval>) {
    if (truth == Truth::unknown) return T(Interval(0, 1));
  }
  return T(truth == Truth::yes ? 1.0 : 0.0);
}
template <class T>
Truth truth(const T& x) {
  const Truth zero = equal(value(x), Scalar<T>(0));
  return opposite(zero);
}

template <class T>
T chosen(Truth condition, const T& a, const T& b) {
  if (condition == Truth::yes) return a;
  if (condition == Truth::no) return b;
  if constexpr (std::is_same_v<T, Interval>) {
    return hull(a, b);
  } else if constexpr (std::is_same_v<Scalar<T>, Interval>) {
    T r = a;
    for (int k = 0; k < T::kCount; ++k) r.c[k] = hull(a.c[k], b.c[k]);
    return r;
  } else {
    return b;
  }
}

// A value and first derivatives, whatever the variables: what rays ask for most gets the short rules.
template <class T>
constexpr bool kIsFirstOrder = false;
template <>
constexpr bool kIsFirstOrder<Jet<double, 1>> = true;
template <>
constexpr bool kIsFirstOrder<Jet2<double, 1>> = true;
template <>
constexpr bool kIsFirstOrder<Gradient<double>> = true;

template <class T>
constexpr bool kIsJetInOne = false;
template <int N>
constexpr bool kIsJetInOne<Jet<double, N>> = true;

template <class T>
T product(const T& a, const T& b) {
  if constexpr (kIsFirstOrder<T>) {
    T r;
    r.c[0] = a.c[0] * b.c[0];
    for (int k = 1; k < T::kCount; ++k) r.c[k] = a.c[0] * b.c[k] + a.c[k] * b.c[0];
    return r;
  } else {
    return a * b;
  }
}

template <class T>
T quotient(const T& a, const T& b) {
  if constexpr (kIsFirstOrder<T>) {
    T r;
    r.c[0] = a.c[0] / b.c[0];
    for (int k = 1; k < T::kCount; ++k) r.c[k] = (a.c[k] - r.c[0] * b.c[k]) / b.c[0];
    return r;
  } else {
    return a / b;
  }
}

template <class T>
void sine_and_cosine(const T& a, T& sine, T& cosine) {
  if constexpr (std::is_same_v<T, double>) {
    geometry::sine_and_cosine(a, sine, cosine);
  } else if constexpr (kIsFirstOrder<T>) {
    double s, c;
    geometry::sine_and_cosine(a.c[0], s, c);
    sine.c[0] = s;
    cosine.c[0] = c;
    for (int k = 1; k < T::kCount; ++k) {
      sine.c[k] = c * a.c[k];
      cosine.c[k] = -s * a.c[k];
    }
  } else if constexpr (kIsJetInOne<T>) {
    // Along a line most arguments are straight: each coefficient is made from the one before it alone.
    bool is_straight = true;
    for (int k = 2; k < T::kCount; ++k) is_straight = is_straight && a.c[k] == 0;
    geometry::sine_and_cosine(a.c[0], sine.c[0], cosine.c[0]);
    for (int k = 1; k < T::kCount; ++k) {
      sine.c[k] = is_straight ? a.c[1] * cosine.c[k - 1] / k : T::chain_coefficient(cosine, a, k);
      cosine.c[k] = -(is_straight ? a.c[1] * sine.c[k - 1] / k : T::chain_coefficient(sine, a, k));
    }
  } else if constexpr (kIsJet<T>) {
    sin_cos(a, sine, cosine);
  } else {
    sine = sin(a);
    cosine = cos(a);
  }
}

template <class T>
T integer_power(const T& x, int exponent) {
  // Over intervals powers are tighter than products.
  if constexpr (std::is_same_v<Scalar<T>, double>) {
    if (exponent == 3) return product(x, sqr(x));
    if (exponent == 4) return sqr(sqr(x));
  }
  if constexpr (std::is_same_v<T, double>) {
    double result = 1, square = x;
    for (int rest = std::abs(exponent); rest > 0; rest >>= 1) {
      if (rest & 1) result *= square;
      square *= square;
    }
    return exponent < 0 ? 1 / result : result;
  } else {
    return pow(x, exponent);
  }
}

// a - b floor(a / b): in [0, b), with the sign of b.
inline double remainder(double a, double b) {
  const double r = std::fmod(a, b);
  return r != 0 && (r < 0) != (b < 0) ? r + b : r;
}
inline Interval remainder(const Interval& a, const Interval& b) {
  const Interval r = a - b * floor(a / b), range = hull(0.0, b);
  const Interval common = intersect(r, range);
  return common.empty() ? range : common;
}
template <class J>
requires kIsJet<J> J remainder(const J& a, const J& b) {
  J r = a - b * floor(a / b);
  r.c[0] = remainder(value(a), value(b));
  return r;
}

// The number that a value is, NaN where it is a variable or an interval.
template <class T>
double whole_constant(const T& x) {
  if constexpr (kIsJet<T>) {
    if (!x.is_constant()) return std::numeric_limits<double>::quiet_NaN();
  }
  if constexpr (std::is_same_v<Scalar<T>, Interval>) {
    return value(x).lo == value(x).hi ? value(x).lo : std::numeric_limits<double>::quiet_NaN();
  } else {
    return value(x);
  }
}

// What operations give that need no constant.
template <class T>
T result_of(Operation operation, const T& a, const T& b, const T& c, int exponent) {
  using std::abs, std::acos, std::acosh, std::asin, std::asinh, std::atan, std::atan2, std::atanh, std::cbrt, std::ceil;
  using std::cos, std::cosh, std::exp, std::floor, std::hypot, std::log, std::log10, std::max, std::min, std::pow;
  using std::erf;
  using std::round, std::sin, std::sinh, std::sqrt, std::tan, std::tanh;
  switch (operation) {
    case Operation::negate:
      return -a;
    case Operation::add:
      return a + b;
    case Operation::subtract:
      return a - b;
    case Operation::multiply:
      return a * b;
    case Operation::divide:
      return quotient(a, b);
    case Operation::square:
      return sqr(a);
    case Operation::power:
      return pow(a, b);
    case Operation::integer_power:
      return integer_power(a, exponent);
    case Operation::equal:
      return number<T>(equal(value(a), value(b)));
    case Operation::unequal:
      return number<T>(opposite(equal(value(a), value(b))));
    case Operation::less:
      return number<T>(less(value(a), value(b)));
    case Operation::less_equal:
      return number<T>(at_most(value(a), value(b)));
    case Operation::greater:
      return number<T>(less(value(b), value(a)));
    case Operation::greater_equal:
      return number<T>(at_most(value(b), value(a)));
    case Operation::logical_and:
      return number<T>(both(truth(a), truth(b)));
    case Operation::logical_or:
      return number<T>(opposite(both(opposite(truth(a)), opposite(truth(b)))));
    case Operation::logical_not:
      return number<T>(opposite(truth(a)));
    case Operation::select:
      return chosen(truth(b), a, c);
    case Operation::sin:
    case Operation::cos:
      if constexpr (std::is_same_v<T, double> || kIsFirstOrder<T> || kIsJetInOne<T>) {
        T sine, cosine;
        sine_and_cosine(a, sine, cosine);
        return operation == Operation::sin ? sine : cosine;
      } else {
        return operation == Operation::sin ? sin(a) : cos(a);
      }
    case Operation::tan:
      return tan(a);
    case Operation::asin:
      return asin(a);
    case Operation::acos:
      return acos(a);
    case Operation::atan:
      return atan(a);
    case Operation::sinh:
      return sinh(a);
    case Operation::cosh:
      return cosh(a);
    case Operation::tanh:
      return tanh(a);
    case Operation::asinh:
      return asinh(a);
    case Operation::acosh:
      return acosh(a);
    case Operation::atanh:
      return atanh(a);
    case Operation::exp:
      return exp(a);
    case Operation::log:
      return log(a);
    case Operation::log10:
      return log10(a);
    case Operation::sqrt:
      return sqrt(a);
    case Operation::cbrt:
      return cbrt(a);
    case Operation::abs:
      return abs(a);
    case Operation::sign:
      return sign(a);
    case Operation::floor:
      return floor(a);
    case Operation::ceil:
      return ceil(a);
    case Operation::round:
      return round(a);
    case Operation::atan2:
      return atan2(a, b);
    case Operation::min:
      return min(a, b);
    case Operation::max:
      return max(a, b);
    case Operation::hypot:
      return hypot(a, b);
    case Operation::mod:
      return remainder(a, b);
    case Operation::clamp:
      return min(max(a, b), c);
    case Operation::erf:
      return erf(a);
    case Operation::fresnel_s:
      return fresnel_s(a);
    case Operation::fresnel_c:
      return fresnel_c(a);
    case Operation::sinc:
      return sinc(a);
    case Operation::factorial:
      return factorial(a);
    case Operation::lerp:
      return a + (b - a) * c;
    case Operation::binom:
      return binom(a, whole_constant(b));
    default:  // operands, units, and what has a constant or two results
      return a;
  }
}

}  // namespace lekalo::geometry::operations
