#include "geometry/curves/derived/reparametrized_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "geometry/composition.h"
#include "geometry/curves/derived/composite_curve.h"
#include "geometry/curves/operations/arc_fraction.h"
#include "geometry/curves/splines/polynomial_approximation.h"
#include "geometry/describe.h"
#include "geometry/expression/scalar_law.h"
#include "geometry/point_formulas.h"

namespace lekalo::geometry {

namespace {

// t = begin + slope (w - lo)
struct Affinely {
  CurvePtr of;
  Interval domain;  // of w
  double begin, slope;

  template <class T>
  Triple<T> operator()(const T& w) const {
    return curve_at(*of, begin + slope * (w - domain.lo));
  }
  std::optional<NurbsCurveForm> as_nurbs() const {
    auto form = of->as_nurbs();
    if (!form) return std::nullopt;
    const auto w = [this](double& t) { t = domain.lo + (t - begin) / slope; };
    for (double& knot : form->knots) w(knot);
    for (ParameterMap& map : form->maps) {
      if (map.kind != ParameterMap::Kind::affine && std::abs(slope) != 1) return std::nullopt;
      w(map.lo), w(map.hi);
      if (slope < 0) map = {map.kind, map.hi, map.lo, 1 - map.to, 1 - map.from};
    }
    if (slope < 0) {
      std::reverse(form->knots.begin(), form->knots.end());
      std::reverse(form->points.begin(), form->points.end());
      std::reverse(form->maps.begin(), form->maps.end());
    }
    // An end of the form that is an end of the domain but for rounding is so to the bit.
    const Interval all = form->domain();
    const auto snap = [&](double& t) {
      if (t == all.lo && is_near(t, domain.lo)) t = domain.lo;
      if (t == all.hi && is_near(t, domain.hi)) t = domain.hi;
    };
    for (double& knot : form->knots) snap(knot);
    for (ParameterMap& map : form->maps) snap(map.lo), snap(map.hi);
    return form;
  }

 private:
  bool is_near(double a, double b) const { return std::abs(a - b) <= 1e-14 * (domain.width() + std::abs(a)); }
};

CurvePtr affinely(const CurvePtr& of, const Interval& domain, double begin, double slope) {
  CurveProperties properties = properties_of(*of);
  for (double& t : properties.breaks) t = domain.lo + (t - begin) / slope;
  std::sort(properties.breaks.begin(), properties.breaks.end());
  cut_to(properties, domain);
  properties.period = of->period() / std::abs(slope);
  return std::make_shared<ComposedCurve<Affinely>>(Affinely{of, domain, begin, slope}, properties);
}

// Where one parameter passes the ends and breaks of a curve, and where the other does, increasing both. Rounding must
// not lead over one: behind it, or behind the end of a closed curve, another piece has other derivatives.
struct Stations {
  std::vector<double> w, t;

