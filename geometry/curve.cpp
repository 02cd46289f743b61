#include "geometry/curve.h"

#include <cmath>

#include "geometry/tolerances.h"

namespace lekalo::geometry {

double ParameterMap::natural(double s) const {
  if (kind == Kind::affine || s == lo || s == hi) return s;
  const double d = hi - lo;
  const double x = ((s - lo) - (hi - s)) / d;
  const double middle = 0.5 * (lo + hi);
  return kind == Kind::half_angle ? middle + 2 * std::atan(std::tan(d / 4) * x)
                                  : middle + 2 * std::atanh(std::tanh(d / 4) * x);
}

double ParameterMap::rational(double t) const {
  if (kind == Kind::affine || t == lo || t == hi) return t;
  const double d = hi - lo;
  const double middle = 0.5 * (lo + hi);
  const double half = 0.5 * (t - middle);
  const double x = kind == Kind::half_angle ? std::tan(half) / std::tan(d / 4) : std::tanh(half) / std::tanh(d / 4);
  return middle + 0.5 * d * x;
}

double ParameterMap::derivative(double s) const {
  if (kind == Kind::affine) return 1;
  const double d = hi - lo;
  const double x = ((s - lo) - (hi - s)) / d;
  if (kind == Kind::half_angle) {
    const double tangent = std::tan(d / 4);
    return 4 * tangent / (d * (1 + tangent * tangent * x * x));
  }
  const double tangent = std::tanh(d / 4);
  return 4 * tangent / (d * (1 - tangent * tangent * x * x));
}

double ParameterMap::natural_of_bezier(double x) const {
  const double q = affine_mix(1 - x, from, x, to);
  return natural(affine_mix(1 - q, lo, q, hi));
}

double ParameterMap::bezier(double t) const {
  const double q = (rational(t) - lo) / (hi - lo);
  return (q - from) / (to - from);
}

double ParameterMap::derivative_of_bezier(double x) const {
  const double q = affine_mix(1 - x, from, x, to);
  return derivative(affine_mix(1 - q, lo, q, hi)) * (hi - lo) * (to - from);
}

ParameterMap ParameterMap::cut(double t0, double t1) const {
  ParameterMap result = *this;
  if (kind == Kind::affine) {
    result.lo = t0;
    result.hi = t1;
    return result;
  }
  result.from = (rational(t0) - lo) / (hi - lo);
  result.to = (rational(t1) - lo) / (hi - lo);
  return result;
}

bool Curve::is_closed() const {
  const Interval range = domain();
  if (!(range.lo > -kInfinity && range.hi < kInfinity)) return false;
  if (period() > 0) return range.width() >= period() * (1 - kDomainSlack);
  double size = bounds(*this).diameter();
  if (!(size < kInfinity)) {  // its boxes tell nothing: some of its points do
    constexpr int kTried = 64;
    Box3 box;
    for (int i = 0; i <= kTried; ++i) box.include(point(range.lo + range.width() * i / kTried));
    size = box.diameter();
  }
  return size > 0 && glm::length(point(range.hi) - point(range.lo)) <= kClosedCurve * size;
}

void Curve::evaluate_many(std::span<const double> t, int order, std::span<CurveJet> result) const {
  for (size_t i = 0; i < t.size(); ++i) result[i] = evaluate(t[i], order);
}

std::vector<CurvePiece> Curve::pieces() const {
  if (const auto form = as_nurbs()) return bezier_pieces(*form, domain());
  CurvePiece piece;
  piece.domain = domain();
  piece.map = {ParameterMap::Kind::affine, piece.domain.lo, piece.domain.hi};
  return {piece};
}

bool control_point_box(std::span<const Vec4> points, Box3& box) {
  Box3 hull;
  for (const Vec4& p : points) {
    if (!(p.w > 0)) return false;
    hull.include(Vec3(p) / p.w);
  }
  // The points themselves carry a few rounding errors of their largest coordinate.
  const Vec3 slack = 8 * std::numeric_limits<double>::epsilon() * glm::max(glm::abs(hull.lo), glm::abs(hull.hi));
  box = {hull.lo - slack, hull.hi + slack};
  return true;
}

Box3 bounds(const Curve& curve) {
  Box3 box;
  for (const CurvePiece& piece : curve.pieces()) {
    Box3 part;
    if (!piece.is_rational() || !control_point_box(piece.points, part)) part = curve.enclose(piece.domain, 0).d[0];
    box.include(part);
  }
  return box;
}

}  // namespace lekalo::geometry
