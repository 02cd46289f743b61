// Curves and surfaces made of other curves and surfaces by one formula, written once over numbers, jets and intervals:
//
//   struct Shifted {                                    c(t) + d
//     CurvePtr of;
//     Vec3 by;
//     template <class T>
//     Triple<T> operator()(const T& t) const { return curve_at(*of, t) + triple(by); }
//   };
//
// What a formula asks of an operand is the operand's Taylor polynomial (or enclosures of its coefficients), with the
// Taylor polynomial of the argument for its variable: the chain rule of all orders (Faa di Bruno; Griewank, Walther
// 2008, 13). Enclosures are in mean-value form: composed of enclosures alone they would be wide by a share of the
// interval's width (Neumaier 1990, 2.3).
//
// A formula that asks for the k-th derivative of an operand has k orders less than the operand. Derivatives beyond are
// NaN, enclosures of them the entire line.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/formula.h"
#include "geometry/grid_points.h"
#include "geometry/numerics/halving.h"
#include "geometry/surface_series.h"

namespace lekalo::geometry {

namespace detail {

constexpr double factorial(int n) { return n <= 1 ? 1 : n * factorial(n - 1); }

inline double unknown(double) { return std::numeric_limits<double>::quiet_NaN(); }
inline Interval unknown(const Interval&) { return Interval::entire(); }

inline Triple<double> derivative_of(const CurveJet& jet, int k) { return triple(jet.d[k]); }
inline Triple<Interval> derivative_of(const CurveEnclosure& boxes, int k) { return triple(boxes.d[k]); }

// What is known of the operand at a number, or over an interval: rounding may have led out of the domain.
inline CurveJet known_at(const Curve& curve, double t, int order) { return curve.evaluate(t, order); }
inline CurveEnclosure known_at(const Curve& curve, const Interval& t, int order) {
  const Interval domain = curve.domain();
  return curve.enclose({domain.clamp(t.lo), domain.clamp(t.hi)}, order);
}
inline SurfaceJet known_at(const Surface& surface, double u, double v, int order) {
  return surface.evaluate(u, v, order);
}
inline SurfaceEnclosure known_at(const Surface& surface, const Interval& u, const Interval& v, int order) {
  const Rectangle domain = surface.domain();
  return surface.enclose({{domain.u.clamp(u.lo), domain.u.clamp(u.hi)}, {domain.v.clamp(v.lo), domain.v.clamp(v.hi)}},
                         order);
}
inline int known_order(const Curve& curve, double) { return curve.max_order(); }
inline int known_order(const Curve& curve, const Interval&) { return curve.enclosure_order(); }
inline int known_order(const Surface& surface, double) { return surface.max_order(); }
inline int known_order(const Surface& surface, const Interval&) { return surface.enclosure_order(); }

// The Taylor coefficients of the k-th derivative of the curve about t.
template <class S, int N>
Triple<Jet<S, N>> series_of(const Curve& curve, const S& t, int k) {
  const int order = std::min(N + k, known_order(curve, t));
  const auto known = known_at(curve, t, order);
  Triple<Jet<S, N>> result;
  for (int n = 0; n <= N; ++n) {
    const bool is_known = n + k <= order;
    const Triple<S> d = is_known ? derivative_of(known, n + k) : Triple<S>{unknown(t), unknown(t), unknown(t)};
    const S factor = S(1) / S(factorial(n));
    result.x.c[n] = factor * d.x, result.y.c[n] = factor * d.y, result.z.c[n] = factor * d.z;
  }
  return result;
}

// The first coefficient of a degree.
template <class S, int N>
int first_of_degree(const Jet<S, N>&, int degree) {
  return degree;
}
template <class S, int N>
int first_of_degree(const Jet2<S, N>&, int degree) {
  return Jet2<S, N>::index(degree, 0);
}

template <class S, int N>
bool is_variable(const Jet<S, N>& t) {
  for (int k = 1; k <= N; ++k)
    if (!(t.c[k] == S(k == 1 ? 1 : 0))) return false;
  return true;
}

template <class S, int N>
Jet<S, N> composed(const Jet<S, N>& series, const Jet<S, N>& t) {
  return is_variable(t) ? series : Jet<S, N>::composed(series, t);
}
template <class S, int N>
Jet2<S, N> composed(const Jet<S, N>& series, const Jet2<S, N>& t) {
  return Jet2<S, N>::apply([&](const Jet<S, N>& x) { return composed(series, x); }, t);
}

template <class S>
Triple<S> at(const Curve& curve, const S& t, int k) {
  if (k > known_order(curve, t)) return {unknown(t), unknown(t), unknown(t)};
  return derivative_of(known_at(curve, t, k), k);
}

// Whether they are u and v themselves.
template <class S, int N>
bool are_variables(const Jet2<S, N>& u, const Jet2<S, N>& v) {
  for (int k = 1; k < Jet2<S, N>::kCount; ++k)
    if (!(u.c[k] == S(k == 1 ? 1 : 0) && v.c[k] == S(k == 2 ? 1 : 0))) return false;
  return true;
}
template <class S, int N>
bool are_variables(const Jet<S, N>&, const Jet<S, N>&) {
  return false;
}

template <template <class, int> class J, class S, int N>
Triple<J<S, N>> at(const Curve& curve, const J<S, N>& t, int k) {
  const auto series = series_of<S, N>(curve, t.value(), k);
  return {composed(series.x, t), composed(series.y, t), composed(series.z, t)};
}

template <class S>
Triple<S> at(const Surface& surface, const S& u, const S& v, int i, int j) {
  if (i + j > known_order(surface, u)) return {unknown(u), unknown(u), unknown(u)};
  return geometry::derivative_of(known_at(surface, u, v, i + j), i, j);
}
template <template <class, int> class J, class S, int N>
Triple<J<S, N>> at(const Surface& surface, const J<S, N>& u, const J<S, N>& v, int i, int j) {
  const int order = std::min(N + i + j, known_order(surface, u.value()));
  const auto known = known_at(surface, u.value(), v.value(), order);
  // The Taylor coefficient a times by u and b times by v.
  const auto coefficient = [&](int a, int b) -> Triple<S> {
    const S none = unknown(u.value());
    if (a + b + i + j > order) return {none, none, none};
    return (S(1) / S(factorial(a) * factorial(b))) * geometry::derivative_of(known, i + a, j + b);
  };
  Triple<J<S, N>> sum;
  // What is unknown is so of its order and those above alone.
  const auto add = [&](const Triple<S>& d, const J<S, N>& term, int first, int last) {
    for (int k = first; k <= last; ++k)
      sum.x.c[k] += term.c[k] * d.x, sum.y.c[k] += term.c[k] * d.y, sum.z.c[k] += term.c[k] * d.z;
  };
  const bool plain = are_variables(u, v);
  J<S, N> du = u, dv = v, power_u(S(1));
  du.c[0] = dv.c[0] = S(0);
  for (int a = 0; a <= N; ++a) {
    J<S, N> power = power_u;
    for (int b = 0; a + b <= N; ++b) {
      const int first = first_of_degree(power, a + b) + (plain ? b : 0);
      add(coefficient(a, b), power, first, plain ? first : J<S, N>::kCount - 1);
      if (a + b < N) power = power * dv;
    }
    if (a < N) power_u = power_u * du;
  }
  return sum;
}

}  // namespace detail

// The point of a curve, or its derivative of order k, for a parameter of any number type: double, Interval, Jet, Jet2.
template <class T>
Triple<T> curve_at(const Curve& curve, const T& t, int k = 0) {
  return detail::at(curve, t, k);
}

// The point of a surface, or its derivative i times by u and j times by v.
template <class T>
Triple<T> surface_at(const Surface& surface, const T& u, const T& v, int i = 0, int j = 0) {
  return detail::at(surface, u, v, i, j);
}

namespace detail {

template <int N, class Formula>
void enclosure_of_order(const Formula& formula, const Rectangle& box, SurfaceEnclosure& result) {
  if constexpr (N == 0) {
    const Triple<Interval> r = formula(box.u, box.v);
    result.values[0] = geometry::box_of(r);
  } else {
    surface_enclosure<N>(formula, box, result);
  }
}

// Mean values of all derivatives up to `order`, from the highest on: f(B) in f(m) + f_u(B) (u - m_u) + f_v(B) (v -
// m_v). kWide is above the order, kMiddle at least it.
template <int kWide, int kMiddle, class Formula>
SurfaceEnclosure mean_values(const Formula& formula, const Rectangle& box, int order) {
  SurfaceEnclosure result, at;
  enclosure_of_order<kWide>(formula, box, result);
  const Interval u(box.u.middle()), v(box.v.middle()), off_u = box.u - u, off_v = box.v - v;
  enclosure_of_order<kMiddle>(formula, {u, v}, at);
  for (int n = order; n >= 0; --n)
    for (int j = 0; j <= n; ++j) {
      Box3& value = result.values[SurfaceJet::index(n - j, j)];
      const auto change = off_u * triple(result.d(n - j + 1, j)) + off_v * triple(result.d(n - j, j + 1));
      value = narrowed(value, triple(at.d(n - j, j)) + change);
    }
  return result;
}

template <class Formula>
SurfaceEnclosure mean_values(const Formula& formula, const Rectangle& box, int order, int known) {
  if (order == 0) return mean_values<1, 0>(formula, box, 0);
  if (order == 1) return mean_values<2, 1>(formula, box, 1);
  if (order == 2 && known > 2) return mean_values<kMaxSurfaceOrder, 2>(formula, box, 2);
  if (order == 2) return mean_values<2, 1>(formula, box, 1);  // with the second derivatives as they are
  return mean_values<kMaxSurfaceOrder, kMaxSurfaceOrder - 1>(formula, box, kMaxSurfaceOrder - 1);
}

}  // namespace detail

// What a composed curve has from its operands.
struct CurveProperties {
  Interval domain;
  double period = 0;
  std::vector<double> breaks;  // of smoothness, ends of the domain included
  int max_order = kMaxCurveOrder;
  int enclosure_order = kMaxCurveEnclosureOrder;
};

// As the operand has it over a part of its domain, where the formula asks for derivatives up to `derivatives`.
CurveProperties properties_of(const Curve& operand, int derivatives = 0);
// Of another operand at the same parameter, whose breaks and orders count too.
void add_operand(CurveProperties& properties, const Curve& operand, int derivatives = 0);
// Over a part of the domain, or beyond it.
void cut_to(CurveProperties& properties, const Interval& domain);

namespace detail {

// Over a long stretch the bounds of a quotient or a root may be infinite, or enormous, where those of its parts are
// not: stretches down to this part of the domain are taken in halves then.
constexpr double kMinHalved = 1.0 / 32;
constexpr double kEnormous = 8;  // times the size
constexpr double kCoarse = 0.2;  // of the domain

// The parameter in the domain where that is a period: operands need not have this one.
inline double inside(double t, const Interval& domain, double period) {
  if (period == 0 || domain.contains(t) || std::abs(period - domain.width()) > 1e-12 * period) return t;
  return t - period * std::floor((t - domain.lo) / period);
}

// An interval in the parts between breaks.
std::vector<Interval> between(const std::vector<double>& breaks, const Interval& t);
CurvePiece plain_curve_piece(const Interval& domain);
std::vector<SurfacePiece> plain_pieces(const std::vector<double>& breaks_u, const std::vector<double>& breaks_v);

}  // namespace detail

// Formula: a struct with `template <class T> Triple<T> operator()(const T& t) const`, and `as_nurbs()` where it knows
// an exact form.
template <class Formula>
class ComposedCurve final : public Curve {
 public:
  ComposedCurve(Formula formula, CurveProperties properties)
      : formula_(std::move(formula)),
        properties_(std::move(properties)),
        size_(sampled_size(*this, properties_.domain)) {}

