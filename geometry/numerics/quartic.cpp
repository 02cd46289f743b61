// Quadratic and quartic roots without allocation, for rays. Between neighbouring extrema a polynomial is monotone and
// has at most one root, which a bracketed Newton iteration finds; the extrema are the roots of the derivative, found
// the same way, down to the quadratic formula. Each value's sign is decided against its own error bound, so that an
// extremum within rounding of zero is seen and reported as a tangent root instead of being lost between two signs.
// Roots that the signs of Bernstein coefficients tell apart, which is most of them, need no extrema.
#include <cmath>
#include <numbers>

#include "geometry/numerics/polynomial.h"

namespace lekalo::geometry {
namespace {

constexpr double kUnitRoundoff = 0x1p-53;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// a b as the unevaluated sum of two doubles (Dekker 1971), for |a b| well inside the range of double.
struct Product {
  double high, low;
};
Product exact_product(double a, double b) {
  constexpr double kSplit = 0x1p27 + 1;
  const double as = kSplit * a, bs = kSplit * b;
  const double ah = as - (as - a), al = a - ah, bh = bs - (bs - b), bl = b - bh;
  const double p = a * b;
  return {p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
}

// p(x) by Horner's rule; the sign is 0 where |p(x)| is within its error bound.
struct Evaluation {
  double value;
  int sign;
};
template <int N>
Evaluation evaluate(const double* c, double x, double relative_error) {
  const double size = std::fabs(x);
  double p = c[N], running = 0.5 * std::fabs(p), sum = std::fabs(c[N]);
  for (int i = N - 1; i >= 0; --i) {
    p = p * x + c[i];
    running = running * size + std::fabs(p);
    sum = sum * size + std::fabs(c[i]);
  }
  const double error = kUnitRoundoff * (2 * running - std::fabs(p)) * 1.01 + relative_error * sum;
  if (!std::isfinite(error)) return {p, p > 0 ? 1 : -1};  // overflow of p leaves the sign right
  return {p, p > error ? 1 : p < -error ? -1 : 0};
}

// The only root between a and b, where p has different signs (up to rounding); `start` lies between them.
template <int N>
double crossing(const double* c, double a, double b, bool rising, double start, double last_step = 0) {
  double x = start, previous = kInfinity;
  for (int step = 0; step < 2000; ++step) {
    double p = c[N], slope = 0;
    for (int i = N - 1; i >= 0; --i) {
      slope = slope * x + p;
      p = p * x + c[i];
    }
    if (p == 0) return x;
    ((p < 0) == rising ? a : b) = x;
    double next = x - p / slope;
    if (!(a <= next && next <= b)) next = 0.5 * a + 0.5 * b;  // also where the slope is 0 or the quotient NaN
    const double change = std::fabs(next - x);
    if (change <= std::fmax(kUnitRoundoff * std::fabs(x), last_step)) return next;
    // Newton's steps shrink fast until rounding keeps them from it. They also shrink slowly far from the root and
    // beside a double one, so it is the value's own error bound that tells.
    if (change > 0.25 * previous && evaluate<N>(c, x, 0).sign == 0) return x;
    previous = change;
    x = next;
  }
  return x;
}

// A bound on the absolute value of all roots (Fujiwara 1916), used where the domain is infinite.
template <int N>
double root_bound(const double* c) {
  double bound = 0;
  for (int i = 0; i < N; ++i) {
    const double ratio = std::fabs(c[i] / c[N]);
    bound = std::fmax(bound, i == N - 1 ? ratio : std::pow(ratio, 1.0 / (N - i)));
  }
  return std::fmin(2.1 * bound + std::numeric_limits<double>::min(), std::numeric_limits<double>::max());
}

template <int N>
Roots<N> roots_between(const double* c, Interval domain, double relative_error) {
  Roots<N> roots;
  if (c[N] == 0) {
    for (const PolynomialRoot& root : roots_between<N - 1>(c, domain, relative_error)) roots.add(root.x, root.tangent);
    return roots;
  }
  if (std::isinf(domain.lo) || std::isinf(domain.hi)) {
    const double bound = root_bound<N>(c);
    domain = intersect(domain, {-bound, bound});
    if (domain.empty()) return roots;
  }
  double slope[N];
  for (int i = 0; i < N; ++i) slope[i] = (i + 1) * c[i + 1];
  const Roots<N - 1> extrema = roots_between<N - 1>(slope, domain, relative_error + kUnitRoundoff);

  double x[N + 1];
  Evaluation at[N + 1];
  int count = 0;
  const auto add_point = [&](double t) {
    x[count] = t;
    at[count++] = evaluate<N>(c, t, relative_error);
  };
  add_point(domain.lo);
  for (const PolynomialRoot& extremum : extrema) add_point(extremum.x);
  add_point(domain.hi);

  for (int i = 0; i < count; ++i) {
    if (at[i].sign != 0) {
      if (i + 1 < count && at[i + 1].sign == -at[i].sign) {
        roots.add(crossing<N>(c, x[i], x[i + 1], at[i].sign < 0, 0.5 * x[i] + 0.5 * x[i + 1]), false);
      }
      continue;
    }
    // A run of points where p cannot be told from zero: one root, at the smallest of them. Extrema go before the ends
    // of the domain, since only an extremum places a tangent root well.
    const int first = i;
    while (i + 1 < count && at[i + 1].sign == 0) ++i;
    const int left = first > 0 ? at[first - 1].sign : 0, right = i + 1 < count ? at[i + 1].sign : 0;
    int best = first;
    bool has_extremum = false;
    for (int k = first; k <= i; ++k) {
      const bool extremum = k > 0 && k + 1 < count;
      if (extremum && (!has_extremum || std::fabs(at[k].value) < std::fabs(at[best].value))) best = k;
      has_extremum = has_extremum || extremum;
    }
    if (!has_extremum && std::fabs(at[i].value) < std::fabs(at[first].value)) best = i;
    roots.add(x[best], has_extremum && left * right >= 0);
  }
  return roots;
}

template <>
Roots<2> roots_between<2>(const double* c, Interval domain, double relative_error) {
  Roots<2> roots;
  for (const PolynomialRoot& root : quadratic_roots({c[0], c[1], c[2]}, relative_error)) {
    if (domain.contains(root.x)) roots.add(root.x, root.tangent);
  }
  return roots;
}

}  // namespace

Roots<2> quadratic_roots(const std::array<double, 3>& c, double relative_error) {
  Roots<2> roots;
  double c0 = c[0], c1 = c[1], c2 = c[2];
  const double largest = std::fmax(std::fabs(c0), std::fmax(std::fabs(c1), std::fabs(c2)));
  if (!std::isfinite(c0 + c1 + c2) && !(std::isfinite(c0) && std::isfinite(c1) && std::isfinite(c2))) return roots;
  if (largest > 1e100 || (largest < 1e-100 && largest > 0)) {
    const int exponent = -std::ilogb(largest);
    c0 = std::ldexp(c0, exponent), c1 = std::ldexp(c1, exponent), c2 = std::ldexp(c2, exponent);
  }
  const auto add = [&roots](double x, bool tangent) {
    if (std::isfinite(x)) roots.add(x, tangent);
  };
  if (c2 == 0) {
    if (c1 != 0) add(-c0 / c1, false);
    return roots;
  }
  const double half = 0.5 * c1;
  const Product square = exact_product(half, half), product = exact_product(c2, c0);
  const double discriminant = (square.high - product.high) + (square.low - product.low);
  const double error = 2 * relative_error * (square.high + std::fabs(product.high));
  if (std::fabs(discriminant) <= error) {
    add(-half / c2, true);
  } else if (discriminant > 0) {
    const double q = -(half + std::copysign(std::sqrt(discriminant), half));
    const double x = q / c2, y = c0 / q;
    add(std::fmin(x, y), false);
    add(std::fmax(x, y), false);
  }
  return roots;
}

namespace {

// Isolates the roots in a finite domain by the signs of the Bernstein coefficients: the number of roots is that of the
// sign changes or an even number less (Descartes), so none means none and one means one; more are told apart by
// halving.
class Isolation {
 public:
  Isolation(const std::array<double, 5>& c, double relative_error, const Interval& wanted, double last_step)
      : c_(c), relative_error_(relative_error), wanted_(wanted), last_step_(last_step) {}

