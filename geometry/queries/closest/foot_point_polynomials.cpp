#include "geometry/queries/closest/foot_point_polynomials.h"

#include <algorithm>
#include <cmath>

namespace lekalo::geometry {

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
// Halvings of a curve piece: what is not decided then is left to a search that can tell more.
constexpr int kMaxHalvings = 14;
constexpr int kMaxCoefficients = 3 * FootPointPolynomial::kMaxDegree + 1;

double binomial(int n, int k) {
  double result = 1;
  for (int i = 1; i <= k; ++i) result = result * (n - k + i) / i;
  return result;
}

// Scaled Bernstein forms, coefficients times binomials: products are convolutions.
using Scaled = std::vector<double>;
Scaled operator*(const Scaled& a, const Scaled& b) {
  Scaled result(a.size() + b.size() - 1, 0.0);
  for (size_t i = 0; i < a.size(); ++i)
    for (size_t j = 0; j < b.size(); ++j) result[i + j] += a[i] * b[j];
  return result;
}
Scaled derivative(const Scaled& a) {
  const int n = static_cast<int>(a.size()) - 1;
  Scaled result(n);
  for (int i = 0; i < n; ++i)
    result[i] = n * binomial(n - 1, i) * (a[i + 1] / binomial(n, i + 1) - a[i] / binomial(n, i));
  return result;
}

// From the bounds |A - q w| <= reach + |q| W and |w| <= W of the coefficients: each of the terms 2 D w' and D' w is
// below 4 n times their product, and has no more than 3 n + 20 roundings, as has the other.
double error_of_coefficients(int degree, double max_weight) {
  return 8.0 * std::max(degree, 1) * (3 * degree + 20) * kEpsilon * max_weight;
}

struct Extent {
  double reach = 0, weight = 0;
};
Extent extent_of(std::span<const Vec4> points, const Vec3& origin) {
  Extent extent;
  for (const Vec4& p : points) extent.weight = std::max(extent.weight, std::abs(p.w));
  for (const Vec4& p : points)
    extent.reach = std::max(extent.reach, glm::length(Vec3(p) - p.w * origin) / extent.weight);
  return extent;
}

// Zeros of one polynomial with coefficients that are known to `error`.
class Isolation {
 public:
  Isolation(int count, double error, CurveFootPointZeros& found) : count_(count), error_(error), found_(found) {}

  using Coefficients = std::array<double, kMaxCoefficients>;
  void visit(const Coefficients& b, const Interval& t, int halvings) {
    // Signs -1, 0 (not known), 1: those of one kind, then those of the other with at most one unknown between.
    const auto sign_of = [&](int i) { return b[i] > error_ ? 1 : b[i] < -error_ ? -1 : 0; };
    const int first = sign_of(0), last = sign_of(count_ - 1);
    if (first != 0 && last != 0) {
      int begin = 1, end = count_ - 1;
      while (begin < count_ && sign_of(begin) == first) ++begin;
      if (begin == count_) return;
      while (end > 0 && sign_of(end - 1) == last) --end;
      if (first != last && end - begin <= 1) {
        found_.single.push_back({t, t.lo + t.width() * zero_of(b)});
        return;
      }
    }
    if (halvings == kMaxHalvings) {
      found_.undecided.push_back(t);
      return;
    }
    Coefficients lower, upper = b;
    for (int k = 0; k < count_; ++k) {
      lower[k] = upper[0];
      for (int i = 0; i + 1 < count_ - k; ++i) upper[i] = 0.5 * (upper[i] + upper[i + 1]);
    }
    visit(lower, {t.lo, t.middle()}, halvings + 1);
    visit(upper, {t.middle(), t.hi}, halvings + 1);
  }

 private:
  // About where in [0, 1] the only zero lies: Newton's iteration, or halves where it leaves the bracket.
  double zero_of(const Coefficients& b) const {
    double lo = 0, hi = 1, x = b[0] / (b[0] - b[count_ - 1]);
    for (int step = 0; step < 30; ++step) {
      Coefficients c = b;
      for (int k = 1; k < count_ - 1; ++k)
        for (int i = 0; i + k < count_; ++i) c[i] += x * (c[i + 1] - c[i]);
      const double slope = c[1] - c[0], value = c[0] + x * slope;
      ((value > 0) == (b[0] > 0) ? lo : hi) = x;
      const double next = x - value / ((count_ - 1) * slope);
      const double to = next > lo && next < hi ? next : 0.5 * (lo + hi);
      const double moved = std::abs(to - x);
      x = to;
      if (moved < kNearZero) break;
    }
    return x;
  }

  static constexpr double kNearZero = 1e-5;  // of the part: the curve's own Newton's steps end it
  const int count_;
  const double error_;
  CurveFootPointZeros& found_;
};

}  // namespace

FootPointPolynomial::FootPointPolynomial(std::span<const Vec4> points, const Vec3& origin) : origin_(origin) {
  const int n = static_cast<int>(points.size()) - 1;
  std::array<Scaled, 4> a;  // x, y, z, w
  for (int i = 0; i <= n; ++i) {
    const Vec4 p(Vec3(points[i]) - points[i].w * origin, points[i].w);
    for (int k = 0; k < 4; ++k) a[k].push_back(binomial(n, i) * p[k]);
  }
  const Scaled& w = a[3];
  const auto numerator = [&](const Scaled& d) {
    Scaled left = d * derivative(w), right = derivative(d) * w;
    for (size_t i = 0; i < left.size(); ++i)
      left[i] = (2 * left[i] - right[i]) / binomial(3 * n - 1, static_cast<int>(i));
    return left;
  };
  coefficients_.resize(3 * n);
  Scaled square(2 * n + 1, 0.0);
  for (int k = 0; k < 3; ++k) {
    const Scaled own = a[k] * a[k];
    for (size_t i = 0; i < square.size(); ++i) square[i] += own[i];
    const Scaled by = numerator(a[k] * w);
    for (int i = 0; i < 3 * n; ++i) coefficients_[i][k] = by[i];
  }
  const Scaled by = numerator(square);
  for (int i = 0; i < 3 * n; ++i) coefficients_[i].w = by[i];
  const Extent extent = extent_of(points, origin);
  reach_ = extent.reach;
  min_error_ = error_of_coefficients(n, extent.weight) * sqr(extent.weight) * (1 + kMaxHalvings);
}

bool FootPointPolynomial::isolate(const Vec3& p, CurveFootPointZeros& found) const {
  const Vec3 q = p - origin_;
  const Vec4 by(-2.0 * q, 1);
  Isolation::Coefficients b;
  const int count = static_cast<int>(coefficients_.size());
  const double error = min_error_ * sqr(reach_ + glm::length(q));
  bool vanishes = true;
  for (int i = 0; i < count; ++i) {
    b[i] = glm::dot(coefficients_[i], by);
    vanishes = vanishes && std::abs(b[i]) <= error;
  }
  if (vanishes) return false;
  Isolation(count, error, found).visit(b, {0, 1}, 0);
  return true;
}

}  // namespace lekalo::geometry
