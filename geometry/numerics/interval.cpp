// The elementary functions of intervals: monotone pieces, with the extrema of the periodic ones found by counting
// multiples of pi with interval arithmetic (Moore, Kearfott, Cloud 2009, 5.1).
#include "geometry/numerics/interval.h"

#include <numbers>

namespace lekalo::geometry {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// pi lies between this double and the next.
constexpr Interval kPi{std::numbers::pi, next_up(std::numbers::pi)};
// Beyond this the multiples of pi can no longer be counted in double: the whole range is returned.
constexpr double kLargestAngle = 1e15;

// Four ulps and a bit: 2^-50 |y| is at least four and at most eight ulps of y.
constexpr double kLibmError = 0x1p-50;

// Bounds of a value that libm computed as y. NaN gives the infinite bound.
double libm_down(double y) {
  return next_down(y - (kLibmError * std::fabs(y) + 4 * std::numeric_limits<double>::denorm_min()));
}
double libm_up(double y) { return -libm_down(-y); }

// A function that increases on the interval; `range` is what it can attain.
template <class F>
Interval increasing(const Interval& x, F f, const Interval& range = Interval::entire()) {
  return intersect(Interval{libm_down(f(x.lo)), libm_up(f(x.hi))}, range);
}

// Such a function with f(x) = 0 only at the double x = zero: there libm is exact.
template <class F>
Interval increasing_through(double zero, const Interval& x, F f, const Interval& range = Interval::entire()) {
  Interval y = increasing(x, f, range);
  if (x.lo >= zero) y.lo = std::max(y.lo, 0.0);
  if (x.hi <= zero) y.hi = std::min(y.hi, 0.0);
  return y;
}

// Which of the points (k + shift) pi lie in x: is there one with k even, one with k odd? May say yes too often.
struct Multiples {
  bool even = false, odd = false;
};
Multiples multiples_of_pi(const Interval& x, double shift) {
  if (!(magnitude(x) < kLargestAngle)) return {true, true};
  // Mostly there is none, and certainly so where the ends, moved by more than their rounding, lie between the same two.
  constexpr double kInverse = 1 / std::numbers::pi;
  const double slack = 1e-12 * (1 + magnitude(x));
  if (std::floor(x.lo * kInverse - shift - slack) == std::floor(x.hi * kInverse - shift + slack)) return {};
  const Interval turns = x / kPi - shift;
  const double first = std::ceil(turns.lo), last = std::floor(turns.hi);
  if (first > last) return {};
  if (last > first) return {true, true};
  return std::fmod(first, 2.0) == 0 ? Multiples{true, false} : Multiples{false, true};
}

// libm's value at the ends, the extrema where `extrema` has them (+1 at even multiples, -1 at odd ones).
Interval wave(double at_lo, double at_hi, const Multiples& extrema) {
  Interval y{libm_down(std::min(at_lo, at_hi)), libm_up(std::max(at_lo, at_hi))};
  if (extrema.even) y.hi = 1;
  if (extrema.odd) y.lo = -1;
  return intersect(y, {-1.0, 1.0});
}

// x^n of a number x >= 0 by repeated multiplication, every product moved by `round`.
template <class Round>
double rounded_power(double x, int n, Round round) {
  double result = 1;
  for (; n > 0; n >>= 1) {
    if (n & 1) result = result == 1 ? x : round(result * x);
    if (n > 1) x = round(x * x);
  }
  return result;
}

double power_down(double x, int n) {
  return rounded_power(x, n, [](double p) { return std::max(0.0, next_down(p)); });
}
double power_up(double x, int n) {
  return x == 0 ? 0.0 : rounded_power(x, n, [](double p) { return next_up(p); });
}

}  // namespace

Interval cbrt(const Interval& x) {
  return increasing_through(0, x, [](double t) { return std::cbrt(t); });
}

Interval hypot(const Interval& x, const Interval& y) {
  const Interval a = abs(x), b = abs(y);
  return {std::max({libm_down(std::hypot(a.lo, b.lo)), a.lo, b.lo}),
          a.hi == 0 && b.hi == 0 ? 0.0 : libm_up(std::hypot(a.hi, b.hi))};
}

Interval pow(const Interval& x, int exponent) {
  if (exponent == 0) return 1.0;
  if (exponent < 0) {
    if (exponent == std::numeric_limits<int>::min()) return 1.0 / (x * pow(x, std::numeric_limits<int>::max()));
    return 1.0 / pow(x, -exponent);
  }
  if (exponent % 2 == 0) {
    const Interval a = abs(x);
    return {power_down(a.lo, exponent), power_up(a.hi, exponent)};
  }
  return {x.lo >= 0 ? power_down(x.lo, exponent) : -power_up(-x.lo, exponent),
          x.hi >= 0 ? power_up(x.hi, exponent) : -power_down(-x.hi, exponent)};
}

Interval pow(const Interval& x, double exponent) {
  if (exponent == std::floor(exponent) && std::fabs(exponent) <= 64) return pow(x, static_cast<int>(exponent));
  // A large integer: even ones see |x|, odd ones keep the sign.
  if (exponent == std::floor(exponent) && std::isfinite(exponent)) {
    const auto positive = [&](const Interval& a) {
      const double p = std::pow(a.lo, exponent), q = std::pow(a.hi, exponent);
      return Interval{std::max(0.0, libm_down(std::min(p, q))), libm_up(std::max(p, q))};
    };
    const bool odd = std::fmod(exponent, 2.0) != 0;
    if (!odd) return positive(abs(x));
    if (x.lo >= 0) return positive(x);
    if (x.hi <= 0) return -positive(-x);
    if (exponent < 0) return Interval::entire();
    return hull(-positive({0.0, -x.lo}), positive({0.0, x.hi}));
  }
  if (!(x.hi >= 0)) return Interval::entire();
  const double p = std::pow(std::max(x.lo, 0.0), exponent), q = std::pow(x.hi, exponent);
  return {std::max(0.0, libm_down(std::min(p, q))), libm_up(std::max(p, q))};
}

