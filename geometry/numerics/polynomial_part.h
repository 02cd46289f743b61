// A part of a piecewise polynomial with values in space:
//
//   p(t) = sum powers[i] x^i,   x = (t - middle) scale in [-1, 1],   scale = 2/(width of t) but for rounding
//
// Powers of x serve well to about degree 20 where the coefficients come from a Chebyshev series that falls fast. Bounds
// by Taylor's polynomial about the middle of what is asked for.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "geometry/numerics/interval.h"
#include "geometry/vectors.h"

namespace lekalo::geometry {

template <std::size_t Terms>
struct PolynomialPart {
  Interval t;
  double scale = 1;
  std::array<Vec3, Terms> powers;
  int terms = static_cast<int>(Terms);  // the powers from here on are zero

  double local(double at) const { return (at - t.middle()) * scale; }

  Vec3 value(double x) const {
    Vec3 sum(0);
    for (int i = terms; i-- > 0;) sum = sum * x + powers[i];
    return sum;
  }

  // The value and the first derivative by t at x, in one run (Horner's scheme with its own derivative).
  void value_and_slope(double x, Vec3& sum, Vec3& slope) const {
    sum = slope = Vec3(0);
    for (int i = terms; i-- > 0;) {
      slope = slope * x + sum;
      sum = sum * x + powers[i];
    }
    slope *= scale;
  }

  // The k-th derivative by t at x.
  Vec3 derivative(int k, double x) const {
    Vec3 sum(0);
    for (int i = terms; i-- > k;) sum = sum * x + falling(i, k) * powers[i];
    return sum * scale_to(k);
  }

  // A box of the k-th derivative over an interval inside of t.
  Box3 enclose(int k, const Interval& over) const {
    const double middle = local(over.middle()), h = 0.5 * over.width() * scale * (1 + 1e-12);
    Vec3 center(0), reach(0);
    double power = 1, factorial = 1;  // h^(m - k), (m - k)!
    for (int m = k; m < terms; ++m) {
      Vec3 sum(0), size(0);
      for (int i = terms; i-- > m;) {
        const double factor = falling(i, m);
        sum = sum * middle + factor * powers[i];
        size = size + factor * glm::abs(powers[i]);
      }
      const Vec3 rounding = 64 * std::numeric_limits<double>::epsilon() * size;
      if (m == k)
        center = sum, reach = rounding;
      else
        reach += (glm::abs(sum) + rounding) * (power / factorial);
      power *= h;
      factorial *= m - k + 1;
    }
    return {scale_to(k) * (center - reach), scale_to(k) * (center + reach)};
  }

 private:
  // i (i - 1) ... (i - k + 1)
  static double falling(int i, int k) {
    double product = 1;
    for (int j = 0; j < k; ++j) product *= i - j;
    return product;
  }
  double scale_to(int k) const {
    double product = 1;
    for (int j = 0; j < k; ++j) product *= scale;
    return product;
  }
};

// The part that holds t, of several in order: the one that begins there where two meet.
template <std::size_t Terms>
const PolynomialPart<Terms>& part_at(const std::vector<PolynomialPart<Terms>>& parts, double t) {
  auto part = std::upper_bound(parts.begin(), parts.end(), t,
                               [](double x, const PolynomialPart<Terms>& p) { return x < p.t.lo; });
  return part == parts.begin() ? *part : *--part;
}

}  // namespace lekalo::geometry
