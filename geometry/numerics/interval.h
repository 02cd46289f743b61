// Interval: a closed range [lo, hi] of reals. It serves twice: as a plain range of a parameter, and as a number whose
// arithmetic is certified, that is, f(X) contains f(x) for every x in X (Moore, Kearfott, Cloud 2009, ch. 2 and 5).
//
// Rounding: every bound of + - * / sqrt is moved outward by one ulp (half an ulp of error in round-to-nearest), every
// bound that came from libm by at least four (glibc states at most four for double). Sums that are exactly zero are
// exact in IEEE arithmetic and stay zero; bounds never leave the range of the function (sin stays in [-1, 1], squares
// stay >= 0).
//
// Special cases, chosen so that no operation makes a NaN:
//   - division by an interval that contains zero inside, and tan across a pole, give the entire line (-inf, inf);
//     a divisor with zero as a bound gives a half-line where the numerator has one sign;
//   - an argument partly outside the domain (sqrt, log, asin, acos, acosh, atanh, pow) is clipped to the domain; one
//   wholly
//     outside gives the entire line;
//   - a bound that would be NaN becomes infinite.
// Arithmetic on an empty interval (lo > hi, which only intersect() makes) means nothing: ask empty() first.
//
// The elementary functions are friends found by argument-dependent lookup only, so that sin(x) of a double never turns
// into an interval by accident. Write `using std::sin;` and then sin(x) in a formula for any number type.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace lekalo::geometry {

// Is x a number that is neither zero nor infinite? The doubles next to such an x differ by one in their bits.
constexpr bool is_finite_and_not_zero(double x) {
  constexpr std::uint64_t kMagnitude = ~std::uint64_t{0} >> 1;
  constexpr auto kInfinity = std::bit_cast<std::uint64_t>(std::numeric_limits<double>::infinity());
  return (std::bit_cast<std::uint64_t>(x) & kMagnitude) - 1 < kInfinity - 1;
}

// The next double above x; infinity stays, NaN becomes infinity.
constexpr double next_up(double x) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (!is_finite_and_not_zero(x)) [[unlikely]] {
    if (x == 0) return std::numeric_limits<double>::denorm_min();
    return x < 0 ? std::numeric_limits<double>::lowest() : kInfinity;
  }
  const auto bits = std::bit_cast<std::uint64_t>(x);
  return std::bit_cast<double>(bits + 1 - 2 * (bits >> 63));
}

// The next double below x; minus infinity stays, NaN becomes minus infinity.
constexpr double next_down(double x) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (!is_finite_and_not_zero(x)) [[unlikely]] {
    if (x == 0) return -std::numeric_limits<double>::denorm_min();
    return x > 0 ? std::numeric_limits<double>::max() : -kInfinity;
  }
  const auto bits = std::bit_cast<std::uint64_t>(x);
  return std::bit_cast<double>(bits - 1 + 2 * (bits >> 63));
}

// Plain numbers: the names that <cmath> lacks. The sign of zero is zero, of NaN NaN.
template <class S>
constexpr S sqr(const S& x) {
  return x * x;
}
template <class S>
constexpr S sign(const S& x) {
  return x > S(0) ? S(1) : x < S(0) ? S(-1) : x;
}

// An answer about intervals can be open.
enum class Truth { no, yes, unknown };

struct Interval {
  double lo = 0, hi = 0;

  constexpr Interval() = default;
  constexpr Interval(double x) : lo(x), hi(x) {}  // implicit: numbers mix freely with intervals in formulas
  constexpr Interval(double lo, double hi) : lo(lo), hi(hi) {}

  static constexpr Interval entire() {
    return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }

  constexpr double width() const { return hi - lo; }
  // Halved before adding, so that it cannot overflow; always inside a finite interval.
  constexpr double middle() const { return clamp(0.5 * lo + 0.5 * hi); }
  constexpr bool contains(double x) const { return lo <= x && x <= hi; }
  constexpr bool contains(const Interval& x) const { return lo <= x.lo && x.hi <= hi; }
  constexpr double clamp(double x) const { return x < lo ? lo : x > hi ? hi : x; }
  constexpr bool empty() const { return lo > hi; }
  constexpr bool operator==(const Interval&) const = default;