  // False where rounding or nearly equal roots leave the count open.
  bool run(const Interval& domain, Roots<4>& roots) {
    const double a = domain.lo, w = domain.hi - domain.lo;
    std::array<double, 5> shifted = c_;  // about a, by Horner's scheme
    for (int i = 0; i < 4; ++i)
      for (int k = 3; k >= i; --k) shifted[k] += a * shifted[k + 1];
    double power = 1, size = 0, reach = 1;
    for (int i = 0; i <= 4; ++i) {
      shifted[i] *= power;
      power *= w;
      size += std::fabs(c_[i]) * reach;
      reach *= std::fabs(a) + w;
    }
    error_ = (64 * kUnitRoundoff + relative_error_) * size;
    if (!std::isfinite(error_)) return false;
    // b_j = sum over i of (j over i) / (4 over i) c_i; every intermediate is at most `size`.
    const double c1 = shifted[1] / 4, c2 = shifted[2] / 6, c3 = shifted[3] / 4;
    return split({shifted[0], shifted[0] + c1, shifted[0] + 2 * c1 + c2, shifted[0] + 3 * c1 + 3 * c2 + c3,
                  shifted[0] + 4 * c1 + 6 * c2 + 4 * c3 + shifted[4]},
                 domain.lo, domain.hi, 0, roots);
  }

