// The fraction of its arc length as a function of a curve's parameter, s(t) = 1/L integral of |r'| up to t, for many
// parameters.
//
// The speed |r'| is interpolated by Chebyshev polynomials on stretches short enough that they hold it to rounding;
// their integrals are exact (Trefethen 2013, ch. 3 and 19).
#pragma once

#include <array>
#include <vector>

#include "geometry/curve.h"

namespace lekalo::geometry {

class ArcFraction {
 public:
  ArcFraction() = default;
  // The curve's domain must be finite. Throws std::invalid_argument for a curve without length.
  explicit ArcFraction(const Curve& curve);

  double length() const { return length_; }
  double at(double t) const;  // t in the domain

 private:
  static constexpr int kTerms = 14;
  struct Stretch {
    Interval t;
    double begin = 0;  // the length up to t.lo
    std::array<double, kTerms + 1> integral{};
    double length_to(double t) const;  // from t.lo
  };
  void cut(const Curve& curve, const Interval& t, double size, double shortest);

  std::vector<Stretch> stretches_;
  double length_ = 0;
};

// Parameters that cut the curve of this domain into so many parts of equal length, the ends included.
std::vector<double> parameters_at_even_lengths(const ArcFraction& lengths, const Interval& domain, int parts);

}  // namespace lekalo::geometry