  const Formula& formula() const { return formula_; }

  Interval domain() const override { return properties_.domain; }
  double period() const override { return properties_.period; }
  CurveJet evaluate(double t, int order) const override {
    return evaluate_curve_formula(formula_, detail::inside(t, properties_.domain, properties_.period), order);
  }
  int max_order() const override { return properties_.max_order; }
  CurveEnclosure enclose(const Interval& t, int order) const override;
  int enclosure_order() const override { return properties_.enclosure_order; }
  std::vector<CurvePiece> pieces() const override;
  std::optional<NurbsCurveForm> as_nurbs() const override {
    if constexpr (requires { formula_.as_nurbs(); }) return formula_.as_nurbs();
    return std::nullopt;
  }

 private:
  Formula formula_;
  CurveProperties properties_;
  double size_;
};

struct SurfaceProperties {
  Rectangle domain;
  Periods periods;
  std::vector<double> breaks_u, breaks_v;  // lines of kinks and the borders of the domain
  int max_order = kMaxSurfaceOrder;
  int enclosure_order = kMaxSurfaceOrder;
};

// Of a surface, as above.
SurfaceProperties properties_of(const Surface& operand, int derivatives = 0);
// Of a curve whose parameter is u, and v in a range without breaks.
SurfaceProperties properties_along_u(const Curve& operand, const Interval& v, int derivatives = 0);
enum class Along { u, v };
void add_operand(SurfaceProperties& properties, const Curve& operand, Along along, int derivatives = 0);

// What is found by looking at points of a grid: the edges of the domain that are points, and the size. Throws
// FieldError (field of) where there is none.
struct SampledShape {
  DegenerateEdges degenerate;
  double size = 0;
};
SampledShape sampled_shape(const Surface& surface, const Rectangle& domain);
// Whether the surface goes on at the end of u, or v, as it begins: points and first derivatives are the same, looked at
// in some places.
bool is_closed_along(const Surface& surface, Along along);
double sampled_size(const Curve& curve, const Interval& domain);

// One form of patches over the cells of a grid, u outer, all of one degree: knots of that multiplicity at its lines.
// None if they are not rational, or do not share the weights along the lines.
std::optional<NurbsSurfaceForm> form_of_pieces(const std::vector<SurfacePiece>& pieces,
                                               const std::vector<double>& lines_u, const std::vector<double>& lines_v);

// Formula: a struct with `template <class T> Triple<T> operator()(const T& u, const T& v) const`, and
// `rational_pieces(breaks_u, breaks_v)`, u outer, where it may know patches (none: it does not), and
// `points_over_grid(u, v)` where a grid costs less than its points.
template <class Formula>
class ComposedSurface final : public Surface, public GridPoints {
 public:
  ComposedSurface(Formula formula, SurfaceProperties properties)
      : formula_(std::move(formula)), properties_(std::move(properties)) {
    if constexpr (requires { formula_.rational_pieces(properties_.breaks_u, properties_.breaks_v); })
      pieces_ = formula_.rational_pieces(properties_.breaks_u, properties_.breaks_v);
    if (pieces_.empty()) pieces_ = detail::plain_pieces(properties_.breaks_u, properties_.breaks_v);
    shape_ = sampled_shape(*this, properties_.domain);
  }