 private:
  static constexpr int kDeepest = 6;

  bool split(const std::array<double, 5>& b, double lo, double hi, int depth, Roots<4>& roots) const {
    int changes = 0;
    bool sure = true;
    for (int j = 0; j < 5; ++j) {
      sure = sure && std::fabs(b[j]) > error_;
      if (j > 0 && (b[j] < 0) != (b[j - 1] < 0)) ++changes;
    }
    if (sure && changes == 0) return true;
    if (sure && changes == 1) {
      if (hi < wanted_.lo || lo > wanted_.hi) return true;
      // From the chord's root.
      const double chord = lo + (hi - lo) * (b[0] / (b[0] - b[4]));
      roots.add(crossing<4>(c_.data(), lo, hi, b[0] < 0, chord, last_step_), false);
      return true;
    }
    if (depth == kDeepest) return false;
    std::array<double, 5> left = b, right = b;
    for (int level = 1; level < 5; ++level) {
      for (int i = 0; i < 5 - level; ++i) right[i] = 0.5 * (right[i] + right[i + 1]);
      left[level] = right[0];
    }
    const double middle = 0.5 * (lo + hi);
    return split(left, lo, middle, depth + 1, roots) && split(right, middle, hi, depth + 1, roots);
  }

  const std::array<double, 5>& c_;
  double relative_error_, error_ = 0;
  Interval wanted_;
  double last_step_;
};

}  // namespace

Roots<4> quartic_roots(const std::array<double, 5>& c, const Interval& domain, double relative_error,
                       const Interval& wanted, double last_step) {
  for (const double x : c) {
    if (!std::isfinite(x)) return {};
  }
  if (domain.empty()) return {};
  if (std::isfinite(domain.lo) && std::isfinite(domain.hi)) {
    Roots<4> roots;
    if (Isolation(c, relative_error, wanted, last_step).run(domain, roots)) return roots;
  }
  return roots_between<4>(c.data(), domain, relative_error);
}

}  // namespace lekalo::geometry
