// A curve by its formulas (Golovanov 2016, 2.1): r(t) = point(f(t), g(t), h(t)).
#include "geometry/curves/analytic/formula_curve.h"

#include <cmath>
#include <stdexcept>

#include "geometry/curves/analytic/formula_breaks.h"
#include "geometry/describe.h"
#include "geometry/formula.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// Places where the formulas are tried before anything else asks.
constexpr int kTried = 64;
// Over a long stretch the bounds of a quotient or a root may be infinite, or enormous beside the curve, where those of
// its parts are not: stretches down to this part of the domain are taken in halves then.
constexpr double kMinHalved = 1.0 / 128;
constexpr double kEnormous = 8;

const std::vector<std::string> kVariables{"t"};

}  // namespace

FormulaCurve::FormulaCurve(PointFormulas point_formulas, const Interval& domain, bool closed,
                           const std::optional<RationalLaw>& law)
    : point_(std::move(point_formulas)), domain_(domain) {
  if (!(domain.width() > 0 && domain.width() < kInfinity))
    throw FieldError("domain", "the domain of a curve must be finite and not empty");
  double size = 0;
  const Vec3 first = point(domain.lo);
  for (int i = 0; i <= kTried; ++i) {
    const double t = i == kTried ? domain.hi : domain.lo + domain.width() * i / kTried;
    const Vec3 p = point(t);
    const bool is_pole = domain.lo < t && t < domain.hi && std::isinf(glm::length(p));
    if (is_pole) continue;
    if (!is_finite(p)) throw FieldError("domain", point_.no_value({{t}}));
    size = std::max(size, glm::length(p - first));
  }
  if (closed && glm::length(point(domain.hi) - first) > kClosedCurve * size)
    throw FieldError("closed", "the curve is not closed: its ends do not meet",
                     "leave 'closed' out, or give a domain of whole periods");
  closed_ = closed;
  size_ = size;
  stretches_ = smooth_stretches(point_, domain);
  if (!law) return;
  rational_ = rational_form(point_, *law, domain);
  if (rational_ && closed) rational_->form.points.back() = rational_->form.points.front();
}

CurveJet FormulaCurve::evaluate(double t, int order) const {
  return evaluate_curve_formula(point_, closed_ ? wrapped(t, domain_) : t, order);
}

CurveEnclosure FormulaCurve::enclose(const Interval& whole_t, int order) const {
  Interval t = whole_t;
  // At a break its own value, and that of the other side, count elsewhere.
  for (size_t k = 1; k < stretches_.size(); ++k) {
    if (t.lo == stretches_[k].lo && next_up(t.lo) < t.hi) t.lo = next_up(t.lo);
    if (t.hi == stretches_[k - 1].hi && t.lo < next_down(t.hi)) t.hi = next_down(t.hi);
  }
  CurveEnclosure whole = enclose_curve_centered(point_, t, order);
  bool is_good = whole.d[0].diameter() <= kEnormous * size_;
  for (int k = 0; k <= order; ++k) is_good = is_good && whole.d[k].bounded();
  if (is_good || !(t.width() > kMinHalved * domain_.width())) return whole;
  const CurveEnclosure below = enclose({t.lo, t.middle()}, order), above = enclose({t.middle(), t.hi}, order);
  for (int k = 0; k <= order; ++k) {
    whole.d[k] = below.d[k];
    whole.d[k].include(above.d[k]);
  }
  return whole;
}

std::optional<NurbsCurveForm> FormulaCurve::as_nurbs() const {
  if (!rational_ || rational_->speed != 1) return std::nullopt;
  return rational_->form;
}

std::vector<CurvePiece> FormulaCurve::pieces() const {
  if (const auto form = as_nurbs()) return bezier_pieces(*form, domain_);
  std::vector<CurvePiece> result;
  for (const Interval& t : stretches_) {
    CurvePiece piece;
    piece.domain = t;
    piece.map = {ParameterMap::Kind::affine, t.lo, t.hi};
    result.push_back(piece);
  }
  return result;
}

TypeDeclaration formula_curve_type() {
  TypeDeclaration type = declare(Category::curve, "formula_curve", "Curve given by formulas of its parameter t.");
  type.example("point: [cos(t), sin(2*t)], domain: [0, 2*pi], closed: true");
  declare_formulas(type, kVariables);
  type.field("domain", range(), "of t, or of x");
  type.field("closed", boolean(), "the ends meet, and the parameter wraps", "false");
  return type.built_by([](const Fields& f) {
    return FormulaCurve(read_formulas(f, kVariables), f.range("domain"), f.boolean("closed"));
  });
}

}  // namespace lekalo::geometry
