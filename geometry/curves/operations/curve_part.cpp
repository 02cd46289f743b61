#include "geometry/curves/operations/curve_part.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/curves/operations/curve_parts.h"

namespace lekalo::geometry {

namespace {

// Of the curve's size: what changes by more from one number to the next is a step. A cube root changes by less.
constexpr double kStep = 1e-5;
constexpr double kMinPart = 1e-12;

// The median of distances from the first point: poles do not count.
double usual_size(const Curve& curve) {
  constexpr int kTried = 64;
  const Interval domain = curve.domain();
  const Vec3 first = curve.point(domain.lo);
  std::vector<double> distances;
  for (int i = 1; i <= kTried; ++i)
    if (const double d = glm::length(curve.point(domain.lo + domain.width() * i / kTried) - first); std::isfinite(d))
      distances.push_back(d);
  if (distances.empty()) return 0;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

}  // namespace

CurvePart::CurvePart(CurvePtr of, const Interval& range) : of_(std::move(of)), range_(range) {
  if (!(range.width() > 0) || !of_->domain().contains(range))
    throw std::invalid_argument("the part lies outside of the curve");
}

std::vector<CurvePiece> CurvePart::pieces() const {
  if (const auto form = as_nurbs()) return bezier_pieces(*form, range_);
  std::vector<CurvePiece> result;
  for (const Interval& part : parts_of(*of_, range_)) {
    CurvePiece piece;
    piece.domain = part;
    piece.map = {ParameterMap::Kind::affine, part.lo, part.hi};
    result.push_back(piece);
  }
  return result;
}

CurvePtr curve_over(const CurvePtr& curve, const Interval& range) {
  return range == curve->domain() ? curve : std::make_shared<CurvePart>(curve, range);
}

std::vector<CurvePtr> unbroken_parts(const CurvePtr& curve) {
  const Interval domain = curve->domain();
  const double step = kStep * usual_size(*curve);
  const auto jumps = [&](double a, double b) { return !(glm::length(curve->point(b) - curve->point(a)) <= step); };
  const auto jumps_before = [&](double t) { return jumps(next_down(t), t); };
  const auto jumps_after = [&](double t) { return jumps(t, next_up(t)); };
  std::vector<Interval> parts;
  for (const CurvePiece& piece : curve->pieces()) {
    const Interval t = piece.domain;
    if (!parts.empty() && parts.back().hi == t.lo && !jumps_before(t.lo) && !jumps_after(t.lo))
      parts.back().hi = t.hi;
    else
      parts.push_back(t);
  }
  std::vector<CurvePtr> result;
  for (Interval& t : parts) {
    if (jumps_after(t.lo)) t.lo = next_up(t.lo);
    if (jumps_before(t.hi)) t.hi = next_down(t.hi);
    if (t == domain) return {curve};
    if (t.width() > kMinPart * domain.width()) result.push_back(std::make_shared<CurvePart>(curve, t));
  }
  return result;
}

}  // namespace lekalo::geometry
