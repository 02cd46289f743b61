// Curves and surfaces given by a formula that is written once over a number type: the same lines of code give points
// (double), derivatives (jets) and certified enclosures (jets of intervals).
#pragma once

#include "geometry/curve.h"
#include "geometry/numerics/jet.h"
#include "geometry/numerics/jet2.h"
#include "geometry/numerics/triple.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

inline Triple<double> triple(const Vec3& v) { return {v.x, v.y, v.z}; }
inline Box3 box_of(const Triple<Interval>& r) { return {{r.x.lo, r.y.lo, r.z.lo}, {r.x.hi, r.y.hi, r.z.hi}}; }
inline Triple<Interval> triple(const Box3& b) {
  return {Interval(b.lo.x, b.hi.x), Interval(b.lo.y, b.hi.y), Interval(b.lo.z, b.hi.z)};
}

namespace detail {

template <int N, class Formula>
void curve_jet(const Formula& formula, double t, CurveJet& result) {
  const auto r = formula(Jet<double, N>::variable(t));
  for (int k = 0; k <= N; ++k) result.d[k] = {r.x.derivative(k), r.y.derivative(k), r.z.derivative(k)};
}

template <int N, class Formula>
void surface_jet(const Formula& formula, double u, double v, SurfaceJet& result) {
  const auto r = formula(Jet2<double, N>::u_variable(u), Jet2<double, N>::v_variable(v));
  for (int n = 0; n <= N; ++n)
    for (int j = 0; j <= n; ++j)
      result.d(n - j, j) = {r.x.derivative(n - j, j), r.y.derivative(n - j, j), r.z.derivative(n - j, j)};
}

inline Box3 box_of(const Interval& x, const Interval& y, const Interval& z) {
  return {{x.lo, y.lo, z.lo}, {x.hi, y.hi, z.hi}};
}

template <int N, class Formula>
void surface_enclosure(const Formula& formula, const Rectangle& box, SurfaceEnclosure& result) {
  const auto r = formula(Jet2<Interval, N>::u_variable(box.u), Jet2<Interval, N>::v_variable(box.v));
  for (int n = 0; n <= N; ++n)
    for (int j = 0; j <= n; ++j)
      result.values[SurfaceJet::index(n - j, j)] =
          box_of(r.x.derivative(n - j, j), r.y.derivative(n - j, j), r.z.derivative(n - j, j));
}

template <int N, class Formula>
void curve_enclosure(const Formula& formula, const Interval& t, CurveEnclosure& result) {
  const auto r = formula(Jet<Interval, N>::variable(t));
  for (int k = 0; k <= N; ++k) result.d[k] = box_of(r.x.derivative(k), r.y.derivative(k), r.z.derivative(k));
}

// What both know of a value.
inline Box3 narrowed(const Box3& wide, const Triple<Interval>& other) {
  const Triple<Interval> r = triple(wide);
  return box_of(intersect(r.x, other.x), intersect(r.y, other.y), intersect(r.z, other.z));
}

}  // namespace detail

// formula: any number type T -> Triple<T>.
template <class Formula>
CurveJet evaluate_curve_formula(const Formula& formula, double t, int order) {
  CurveJet result;
  result.order = order;
  switch (order) {
    case 0: {
      const Triple<double> r = formula(t);
      result.d[0] = {r.x, r.y, r.z};
      break;
    }
    case 1:
      detail::curve_jet<1>(formula, t, result);
      break;
    case 2:
      detail::curve_jet<2>(formula, t, result);
      break;
    case 3:
      detail::curve_jet<3>(formula, t, result);
      break;
    default:
      detail::curve_jet<kMaxCurveOrder>(formula, t, result);
      break;
  }
  return result;
}

template <class Formula>
CurveEnclosure enclose_curve_formula(const Formula& formula, const Interval& t, int order) {
  CurveEnclosure result;
  if (order == 0) {
    const Triple<Interval> r = formula(t);
    result.d[0] = detail::box_of(r.x, r.y, r.z);
  } else if (order <= 2) {
    detail::curve_enclosure<2>(formula, t, result);
  } else {
    detail::curve_enclosure<kMaxCurveEnclosureOrder>(formula, t, result);
  }
  return result;
}

// The same in centered form for point and first derivative, f(T) in f(m) + f'(T) (T - m): where a formula names its
// variable several times the plain one is too wide by a share of T's width, this one by its square.
template <class Formula>
CurveEnclosure enclose_curve_centered(const Formula& formula, const Interval& t, int order) {
  CurveEnclosure result = enclose_curve_formula(formula, t, std::max(order, 1)), at;
  const Interval middle(t.middle()), off = t - middle;
  detail::curve_enclosure<1>(formula, middle, at);
  for (int k = 0; k <= std::min(order, 1); ++k)
    result.d[k] = detail::narrowed(result.d[k], triple(at.d[k]) + off * triple(result.d[k + 1]));
  return result;
}

// formula: (T u, T v) -> Triple<T>.
template <class Formula>
SurfaceJet evaluate_surface_formula(const Formula& formula, double u, double v, int order) {
  SurfaceJet result;
  result.order = order;
  switch (order) {
    case 0: {
      const Triple<double> r = formula(u, v);
      result.values[0] = {r.x, r.y, r.z};
      break;
    }
    case 1:
      detail::surface_jet<1>(formula, u, v, result);
      break;
    case 2:
      detail::surface_jet<2>(formula, u, v, result);
      break;
    default:
      detail::surface_jet<kMaxSurfaceOrder>(formula, u, v, result);
      break;
  }
  return result;
}

template <class Formula>
SurfaceEnclosure enclose_surface_formula(const Formula& formula, const Rectangle& box, int order) {
  SurfaceEnclosure result;
  if (order == 0) {
    const Triple<Interval> r = formula(box.u, box.v);
    result.values[0] = detail::box_of(r.x, r.y, r.z);
  } else {
    order <= 2 ? detail::surface_enclosure<2>(formula, box, result)
               : detail::surface_enclosure<kMaxSurfaceOrder>(formula, box, result);
  }
  return result;
}

template <class Formula>
SurfaceEnclosure enclose_surface_centered(const Formula& formula, const Rectangle& box, int order) {
  SurfaceEnclosure result, at;
  const bool is_place = box.u.width() == 0 && box.v.width() == 0;
  if (order == 0 || (is_place && order == 1))
    detail::surface_enclosure<1>(formula, box, result);
  else if (order <= 2)
    detail::surface_enclosure<2>(formula, box, result);
  else
    detail::surface_enclosure<kMaxSurfaceOrder>(formula, box, result);
  if (is_place) return result;
  const Interval u(box.u.middle()), v(box.v.middle()), off_u = box.u - u, off_v = box.v - v;
  if (order == 0) {
    const Triple<Interval> r = formula(u, v);
    at.values[0] = detail::box_of(r.x, r.y, r.z);
  } else {
    detail::surface_enclosure<1>(formula, {u, v}, at);
  }
  const auto center = [&](int i, int j) {
    const int k = SurfaceJet::index(i, j);
    result.values[k] = detail::narrowed(result.values[k], triple(at.values[k]) + off_u * triple(result.d(i + 1, j)) +
                                                              off_v * triple(result.d(i, j + 1)));
  };
  if (order >= 1) {
    center(1, 0);
    center(0, 1);
  }
  center(0, 0);
  return result;
}

}  // namespace lekalo::geometry