  friend constexpr Interval operator+(const Interval& a) { return a; }
  friend constexpr Interval operator-(const Interval& a) { return {-a.hi, -a.lo}; }
  friend constexpr Interval operator+(const Interval& a, const Interval& b) {
    return {sum_down(a.lo + b.lo), sum_up(a.hi + b.hi)};
  }
  friend constexpr Interval operator-(const Interval& a, const Interval& b) {
    return {sum_down(a.lo - b.hi), sum_up(a.hi - b.lo)};
  }
  friend constexpr Interval operator*(const Interval& a, const Interval& b) {
    if ((a.lo == 0 && a.hi == 0) || (b.lo == 0 && b.hi == 0)) return 0.0;
    double p = a.lo * b.lo, q = a.lo * b.hi, r = a.hi * b.lo, s = a.hi * b.hi;
    // Zero times infinity is zero here: the bound zero is attained, infinity is not.
    if (p != p || q != q || r != r || s != s) [[unlikely]]
      p = p == p ? p : 0, q = q == q ? q : 0, r = r == r ? r : 0, s = s == s ? s : 0;
    const double least = std::min(std::min(p, q), std::min(r, s)), largest = std::max(std::max(p, q), std::max(r, s));
    Interval result{next_down(least), next_up(largest)};
    if (least == 0 || largest == 0) [[unlikely]] {
      // Factors of known sign: an exact zero bound must not become a tiny number of the other sign.
      const bool same_sign = (a.lo >= 0 && b.lo >= 0) || (a.hi <= 0 && b.hi <= 0);
      const bool opposite = (a.lo >= 0 && b.hi <= 0) || (a.hi <= 0 && b.lo >= 0);
      if (same_sign && result.lo < 0) result.lo = 0;
      if (opposite && result.hi > 0) result.hi = 0;
    }
    return result;
  }
  friend constexpr Interval operator/(const Interval& a, const Interval& b) {
    if (b.lo <= 0 && b.hi >= 0) return divided_by_zero(a, b);
    double p = a.lo / b.lo, q = a.lo / b.hi, r = a.hi / b.lo, s = a.hi / b.hi;
    // Infinity by infinity: any quotient >= 0 or <= 0 is possible; the other corners supply the infinite bound.
    if (p != p || q != q || r != r || s != s) [[unlikely]]
      p = p == p ? p : 0, q = q == q ? q : 0, r = r == r ? r : 0, s = s == s ? s : 0;
    const double least = std::min(std::min(p, q), std::min(r, s)), largest = std::max(std::max(p, q), std::max(r, s));
    Interval result{next_down(least), next_up(largest)};
    if (least == 0 || largest == 0) [[unlikely]] {
      const bool positive = b.lo > 0;
      if (positive ? a.lo >= 0 : a.hi <= 0) result.lo = std::max(result.lo, 0.0);
      if (positive ? a.hi <= 0 : a.lo >= 0) result.hi = std::min(result.hi, 0.0);
    }
    return result;
  }
  constexpr Interval& operator+=(const Interval& b) { return *this = *this + b; }
  constexpr Interval& operator-=(const Interval& b) { return *this = *this - b; }
  constexpr Interval& operator*=(const Interval& b) { return *this = *this * b; }
  constexpr Interval& operator/=(const Interval& b) { return *this = *this / b; }

