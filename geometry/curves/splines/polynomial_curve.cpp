#include "geometry/curves/splines/polynomial_curve.h"

namespace lekalo::geometry {

CurveJet PolynomialCurve::evaluate(double t, int order) const {
  const double inside = domain().clamp(t);
  const Part& part = part_at(parts_, inside);
  const double x = part.local(inside);
  CurveJet jet;
  jet.order = order;
  if (order == 0)
    jet.d[0] = part.value(x);
  else if (order == 1)
    part.value_and_slope(x, jet.d[0], jet.d[1]);
  else
    for (int k = 0; k <= order; ++k) jet.d[k] = part.derivative(k, x);
  if (t == inside) return jet;
  jet.d[0] += (t - inside) * part.derivative(1, x);
  for (int k = 2; k <= order; ++k) jet.d[k] = Vec3(0);
  return jet;
}

CurveEnclosure PolynomialCurve::enclose(const Interval& t, int order) const {
  CurveEnclosure result;
  // From the part where t begins, or from the one before, if t is the joint of the two.
  const Part *part = &part_at(parts_, t.lo), *const end = parts_.data() + parts_.size();
  if (part != parts_.data() && part->t.lo == t.lo) --part;
  for (; part != end && part->t.lo <= t.hi; ++part) {
    const Interval common = intersect(part->t, t);
    if (common.empty() || (common.width() == 0 && t.width() > 0)) continue;
    part->include_ranges(order, common, result.d.data());
  }
  return result;
}

std::vector<CurvePiece> PolynomialCurve::pieces() const {
  std::vector<CurvePiece> result;
  for (const Part& part : parts_) result.push_back({part.t, {ParameterMap::Kind::affine, part.t.lo, part.t.hi}, {}});
  return result;
}

}  // namespace lekalo::geometry
