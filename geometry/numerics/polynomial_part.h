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

  // Adds boxes of the derivatives up to `order` over an interval inside of t to boxes[0], ...
  void include_ranges(int order, const Interval& over, Box3* boxes) const {
    const double middle = local(over.middle()), h = 0.5 * over.width() * scale * (1 + 1e-12);
    // Taylor's coefficients about the middle (Horner's scheme again and again), and the same with all terms added up.
    std::array<Vec3, Terms> taylor, sizes;
    for (int i = 0; i < terms; ++i) taylor[i] = powers[i], sizes[i] = glm::abs(powers[i]);
    for (int m = 0; m < terms; ++m)
      for (int i = terms - 2; i >= m; --i) taylor[i] += middle * taylor[i + 1], sizes[i] += sizes[i + 1];
    constexpr double kRounding = 64 * std::numeric_limits<double>::epsilon();
    double of_order = 1;  // scale^k
    for (int k = 0; k <= order; ++k, of_order *= scale) {
      Vec3 center(0), reach(0);
      double factor = falling(k, k);  // m!/(m - k)! h^(m - k)
      for (int m = k; m < terms; ++m) {
        const Vec3 rounding = kRounding * sizes[m];
        if (m == k)
          center = factor * taylor[m], reach = factor * rounding;
        else
          reach += factor * (glm::abs(taylor[m]) + rounding);
        factor *= h * (m + 1) / (m + 1 - k);
      }
      boxes[k].include(Box3{of_order * (center - reach), of_order * (center + reach)});
    }
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
  // Halves without branches, which nothing would foretell.
  const PolynomialPart<Terms>* part = parts.data();
  for (size_t left = parts.size(); left > 1;) {
    const size_t half = left / 2;
    part += part[half].t.lo <= t ? half : 0;
    left -= half;
  }
  return *part;
}

}  // namespace lekalo::geometry