  friend constexpr Interval abs(const Interval& x) {
    if (x.lo >= 0) return x;
    if (x.hi <= 0) return -x;
    return {0.0, std::max(-x.lo, x.hi)};
  }
  // The square; tighter than x * x because both factors are the same number.
  friend constexpr Interval sqr(const Interval& x) {
    const Interval a = abs(x);
    const double low = next_down(a.lo * a.lo);
    return {low > 0 ? low : 0.0, a.hi == 0 ? 0.0 : next_up(a.hi * a.hi)};
  }
  friend constexpr Interval min(const Interval& a, const Interval& b) {
    return {std::min(a.lo, b.lo), std::min(a.hi, b.hi)};
  }
  friend constexpr Interval max(const Interval& a, const Interval& b) {
    return {std::max(a.lo, b.lo), std::max(a.hi, b.hi)};
  }
  friend constexpr Interval sign(const Interval& x) { return {geometry::sign(x.lo), geometry::sign(x.hi)}; }
  friend Interval floor(const Interval& x) { return {std::floor(x.lo), std::floor(x.hi)}; }
  friend Interval ceil(const Interval& x) { return {std::ceil(x.lo), std::ceil(x.hi)}; }
  friend Interval round(const Interval& x) { return {std::round(x.lo), std::round(x.hi)}; }  // halves away from zero

  // The largest and the smallest |x| in the interval.
  friend constexpr double magnitude(const Interval& x) { return abs(x).hi; }
  friend constexpr double mignitude(const Interval& x) { return abs(x).lo; }

  friend Interval sqrt(const Interval& x) {
    if (x.hi < 0) return entire();
    const double low = x.lo > 0 ? next_down(std::sqrt(x.lo)) : 0.0;
    return {low, x.hi == 0 ? 0.0 : next_up(std::sqrt(x.hi))};
  }
  friend Interval cbrt(const Interval& x);
  friend Interval hypot(const Interval& x, const Interval& y);
  friend Interval pow(const Interval& x, int exponent);  // any integer; a negative one is 1 / x^(-exponent)
  friend Interval pow(const Interval& x, double exponent);
  friend Interval pow(const Interval& x, const Interval& exponent);  // x >= 0 unless the exponent is one integer
  friend Interval exp(const Interval& x);
  friend Interval log(const Interval& x);
  friend Interval log10(const Interval& x);
  friend Interval sin(const Interval& x);
  friend Interval cos(const Interval& x);
  friend Interval tan(const Interval& x);
  friend Interval asin(const Interval& x);
  friend Interval acos(const Interval& x);
  friend Interval atan(const Interval& x);
  // Angle of the point (x, y) in [-pi, pi]. A box that meets the negative x axis from below gives all of [-pi, pi].
  friend Interval atan2(const Interval& y, const Interval& x);
  friend Interval sinh(const Interval& x);
  friend Interval cosh(const Interval& x);
  friend Interval tanh(const Interval& x);
  friend Interval asinh(const Interval& x);
  friend Interval acosh(const Interval& x);
  friend Interval atanh(const Interval& x);

 private:
  static constexpr double sum_down(double x) { return x == 0 ? 0.0 : next_down(x); }
  static constexpr double sum_up(double x) { return x == 0 ? 0.0 : next_up(x); }
  static constexpr Interval divided_by_zero(const Interval& a, const Interval& b) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    if (a.lo == 0 && a.hi == 0 && (b.lo != 0 || b.hi != 0)) return 0.0;
    if (b.lo == 0 && b.hi > 0) {
      if (a.lo >= 0) return {std::max(0.0, next_down(a.lo / b.hi)), kInfinity};
      if (a.hi <= 0) return {-kInfinity, std::min(0.0, next_up(a.hi / b.hi))};
    }
    if (b.hi == 0 && b.lo < 0) return divided_by_zero(-a, -b);
    return entire();
  }
};

// The smallest interval that contains both.
constexpr Interval hull(const Interval& a, const Interval& b) { return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)}; }
// The common part; empty() where there is none.
constexpr Interval intersect(const Interval& a, const Interval& b) {
  return {std::max(a.lo, b.lo), std::min(a.hi, b.hi)};
}
constexpr bool intersects(const Interval& a, const Interval& b) { return a.lo <= b.hi && b.lo <= a.hi; }

// Is a < b? For intervals: for all, for no, or for some of their points.
template <class S>
constexpr Truth less(const S& a, const S& b) {
  return a < b ? Truth::yes : Truth::no;
}
constexpr Truth less(const Interval& a, const Interval& b) {
  return a.hi < b.lo ? Truth::yes : a.lo >= b.hi ? Truth::no : Truth::unknown;
}

}  // namespace lekalo::geometry
