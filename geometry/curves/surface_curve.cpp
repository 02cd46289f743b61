// The Taylor polynomial of S at (u, v), with the Taylor polynomials of u(t) - u and v(t) - v for its variables, cut off
// at the order asked for (the formula of Faa di Bruno). Enclosures by the chain rule:
//
//   r' = S_u u' + S_v v',  r'' = S_uu u'^2 + 2 S_uv u' v' + S_vv v'^2 + S_u u'' + S_v v''.
#include "geometry/curves/surface_curve.h"

#include <stdexcept>

namespace lekalo::geometry {

namespace {

// Coefficients of a polynomial in t - t0 up to some order.
using Series = std::array<double, kMaxSurfaceOrder + 1>;

Series product(const Series& a, const Series& b, int order) {
  Series result{};
  for (int i = 0; i <= order; ++i)
    for (int j = 0; i + j <= order; ++j) result[i + j] += a[i] * b[j];
  return result;
}

Interval part(const Box3& box, int k) { return {box.lo[k], box.hi[k]}; }

}  // namespace

CurveJet SurfaceCurve::evaluate(double t, int order) const {
  if (order > kMaxSurfaceOrder) throw std::invalid_argument("a curve on a surface has derivatives up to order 4");
  const CurveJet c = image_->evaluate(t, order);
  const SurfaceJet s = surface_->evaluate(c.d[0].x, c.d[0].y, order);
  CurveJet jet;
  jet.order = order;
  jet.d[0] = s.point();
  Series du{}, dv{};
  double factorial = 1;
  for (int k = 1; k <= order; ++k) {
    factorial *= k;
    du[k] = c.d[k].x / factorial;
    dv[k] = c.d[k].y / factorial;
  }
  // The terms S_ij du^i dv^j / (i! j!); du and dv begin with the first power.
  Series power_u{1};
  double factorial_i = 1;
  for (int i = 0; i <= order; ++i) {
    if (i > 0) {
      power_u = product(power_u, du, order);
      factorial_i *= i;
    }
    Series term = power_u;
    double factorial_j = 1;
    for (int j = 0; i + j <= order; ++j) {
      if (j > 0) {
        term = product(term, dv, order);
        factorial_j *= j;
      }
      double factorial_k = 1;
      for (int k = 1; k <= order; ++k) {
        factorial_k *= k;
        if (i + j > 0) jet.d[k] += (factorial_k * term[k] / (factorial_i * factorial_j)) * s.d(i, j);
      }
    }
  }
  return jet;
}

CurveEnclosure SurfaceCurve::enclose(const Interval& t, int order) const {
  const CurveEnclosure c = image_->enclose(t, order);
  // Boxes are a little wide.
  Rectangle place{part(c.d[0], 0), part(c.d[0], 1)};
  const Rectangle domain = surface_->domain();
  const Periods periods = surface_->periods();
  if (periods.u == 0) place.u = {domain.u.clamp(place.u.lo), domain.u.clamp(place.u.hi)};
  if (periods.v == 0) place.v = {domain.v.clamp(place.v.lo), domain.v.clamp(place.v.hi)};
  const SurfaceEnclosure s = surface_->enclose(place, order);
  CurveEnclosure result;
  result.d[0] = s.d(0, 0);
  const auto set = [](Box3& box, int k, const Interval& x) {
    box.lo[k] = x.lo;
    box.hi[k] = x.hi;
  };
  for (int k = 0; k < 3 && order >= 1; ++k) {
    const Interval u1 = part(c.d[1], 0), v1 = part(c.d[1], 1), s_u = part(s.d(1, 0), k), s_v = part(s.d(0, 1), k);
    set(result.d[1], k, s_u * u1 + s_v * v1);
    if (order < 2) continue;
    const Interval u2 = part(c.d[2], 0), v2 = part(c.d[2], 1);
    set(result.d[2], k,
        part(s.d(2, 0), k) * (u1 * u1) + Interval(2) * part(s.d(1, 1), k) * (u1 * v1) + part(s.d(0, 2), k) * (v1 * v1) +
            s_u * u2 + s_v * v2);
  }
  return result;
}

std::vector<CurvePiece> SurfaceCurve::pieces() const {
  std::vector<CurvePiece> result;
  for (const CurvePiece& piece : image_->pieces())
    result.push_back({piece.domain, {ParameterMap::Kind::affine, piece.domain.lo, piece.domain.hi}, {}});
  return result;
}

}  // namespace lekalo::geometry
