// Fresnel's integrals: their power series up to |x| = 2.5 in extended precision, where the terms grow to a few
// thousands; beyond that the continued fraction of the complementary error function of a complex number (Press et al.
// 2007, Numerical Recipes, 6.8), also extended. sinc: its series up to |x| = 1, else the quotient.
#include "geometry/numerics/special_functions.h"

#include <algorithm>
#include <complex>

namespace lekalo::geometry {

namespace {

using Real = long double;
using Complex = std::complex<Real>;

constexpr Real kLongPi = 3.141592653589793238462643383279502884L;
constexpr double kSeriesUpTo = 2.5;
constexpr double kFresnelLimit = 0.78;  // C(1) = 0.77989 is the largest value of both
constexpr int kMaxTerms = 400;
constexpr Real kPrecision = 1e-20L;

// C + i S = sum (i pi/2)^n x^(2n+1) / (n! (2n + 1))
Complex fresnel_series(Real x) {
  const Real q = kLongPi / 2 * x * x;
  Complex term(x, 0), sum = term;
  for (int n = 1; n < kMaxTerms; ++n) {
    term *= Complex(0, q / n);
    sum += term / static_cast<Real>(2 * n + 1);
    if (std::abs(term) < kPrecision) break;
  }
  return sum;
}

// x > 0: (1 + i)/2 (1 - exp(i pi x^2/2) (1 - i) x h) with the continued fraction h.
Complex fresnel_fraction(Real x) {
  const Real q = kLongPi * x * x;
  Complex b(1, -q), c(1 / std::numeric_limits<Real>::min(), 0), d = Complex(1) / b, h = d;
  for (int k = 1; k < kMaxTerms; ++k) {
    const Real a = -static_cast<Real>(2 * k - 1) * (2 * k);
    b += Complex(4, 0);
    d = Complex(1) / (a * d + b);
    c = b + a / c;
    const Complex factor = c * d;
    h *= factor;
    if (std::abs(factor.real() - 1) + std::abs(factor.imag()) < kPrecision) break;
  }
  const Real phase = kLongPi / 2 * std::fmod(x * x, static_cast<Real>(4));
  const Complex wave(std::cos(phase), std::sin(phase));
  return Complex(0.5L, 0.5L) * (Complex(1) - wave * h * Complex(x, -x));
}

Complex fresnel(double x) {
  const double size = std::abs(x);
  Complex result(0.5L, 0.5L);
  if (!(size < 1e15)) {
    if (size != size) return {std::numeric_limits<Real>::quiet_NaN(), std::numeric_limits<Real>::quiet_NaN()};
  } else {
    result = size <= kSeriesUpTo ? fresnel_series(size) : fresnel_fraction(size);
  }
  return x < 0 ? -result : result;
}

// A value at the middle, and how far the values of an interval are from it where the slope is at most `slope`.
Interval about(double value, const Interval& x, double slope) {
  const double off = next_up(next_up(0.5 * x.width()) * slope + kSpecialError);
  return {next_down(value - off), next_up(value + off)};
}

// Both by their values at the ends, where the integrand is bounded over all between.
Interval fresnel_over(const Interval& x, double (*function)(double), const Interval& slope) {
  const Interval limits{-kFresnelLimit, kFresnelLimit};
  if (!(x.width() < 4)) return limits;
  const Interval rounding{-kSpecialError, kSpecialError};
  const Interval from_lo = Interval(function(x.lo)) + rounding + slope * (x - Interval(x.lo));
  const Interval from_hi = Interval(function(x.hi)) + rounding - slope * (Interval(x.hi) - x);
  return intersect(limits, intersect(from_lo, from_hi));
}

Interval quarter_turns(const Interval& x) { return detail::half_pi<Interval>() * sqr(x); }

}  // namespace

double fresnel_s(double x) { return static_cast<double>(fresnel(x).imag()); }
double fresnel_c(double x) { return static_cast<double>(fresnel(x).real()); }

double sinc(double x) {
  double value;
  sinc_series(x, 1, &value);
  return value;
}

double factorial(double n) {
  constexpr double kLargest = 170;
  if (!(n >= 0 && n <= kLargest && n == std::floor(n))) return std::numeric_limits<double>::quiet_NaN();
  double result = 1;
  for (int k = 2; k <= static_cast<int>(n); ++k) result *= k;
  return result;
}

void sinc_series(double x, int count, double* c) {
  // sinc^(n)(x)/n! from sin(x)/x or, near zero, from the powers (-1)^j x^(2j - n) binom(2j, n) / (2j + 1)!
  if (std::abs(x) > 1) {
    const Real sine = std::sin(static_cast<Real>(x)), cosine = std::cos(static_cast<Real>(x));
    Real before = 0, factor = 1;
    for (int n = 0; n < count; ++n) {
      if (n > 0) factor /= n;
      const Real derivative = n % 4 == 0 ? sine : n % 4 == 1 ? cosine : n % 4 == 2 ? -sine : -cosine;
      before = (derivative * factor - before) / x;
      c[n] = static_cast<double>(before);
    }
    return;
  }
  constexpr int kTerms = 16;
  for (int n = 0; n < count; ++n) {
    Real sum = 0, over = 1;
    for (int j = 0; j < kTerms; ++j) {
      if (j > 0) over /= static_cast<Real>(2 * j) * (2 * j + 1);
      if (2 * j < n) continue;
      Real choose = 1;
      for (int i = 0; i < n; ++i) choose = choose * (2 * j - i) / (i + 1);
      sum += (j % 2 == 0 ? 1 : -1) * over * choose * std::pow(static_cast<Real>(x), 2 * j - n);
    }
    c[n] = static_cast<double>(sum);
  }
}

void sinc_series(const Interval& x, int count, Interval* c) {
  const bool is_wide = !(x.width() < 4);
  double at[8];
  if (!is_wide) sinc_series(x.middle(), count, at);
  double over = 1;  // 1 / n!
  for (int n = 0; n < count; ++n) {
    if (n > 0) over /= n;
    const double bound = next_up(over / (n + 1) * (1 + 1e-15));
    const Interval limits{-bound, bound};
    c[n] = is_wide ? limits : intersect(limits, about(at[n], x, next_up(over / (n + 2) * (1 + 1e-15))));
  }
}

Interval erf(const Interval& x) {
  constexpr int kUlps = 4;
  double lo = std::erf(x.lo), hi = std::erf(x.hi);
  for (int k = 0; k < kUlps; ++k) lo = next_down(lo), hi = next_up(hi);
  return {std::max(lo, -1.0), std::min(hi, 1.0)};
}
Interval fresnel_s(const Interval& x) { return fresnel_over(x, fresnel_s, sin(quarter_turns(x))); }
Interval fresnel_c(const Interval& x) { return fresnel_over(x, fresnel_c, cos(quarter_turns(x))); }
Interval sinc(const Interval& x) {
  Interval value;
  sinc_series(x, 1, &value);
  return value;
}
Interval factorial(const Interval& n) {
  const double value = factorial(n.lo);
  if (n.lo != n.hi || value != value) return Interval::entire();
  return n.lo <= 18 ? Interval(value) : Interval(value * (1 - 1e-13), value * (1 + 1e-13));
}

}  // namespace lekalo::geometry
