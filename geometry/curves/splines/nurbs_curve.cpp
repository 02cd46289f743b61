#include "geometry/curves/splines/nurbs_curve.h"

#include <fmt/format.h>

#include <cmath>

#include "geometry/curves/splines/bspline_basis.h"
#include "geometry/curves/splines/rational.h"
#include "geometry/curves/splines/rational_enclosure.h"
#include "geometry/curves/splines/weights.h"

namespace lekalo::geometry {

NurbsCurve::NurbsCurve(SplineAxis axis, std::span<const Vec3> points, std::span<const double> weights)
    : axis_(std::move(axis)), points_(homogeneous(points, weights)) {
  const size_t distinct = axis_.distinct();
  if (points.size() != distinct)
    throw FieldError("points", fmt::format("the knots ask for {} points, not {}", distinct, points.size()));
  for (int i = static_cast<int>(distinct); i < axis_.count(); ++i) points_.push_back(points_[i - distinct]);
  rational_ = has_weights(points_);
  check_denominator();
}

NurbsCurve::NurbsCurve(const NurbsCurveForm& form)
    : axis_(form.degree, form.knots, Extension::tangent), points_(form.points), rational_(has_weights(form.points)) {
  if (static_cast<int>(points_.size()) != axis_.count())
    throw FieldError("points", fmt::format("the knots ask for {} points, not {}", axis_.count(), points_.size()));
  check_denominator();
}

void NurbsCurve::check_denominator() const {
  if (all_weights_positive(points_)) return;
  const NurbsCurveForm form{degree(), axis_.knots(), points_, {}};
  for (const CurvePiece& piece : bezier_pieces(form, form.domain()))
    if (!denominator_positive(degree(), 0, piece.points))
      throw FieldError(
          "weights",
          fmt::format("the denominator vanishes between t = {} and t = {}: the curve goes through infinity",
                      piece.domain.lo, piece.domain.hi),
          "positive weights are always safe");
}

CurveJet NurbsCurve::evaluate(double t, int order) const {
  const SplineAxis::Place place = axis_.place(t);
  const int evaluated = place.beyond != 0 && order == 0 ? 1 : order;
  const int p = degree();
  const SpanBasis basis = span_basis(p, axis_.knots(), place.span, place.t, evaluated);
  Vec4 points[kMaxDegree + 1], sums[kMaxCurveOrder + 1];
  std::copy_n(points_.data() + (place.span - p), p + 1, points);
  basis.derivatives(points, evaluated, sums);
  CurveJet jet;
  jet.order = order;
  if (rational_)
    divide_by_weight(sums, evaluated, jet.d.data());
  else
    for (int k = 0; k <= evaluated; ++k) jet.d[k] = Vec3(sums[k]);
  if (place.beyond != 0) {
    jet.d[0] += place.beyond * jet.d[1];
    for (int k = 2; k <= order; ++k) jet.d[k] = Vec3(0);
  }
  return jet;
}

// Adds the control points of a span, between which the curve lies if all their weights are positive; else false.
bool NurbsCurve::add_hull_of_span(int span, Box3& hull) const {
  for (int i = span - degree(); i <= span; ++i) {
    if (!(points_[i].w > 0)) return false;
    hull.include(Vec3(points_[i]) / points_[i].w);
  }
  constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();
  hull = hull.inflated(kRounding * glm::length(glm::max(glm::abs(hull.lo), glm::abs(hull.hi))));
  return true;
}

CurveEnclosure NurbsCurve::enclose(const Interval& t, int order) const {
  CurveEnclosure result;
  const auto& knots = axis_.knots();
  for (const int span : axis_.spans_over(t)) {
    const Interval part{std::clamp(t.lo, knots[span], knots[span + 1]), std::clamp(t.hi, knots[span], knots[span + 1])};
    Box3 hull = result.d[0];
    enclose_span(degree(), knots, span, points_, rational_, part, order, result);
    // Where rounding hides the sign of the denominator: weights of 1 beside those of 1e18.
    if (!result.d[0].bounded() && add_hull_of_span(span, hull)) result.d[0] = hull;
  }
  return result;
}

std::optional<NurbsCurveForm> NurbsCurve::as_nurbs() const {
  return NurbsCurveForm{degree(), axis_.knots(), points_, {}};
}

std::vector<double> polygon_steps(std::span<const Vec3> points, bool closed) {
  std::vector<double> steps;
  for (size_t i = 1; i < points.size(); ++i) steps.push_back(glm::length(points[i] - points[i - 1]));
  if (closed && !points.empty()) steps.push_back(glm::length(points.front() - points.back()));
  return steps;
}

namespace {

// The full knot vector of distinct knots and how often each stands, as STEP files have them.
Knots repeated(const Fields& f) {
  Knots knots = f.knots("knots");
  if (!f.has("multiplicities")) return knots;
  const std::vector<double>& copies = f.numbers("multiplicities");
  if (!knots.rule.empty() || copies.size() != knots.values.size())
    throw FieldError("multiplicities", "each knot of a list has one", "knots: [0, 1, 2], multiplicities: [4, 1, 4]");
  std::vector<double> all;
  for (size_t i = 0; i < copies.size(); ++i) {
    if (copies[i] != std::floor(copies[i]))
      throw FieldError("multiplicities", fmt::format("{:g} is no whole number", copies[i]));
    all.insert(all.end(), static_cast<size_t>(copies[i]), knots.values[i]);
  }
  knots.values = std::move(all);
  return knots;
}

}  // namespace

TypeDeclaration nurbs_curve_type() {
  return declare(Category::curve, "nurbs_curve", "Rational B-spline curve of any degree, open or closed.")
      .example("degree: 2, points: [[0, 0], [1, 2], [3, 2], [4, 0]]")
      .field("points", points().count(2), "control points; those of a closed curve are not repeated")
      .field("degree", integer().between(1, kMaxDegree), "degree of the polynomial pieces", "3")
      .field(
          "knots", knots(),
          "the full knot vector (points + degree + 1 numbers; points + 2 degree + 1 when closed), or a rule: clamped "
          "(integers), uniform, chord_length, centripetal",
          "clamped")
      .optional("multiplicities", numbers().between(1, kMaxDegree + 1),
                "how often each of the knots stands, where 'knots' lists each once")
      .optional("weights", numbers(), "one weight for each point; all 1 when left out")
      .field("closed", boolean(), "periodic curve, smooth over its seam", "false")
      .optional("domain", range(), "part of the curve, in the knots' parameter; over the seam too when closed")
      .shows({"control_polygon", "knots", "de_boor"})
      .built_by([](const Fields& f) {
        const std::vector<Vec3>& points = f.points("points");
        const bool closed = f.boolean("closed");
        SplineAxis axis = make_axis(f.integer("degree"), repeated(f), closed, static_cast<int>(points.size()),
                                    polygon_steps(points, closed));
        if (f.has("domain")) axis.restrict_to(f.range("domain"));
        return NurbsCurve(std::move(axis), points, f.has("weights") ? f.numbers("weights") : std::vector<double>());
      });
}

}  // namespace lekalo::geometry
