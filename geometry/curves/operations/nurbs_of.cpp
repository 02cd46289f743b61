#include "geometry/curves/operations/nurbs_of.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/curves/analytic/formula_curve.h"
#include "geometry/curves/operations/curve_parts.h"
#include "geometry/curves/operations/parameter_line.h"
#include "geometry/curves/operations/smooth_pieces.h"
#include "geometry/curves/splines/nurbs_operations.h"

namespace lekalo::geometry {

namespace {

constexpr int kDegree = 5;
constexpr int kMaxHalvings = 14;  // of a smooth piece
constexpr int kPlaces = 9;        // where a span is compared with its curve

// Bezier points over [a, b] with the curve's points and derivatives there (Golovanov 2016, 2.4):
//   p_1 = p_0 + h r'/5,  p_2 = 2 p_1 - p_0 + h^2 r''/20, and so from the end.
std::array<Vec3, 6> hermite_points(const CurveJet& at_a, const CurveJet& at_b, double h) {
  std::array<Vec3, 6> p;
  p[0] = at_a.d[0], p[5] = at_b.d[0];
  p[1] = p[0] + h / 5 * at_a.d[1], p[4] = p[5] - h / 5 * at_b.d[1];
  p[2] = 2.0 * p[1] - p[0] + h * h / 20 * at_a.d[2], p[3] = 2.0 * p[4] - p[5] + h * h / 20 * at_b.d[2];
  return p;
}

Vec3 de_casteljau(std::array<Vec3, 6> p, double x) {
  for (int k = 5; k > 0; --k)
    for (int i = 0; i < k; ++i) p[i] = affine_mix(1 - x, p[i], x, p[i + 1]);
  return p[0];
}

// Fits smooth pieces one after the other.
class Fit {
 public:
  Fit(const Curve& curve, double tolerance) : curve_(curve), tolerance_(tolerance) {}

  void add(const Interval& piece) {
    piece_ = piece;
    add_span(piece, jet(piece.lo), jet(piece.hi), 0);
  }

  // Knots stand three times inside smooth pieces, where the second derivatives agree, five times where pieces meet, and
  // six times at a jump.
  NurbsOfCurve finish() const {
    NurbsOfCurve result{{kDegree, {}, {}, {}}, false, deviation_};
    NurbsCurveForm& form = result.form;
    const auto knot = [&](double t, size_t copies) { form.knots.insert(form.knots.end(), copies, t); };
    const auto point = [&](const Vec3& p) { form.points.emplace_back(p, 1.0); };
    knot(spans_.front().t.lo, 6);
    for (size_t k = 0; k < spans_.size(); ++k) {
      const auto& p = spans_[k].points;
      if (k == 0 || !spans_[k].goes_on) {
        for (int i = 0; i < 2; ++i) point(p[i]);
      }
      point(p[2]), point(p[3]);
      if (k + 1 == spans_.size()) {
        point(p[4]), point(p[5]);
      } else if (spans_[k + 1].goes_on) {
        // The polar form at (t_0, t_1, t_1, t_1, t_2), from p_3 = f(t_0, t_1, t_1, t_1, t_0) and p_4 with t_1 at last.
        point(p[3] + (1 + spans_[k + 1].t.width() / spans_[k].t.width()) * (p[4] - p[3]));
        knot(spans_[k].t.hi, 3);
      } else {
        const bool jumps = glm::length(p[5] - spans_[k + 1].points[0]) > tolerance_;
        point(p[4]);
        if (jumps) point(p[5]);
        knot(spans_[k].t.hi, jumps ? 6 : 5);
      }
    }
    knot(spans_.back().t.hi, 6);
    return result;
  }

 private:
  struct Span {
    Interval t;
    std::array<Vec3, 6> points;
    bool goes_on;  // as smoothly as the curve, from the span before
  };

  CurveJet jet(double t) const {
    const CurveJet at = evaluate_within(curve_, piece_, t, 2);
    for (int k = 0; k <= 2; ++k)
      if (!std::isfinite(at.d[k].x + at.d[k].y + at.d[k].z))
        throw std::invalid_argument(fmt::format("the curve has no finite derivatives at t = {}", t));
    return at;
  }

  void add_span(const Interval& t, const CurveJet& at_a, const CurveJet& at_b, int halvings) {
    const std::array<Vec3, 6> points = hermite_points(at_a, at_b, t.width());
    double largest = 0;
    for (int k = 1; k <= kPlaces; ++k) {
      const double x = k / (kPlaces + 1.0);
      const double apart = glm::length(de_casteljau(points, x) - curve_.point(t.lo + x * t.width()));
      largest = std::isnan(apart) ? kInfinity : std::max(largest, apart);
    }
    if (largest <= tolerance_) {
      deviation_ = std::max(deviation_, largest);
      spans_.push_back({t, points, t.lo > piece_.lo});
      return;
    }
    if (halvings == kMaxHalvings)
      throw std::invalid_argument(
          fmt::format("near t = {} a fit stays {:.2g} away from the curve", t.middle(), largest));
    const CurveJet middle = jet(t.middle());
    add_span({t.lo, t.middle()}, at_a, middle, halvings + 1);
    add_span({t.middle(), t.hi}, middle, at_b, halvings + 1);
  }

  const Curve& curve_;
  double tolerance_;
  Interval piece_;
  std::vector<Span> spans_;
  double deviation_ = 0;
};

// The part of a form whose parameter is speed * t over an interval of t.
NurbsOfCurve exact_part(const NurbsCurveForm& form, double speed, const Interval& part) {
  NurbsCurveForm affine{form.degree, form.knots, form.points, {}};
  // A parameter between knots that a map tells: the rational one of the same point. The part's ends keep their own.
  const auto rational = [&](double t) {
    const double s = speed * t;
    for (const ParameterMap& map : form.maps)
      if (s > map.lo && s < map.hi) return map.rational(s);
    return s;
  };
  const Interval domain = affine.domain();
  const NurbsCurveForm cut = clamped_part(affine, {domain.clamp(rational(part.lo)), domain.clamp(rational(part.hi))});
  return {cut.domain() == part ? cut : reparametrized(cut, part), true, 0};
}

}  // namespace

NurbsOfCurve nurbs_of(const Curve& curve, const Interval& part, double tolerance) {
  if (!(part.width() > 0 && part.width() < kInfinity))
    throw std::invalid_argument("the curve is not bounded: give a domain");
  if (const auto form = curve.as_nurbs()) return exact_part(*form, 1, part);
  if (const auto* line = dynamic_cast<const ParameterLine*>(&curve))
    if (const auto form = line->form()) return exact_part(*form, 1, part);
  const auto* formula = dynamic_cast<const FormulaCurve*>(&curve);
  if (formula && formula->rational()) return exact_part(formula->rational()->form, formula->rational()->speed, part);
  Fit fit(curve, tolerance);
  for (const Interval& piece : parts_of(curve, part)) fit.add(piece);
  return fit.finish();
}

}  // namespace lekalo::geometry