Interval pow(const Interval& x, const Interval& exponent) {
  if (exponent.lo == exponent.hi) return pow(x, exponent.lo);
  if (!(x.hi >= 0)) return Interval::entire();
  // On x >= 0 the power is monotone in each argument, so the extrema stand in the corners.
  const double low = std::max(x.lo, 0.0);
  const double p = std::pow(low, exponent.lo), q = std::pow(low, exponent.hi), r = std::pow(x.hi, exponent.lo),
               s = std::pow(x.hi, exponent.hi);
  return {std::max(0.0, libm_down(std::min(std::min(p, q), std::min(r, s)))),
          libm_up(std::max(std::max(p, q), std::max(r, s)))};
}

Interval exp(const Interval& x) {
  return increasing(x, [](double t) { return std::exp(t); }, {0.0, kInfinity});
}

Interval log(const Interval& x) {
  if (!(x.hi > 0)) return Interval::entire();
  return increasing_through(1, {std::max(x.lo, 0.0), x.hi}, [](double t) { return std::log(t); });
}

Interval log10(const Interval& x) {
  if (!(x.hi > 0)) return Interval::entire();
  return increasing_through(1, {std::max(x.lo, 0.0), x.hi}, [](double t) { return std::log10(t); });
}

Interval sin(const Interval& x) {
  if (x.lo == 0 && x.hi == 0) return 0.0;
  const Multiples extrema = multiples_of_pi(x, 0.5);
  if (extrema.even && extrema.odd) return {-1.0, 1.0};
  return wave(std::sin(x.lo), std::sin(x.hi), extrema);
}

Interval cos(const Interval& x) {
  const Multiples extrema = multiples_of_pi(x, 0.0);
  if (extrema.even && extrema.odd) return {-1.0, 1.0};
  return wave(std::cos(x.lo), std::cos(x.hi), extrema);
}

Interval tan(const Interval& x) {
  const Multiples poles = multiples_of_pi(x, 0.5);
  if (poles.even || poles.odd) return Interval::entire();
  const auto f = [](double t) { return std::tan(t); };
  return x.lo == 0 && x.hi == 0 ? Interval(0.0) : increasing(x, f);
}

Interval asin(const Interval& x) {
  const Interval clipped = intersect(x, {-1.0, 1.0});
  if (clipped.empty()) return Interval::entire();
  return increasing_through(0, clipped, [](double t) { return std::asin(t); }, {-kPi.hi / 2, kPi.hi / 2});
}

Interval acos(const Interval& x) {
  const Interval clipped = intersect(x, {-1.0, 1.0});
  if (clipped.empty()) return Interval::entire();
  return intersect(Interval{libm_down(std::acos(clipped.hi)), libm_up(std::acos(clipped.lo))}, {0.0, kPi.hi});
}

Interval atan(const Interval& x) {
  return increasing_through(0, x, [](double t) { return std::atan(t); }, {-kPi.hi / 2, kPi.hi / 2});
}

Interval atan2(const Interval& y, const Interval& x) {
  if (y.lo < 0 && y.hi >= 0 && x.lo < 0) return {-kPi.hi, kPi.hi};
  // Elsewhere the box lies in a half-plane that the cut does not cross, and its corners have the extreme angles.
  // Adding zero turns -0 into +0, which keeps y = 0 on the upper side of the cut.
  const double ylo = y.lo + 0.0, yhi = y.hi + 0.0, xlo = x.lo + 0.0, xhi = x.hi + 0.0;
  const double p = std::atan2(ylo, xlo), q = std::atan2(ylo, xhi), r = std::atan2(yhi, xlo), s = std::atan2(yhi, xhi);
  Interval angle{libm_down(std::min(std::min(p, q), std::min(r, s))),
                 libm_up(std::max(std::max(p, q), std::max(r, s)))};
  if (ylo >= 0) angle.lo = std::max(angle.lo, 0.0);
  if (yhi <= 0 && xlo >= 0) angle.hi = std::min(angle.hi, 0.0);
  return intersect(angle, {-kPi.hi, kPi.hi});
}

Interval sinh(const Interval& x) {
  return increasing_through(0, x, [](double t) { return std::sinh(t); });
}

Interval cosh(const Interval& x) {
  const Interval a = abs(x);
  return increasing(a, [](double t) { return std::cosh(t); }, {1.0, kInfinity});
}

Interval tanh(const Interval& x) {
  return increasing_through(0, x, [](double t) { return std::tanh(t); }, {-1.0, 1.0});
}

Interval asinh(const Interval& x) {
  return increasing_through(0, x, [](double t) { return std::asinh(t); });
}

Interval acosh(const Interval& x) {
  if (!(x.hi >= 1)) return Interval::entire();
  return increasing_through(1, {std::max(x.lo, 1.0), x.hi}, [](double t) { return std::acosh(t); });
}

Interval atanh(const Interval& x) {
  const Interval clipped = intersect(x, {-1.0, 1.0});
  if (clipped.empty()) return Interval::entire();
  return increasing_through(0, clipped, [](double t) { return std::atanh(t); });
}

}  // namespace lekalo::geometry
