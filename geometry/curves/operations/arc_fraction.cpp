#include "geometry/curves/operations/arc_fraction.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/numerics/chebyshev.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// Last coefficients whose share of the length is below this part of it: what is cut off is rounding.
constexpr double kConverged = 1e-15;

}  // namespace

ArcFraction::ArcFraction(const Curve& curve) {
  const double shortest = kSmallestCell * curve.domain().width();
  const double size = bounds(curve).diameter();  // about the least that the length can be
  for (const CurvePiece& piece : curve.pieces()) cut(curve, piece.domain, size, shortest);
  for (Stretch& stretch : stretches_) {
    stretch.begin = length_;
    length_ += stretch.length_to(stretch.t.hi);
  }
  if (!(length_ > 0 && length_ < kInfinity)) throw std::invalid_argument("the curve has no length");
}

void ArcFraction::cut(const Curve& curve, const Interval& t, double size, double shortest) {
  // The points lie inside, where a break at the end is not seen.
  std::array<double, kTerms> speed;
  for (int j = 0; j < kTerms; ++j)
    speed[j] = glm::length(curve.evaluate(t.middle() + 0.5 * t.width() * chebyshev_point(j, kTerms), 1).d[1]);
  const std::array<double, kTerms> c = chebyshev_coefficients(speed);
  const double tail = std::max({std::abs(c[kTerms - 1]), std::abs(c[kTerms - 2]), std::abs(c[kTerms - 3])});
  if (!(tail * t.width() <= kConverged * size) && t.width() > shortest) {
    cut(curve, {t.lo, t.middle()}, size, shortest);
    cut(curve, {t.middle(), t.hi}, size, shortest);
    return;
  }
  Stretch stretch;
  stretch.t = t;
  // The integral of T_k is T_(k+1) / (2 (k + 1)) - T_(k-1) / (2 (k - 1)).
  for (int k = 1; k <= kTerms; ++k) {
    const double before = (k == 1 ? 2 : 1) * c[k - 1], after = k + 1 < kTerms ? c[k + 1] : 0;
    stretch.integral[k] = 0.25 * t.width() * (before - after) / k;
    stretch.integral[0] += (k % 2 == 1 ? 1 : -1) * stretch.integral[k];  // zero at t.lo
  }
  stretches_.push_back(stretch);
}

// Clenshaw's recurrence.
double ArcFraction::Stretch::length_to(double at) const {
  const double x = std::clamp((at - t.lo - (t.hi - at)) / t.width(), -1.0, 1.0);
  double b = 0, next = 0;
  for (int k = kTerms; k > 0; --k) {
    const double now = integral[k] + 2 * x * b - next;
    next = b;
    b = now;
  }
  return integral[0] + x * b - next;
}

double ArcFraction::at(double t) const {
  if (t <= stretches_.front().t.lo) return 0;
  if (t >= stretches_.back().t.hi) return 1;
  auto found = std::upper_bound(stretches_.begin(), stretches_.end(), t,
                                [](double value, const Stretch& stretch) { return value < stretch.t.lo; });
  if (found != stretches_.begin()) --found;
  return std::clamp((found->begin + found->length_to(t)) / length_, 0.0, 1.0);
}

std::vector<double> parameters_at_even_lengths(const ArcFraction& lengths, const Interval& domain, int parts) {
  std::vector<double> result{domain.lo};
  for (int i = 1; i < parts; ++i) {
    Interval t(result.back(), domain.hi);
    // The fraction grows with t: halves down to neighbouring numbers.
    for (double middle = t.middle(); t.lo < middle && middle < t.hi; middle = t.middle())
      (lengths.at(middle) * parts < i ? t.lo : t.hi) = middle;
    result.push_back(t.hi);
  }
  result.push_back(domain.hi);
  return result;
}

}  // namespace lekalo::geometry