  const Formula& formula() const { return formula_; }
  // From now on it goes on at the end as it begins, with this period (is_closed_along says whether it does).
  void close(Along along, double period) {
    (along == Along::u ? properties_.periods.u : properties_.periods.v) = period;
  }

  Rectangle domain() const override { return properties_.domain; }
  Periods periods() const override { return properties_.periods; }
  SurfaceJet evaluate(double u, double v, int order) const override {
    return evaluate_surface_formula(formula_, detail::inside(u, properties_.domain.u, properties_.periods.u),
                                    detail::inside(v, properties_.domain.v, properties_.periods.v), order);
  }
  std::vector<Vec3> points_over_grid(std::vector<double> u, std::vector<double> v) const override;
  int max_order() const override { return properties_.max_order; }
  SurfaceEnclosure enclose(const Rectangle& box, int order) const override;
  int enclosure_order() const override { return properties_.enclosure_order; }
  bool is_composed() const override { return true; }
  std::vector<SurfacePiece> pieces() const override { return pieces_; }
  std::optional<NurbsSurfaceForm> as_nurbs() const override {
    return form_of_pieces(pieces_, properties_.breaks_u, properties_.breaks_v);
  }
  DegenerateEdges degenerate_edges() const override { return shape_.degenerate; }

 private:
  Formula formula_;
  SurfaceProperties properties_;
  std::vector<SurfacePiece> pieces_;
  SampledShape shape_;
};

template <class Formula>
CurveEnclosure ComposedCurve<Formula>::enclose(const Interval& t, int order) const {
  // Mean values hold where the derivative is one.
  CurveEnclosure result;
  for (const Interval& part : detail::between(properties_.breaks, t)) {
    const CurveEnclosure boxes = enclose_curve_centered(formula_, part, order);
    bool is_bounded = boxes.d[0].diameter() <= detail::kEnormous * size_;
    for (int k = 0; k <= order; ++k) is_bounded = is_bounded && boxes.d[k].bounded();
    if (!is_bounded && part.width() > detail::kMinHalved * properties_.domain.width())
      for (const Interval& half : {Interval(part.lo, part.middle()), Interval(part.middle(), part.hi)}) {
        const CurveEnclosure some = enclose(half, order);
        for (int k = 0; k <= order; ++k) result.d[k].include(some.d[k]);
      }
    else
      for (int k = 0; k <= order; ++k) result.d[k].include(boxes.d[k]);
  }
  return result;
}

template <class Formula>
std::vector<CurvePiece> ComposedCurve<Formula>::pieces() const {
  if (const auto form = as_nurbs()) return bezier_pieces(*form, properties_.domain);
  std::vector<CurvePiece> result;
  for (const Interval& part : detail::between(properties_.breaks, properties_.domain))
    result.push_back(detail::plain_curve_piece(part));
  return result;
}

template <class Formula>
std::vector<Vec3> ComposedSurface<Formula>::points_over_grid(std::vector<double> u, std::vector<double> v) const {
  if constexpr (requires { formula_.points_over_grid(u, v); }) {
    for (double& one : u) one = detail::inside(one, properties_.domain.u, properties_.periods.u);
    for (double& one : v) one = detail::inside(one, properties_.domain.v, properties_.periods.v);
    return formula_.points_over_grid(u, v);
  }
  std::vector<Vec3> points;
  points.reserve(u.size() * v.size());
  for (const double at_u : u)
    for (const double at_v : v) points.push_back(point(at_u, at_v));
  return points;
}

template <class Formula>
SurfaceEnclosure ComposedSurface<Formula>::enclose(const Rectangle& box, int order) const {
  SurfaceEnclosure result;
  for (const Interval& u : detail::between(properties_.breaks_u, box.u))
    for (const Interval& v : detail::between(properties_.breaks_v, box.v)) {
      const SurfaceEnclosure boxes = detail::mean_values(formula_, {u, v}, order, properties_.enclosure_order);
      const int count = SurfaceJet::index(0, order) + 1;
      const bool is_bounded = boxes.values[0].diameter() <= detail::kEnormous * shape_.size &&
                              std::all_of(boxes.values.begin(), boxes.values.begin() + count,
                                          [](const Box3& value) { return value.bounded(); });
      const double share_u = u.width() / properties_.domain.u.width(),
                   share_v = v.width() / properties_.domain.v.width();
      // Points alone are asked for of whole surfaces: a box of the parts is much narrower.
      const bool is_coarse = order == 0 && std::max(share_u, share_v) > detail::kCoarse;
      if ((is_bounded && !is_coarse) || !(std::max(share_u, share_v) > detail::kMinHalved)) {
        for (int k = 0; k < count; ++k) result.values[k].include(boxes.values[k]);
        continue;
      }
      const bool across_u = share_u >= share_v;
      for (const bool upper : {false, true}) {
        Rectangle half{u, v};
        Interval& side = across_u ? half.u : half.v;
        (upper ? side.lo : side.hi) = side.middle();
        const SurfaceEnclosure some = enclose(half, order);
        for (int k = 0; k < count; ++k) result.values[k].include(some.values[k]);
      }
    }
  return result;
}

}  // namespace lekalo::geometry