  // The same value of t, in the piece of that of w.
  double within(double value, double at) const {
    if (!(w.front() <= at && at <= w.back())) return value;
    const size_t end = std::upper_bound(w.begin() + 1, w.end() - 1, at) - w.begin();
    const bool is_last = end + 1 == w.size();
    return std::clamp(value, t[end - 1], std::max(t[end - 1], is_last ? t[end] : next_down(t[end])));
  }
  Interval within(const Interval& values, const Interval& range) const {
    if (!(w.front() <= range.lo && range.hi <= w.back())) return values;
    const double lo = *(t.begin() + (std::upper_bound(w.begin() + 1, w.end() - 1, range.lo) - w.begin() - 1));
    const double hi = *(t.begin() + (std::lower_bound(w.begin() + 1, w.end() - 1, range.hi) - w.begin()));
    const Interval pieces(lo, std::max(lo, hi));
    return {pieces.clamp(values.lo), pieces.clamp(values.hi)};
  }
  template <class S, int N>
  Jet<S, N> within(Jet<S, N> value, const Jet<S, N>& at) const {
    value.c[0] = within(value.c[0], at.c[0]);
    return value;
  }
};

// t = law(w), a curve or formulas whose first coordinate is meant.
template <class Law>
struct ByLaw {
  CurvePtr of;
  Law law;
  Stations stations;
  template <class T>
  Triple<T> operator()(const T& w) const {
    return curve_at(*of, stations.within(law(w), w));
  }
};

struct CurveLaw {
  std::shared_ptr<const Curve> curve;
  template <class T>
  T operator()(const T& w) const {
    return curve_at(*curve, w).x;
  }
};

// Where the law passes the operand's ends and breaks: it increases.
Stations stations_of(const std::function<double(double)>& law, const Interval& domain,
                     const std::vector<double>& breaks) {
  const Interval all(breaks.front(), breaks.back());
  Stations result{{domain.lo}, {all.clamp(law(domain.lo))}};
  for (const double t : breaks) {
    double lo = domain.lo, hi = domain.hi;
    if (!(law(lo) < t && t < law(hi))) continue;
    while (true) {
      const double middle = 0.5 * (lo + hi);
      if (!(lo < middle && middle < hi)) break;
      (law(middle) < t ? lo : hi) = middle;
    }
    result.w.push_back(hi), result.t.push_back(t);
  }
  result.w.push_back(domain.hi), result.t.push_back(all.clamp(law(domain.hi)));
  return result;
}

// Places where a law is tried.
constexpr int kTried = 256;

CurvePtr by_formula(const CurvePtr& of, const ScalarLaw& law, const Interval& domain) {
  const auto at = [&](double w) { return law(w); };
  double before = -kInfinity;
  for (int i = 0; i <= kTried; ++i) {
    const double w = i == kTried ? domain.hi : domain.lo + domain.width() * i / kTried, t = at(w);
    if (!std::isfinite(t))
      throw FieldError("parameter", fmt::format("the formula has no value at w = {:.6g}", w),
                       "give a domain in which it has");
    if (!(t > before))
      throw FieldError("parameter", fmt::format("the formula does not increase at w = {:.6g}", w),
                       "a parameter must run one way; 'reversed_curve' turns a curve round");
    const Interval all = of->domain();
    const double slack = 1e-12 * all.width();
    if (!(all.lo - slack <= t && t <= all.hi + slack))
      throw FieldError(
          "parameter",
          fmt::format("w = {:.6g} gives t = {:.6g}, outside of the curve's {:.6g} to {:.6g}", w, t, all.lo, all.hi),
          "trimmed_curve takes parts of a closed curve over its seam");
    before = t;
  }
  CurveProperties properties = properties_of(*of);
  Stations stations = stations_of(at, domain, properties.breaks);
  properties.breaks = stations.w;
  properties.domain = domain;
  properties.period = 0;
  return std::make_shared<ComposedCurve<ByLaw<ScalarLaw>>>(ByLaw<ScalarLaw>{of, law, std::move(stations)}, properties);
}

}  // namespace

CurvePtr reversed_curve(const CurvePtr& of) {
  const Interval domain = of->domain();
  return affinely(of, domain, domain.hi, -1);
}

CurvePtr with_domain(const CurvePtr& of, const Interval& domain) {
  const Interval own = of->domain();
  return affinely(of, domain, own.lo, own.width() / domain.width());
}

CurvePtr trimmed_curve(const CurvePtr& of, double from, double to, bool backward) {
  const Interval domain = of->domain();
  const bool closed = of->is_closed();
  if (!closed) {
    for (const auto& [field, t] : {std::pair("from", from), std::pair("to", to)})
      if (!domain.contains(t))
        throw FieldError(
            field, fmt::format("t = {:.6g} lies outside of the curve's {:.6g} to {:.6g}", t, domain.lo, domain.hi));
    if (from == to) throw FieldError("to", "the part has no length");
    if (backward || to < from) {
      if (backward && to > from)
        throw FieldError("to", "backward from there the curve does not reach it", "exchange 'from' and 'to'");
      return affinely(of, {0, from - to}, from, -1);
    }
    return affinely(of, {0, to - from}, from, 1);
  }
  const double width = domain.width();
  from = wrapped(from, domain);
  const double sign = backward ? -1 : 1;
  double length = std::fmod(sign * (to - from), width);
  if (length <= 0) length += width;
  // Up to the seam, and from there on.
  const double first = backward ? from - domain.lo : domain.hi - from;
  if (length <= first) return affinely(of, {0, length}, from, sign);
  if (first == 0) return affinely(of, {0, length}, backward ? domain.hi : domain.lo, sign);
  std::vector<CurvePtr> parts{affinely(of, {0, first}, from, sign),
                              affinely(of, {0, length - first}, backward ? domain.hi : domain.lo, sign)};
  return std::make_shared<CompositeCurve>(std::move(parts), length == width, 1e-9);
}

namespace {

// The parameter at a share of the length: Newton's steps, halves where they leave the bracket.
double parameter_at(const Curve& of, const ArcFraction& fraction, double share) {
  Interval t = of.domain();
  double at = t.lo + share * t.width();
  for (int i = 0; i < 200 && t.lo < t.middle() && t.middle() < t.hi; ++i) {
    const double off = fraction.at(at) - share;
    (off < 0 ? t.lo : t.hi) = at;
    const double next = at - off * fraction.length() / glm::length(of.evaluate(at, 1).d[1]);
    if (next == at) return at;
    at = t.lo < next && next < t.hi ? next : t.middle();
  }
  return at;
}

// By the arc length, scaled to 0..end; the length itself where that is 0.
CurvePtr along_length(const CurvePtr& of, double end) {
  const Interval domain = of->domain();
  if (!(domain.width() < kInfinity)) throw FieldError("of", "the curve is unbounded", "give it a domain");
  const ArcFraction fraction(*of);
  if (end == 0) end = fraction.length();
  std::vector<Interval> stretches;
  CurveProperties properties = properties_of(*of);
  Stations stations{{}, properties.breaks};
  for (double& t : properties.breaks) t = fraction.at(t) * end;
  properties.breaks.front() = 0, properties.breaks.back() = end;
  stations.w = properties.breaks;
  for (size_t i = 0; i + 1 < properties.breaks.size(); ++i)
    stretches.push_back({properties.breaks[i], properties.breaks[i + 1]});
  const auto t_at = [&](double s) { return Vec3(parameter_at(*of, fraction, s / end), 0, 0); };
  const auto law = polynomial_approximation(t_at, stretches, 1e-13 * domain.width());
  if (!law) throw FieldError("of", "the curve rests somewhere: its parameter is no smooth function of the length");
  properties.domain = {0, end};
  // An arc of a circle has the period of the circle, and does not close.
  properties.period = properties.period > 0 && of->is_closed() ? end : 0;
  add_operand(properties, *law);
  return std::make_shared<ComposedCurve<ByLaw<CurveLaw>>>(ByLaw<CurveLaw>{of, {law}, std::move(stations)}, properties);
}

}  // namespace

CurvePtr by_arc_length(const CurvePtr& of) { return along_length(of, 0); }

CurvePtr by_length_fraction(const CurvePtr& of) { return along_length(of, 1); }

TypeDeclaration reversed_curve_type() {
  return declare(Category::curve, "reversed_curve", "A curve run through the other way, over the same parameters.")
      .field("of", reference({Category::curve}), "the curve")
      .built_by([](const Fields& f) { return std::any(reversed_curve(f.curve("of"))); });
}

TypeDeclaration trimmed_curve_type() {
  return declare(Category::curve, "trimmed_curve",
                 "Part of a curve, run through either way; of a closed curve also over its seam, or all of it with "
                 "another seam (to equal to from). Its parameter begins at 0.")
      .example("of: round, from: 5, to: 1")
      .field("of", reference({Category::curve}), "the curve")
      .field("from", number(), "parameter where the part begins")
      .field("to", number(), "parameter where it ends")
      .field("backward", boolean(), "of a closed curve: run from there against its direction", "false")
      .built_by([](const Fields& f) {
        return std::any(trimmed_curve(f.curve("of"), f.number("from"), f.number("to"), f.boolean("backward")));
      });
}

TypeDeclaration reparametrized_curve_type() {
  return declare(
             Category::curve, "reparametrized_curve",
             "The points of a curve with another parameter w: over another domain, by a law t(w), or by arc length.")
      .example("of: round, domain: [0, 1]")
      .field("of", reference({Category::curve}), "the curve")
      .optional("domain", range(), "of w; without a law the parameter is stretched evenly")
      .optional("parameter", formula({"w"}), "t as an increasing formula of w")
      .field("arc_length", boolean(), "w is the arc length, from 0", "false")
      .built_by([](const Fields& f) {
        const CurvePtr of = f.curve("of");
        if (f.boolean("arc_length")) {
          if (f.has("domain") || f.has("parameter"))
            throw FieldError("arc_length", "the arc length is one law, 'domain' and 'parameter' are another",
                             "leave out one of them");
          return std::any(by_arc_length(of));
        }
        if (!f.has("domain")) throw FieldError("domain", "the new parameter needs a domain", "domain: [0, 1]");
        if (!f.has("parameter")) return std::any(with_domain(of, f.range("domain")));
        return std::any(by_formula(of, ScalarLaw(f.get<Expression>("parameter")), f.range("domain")));
      });
}

}  // namespace lekalo::geometry
