// A cubic with the points and derivatives of a curve at the ends of a step h is off by about h^4 / 384 max |r''''|
// (Zavyalov et al. 1985, 24): knots are placed one after the other by the difference itself, without that derivative.
#include "geometry/curves/operations/spline_of_curve.h"

#include <algorithm>

#include "geometry/curves/interpolation/collocation.h"
#include "geometry/curves/operations/arc_fraction.h"
#include "geometry/curves/operations/hermite_span.h"

namespace lekalo::geometry {

namespace {

// Places of a span where a spline by length is compared with its curve, and what is kept of the tolerance for those
// between: differences change like w^2 (1 - w)^2.
constexpr int kPlaces = 32;
constexpr double kKept = 0.98;
// Tangents at a seam that differ by no more than this part are one.
constexpr double kSmooth = 1e-9;

// The same span over the length of arc.
class ByLength {
 public:
  explicit ByLength(const Curve& curve) : curve_(curve), fraction_(curve) {}

  HermiteSpan span(const Interval& t) const {
    HermiteSpan result = hermite_span(curve_, t);
    for (Vec3* tangent : {&result.tangent_from, &result.tangent_to}) {
      if (!(glm::length(*tangent) > 0)) throw FieldError("of", "the curve has no tangent at an end of a span");
      *tangent = glm::normalize(*tangent);
    }
    result.t = {length(t.lo), length(t.hi)};
    return result;
  }
  bool is_within(const Interval& t, double tolerance) const {
    const HermiteSpan spline = span(t);
    for (int k = 1; k < kPlaces; ++k) {
      const double at = t.lo + k * t.width() / kPlaces;
      if (!(glm::length(spline.point(length(at)) - curve_.point(at)) <= kKept * tolerance)) return false;
    }
    return true;
  }

 private:
  double length(double t) const { return fraction_.at(t) * fraction_.length(); }
  const Curve& curve_;
  ArcFraction fraction_;
};

// Spans with one tangent where they meet have double knots there, at corners triple ones.
NurbsCurve joined(const std::vector<HermiteSpan>& spans, bool closed) {
  std::vector<double> knots;  // after the first
  std::vector<Vec3> points;   // between the ends
  for (size_t k = 0; k < spans.size(); ++k) {
    const HermiteSpan& span = spans[k];
    const double third = span.t.width() / 3;
    points.push_back(span.from + third * span.tangent_from);
    points.push_back(span.to - third * span.tangent_to);
    if (k + 1 == spans.size()) break;
    const bool smooth = span.tangent_to == spans[k + 1].tangent_from;
    if (!smooth) points.push_back(span.to);
    knots.insert(knots.end(), smooth ? 2 : 3, span.t.hi);
  }
  const double lo = spans.front().t.lo, hi = spans.back().t.hi;
  if (!closed) {
    points.insert(points.begin(), spans.front().from);
    points.push_back(spans.back().to);
    return NurbsCurve(clamped_axis(3, lo, hi, knots), points);
  }
  // The seam has a double knot as well; its first control point is the last one here.
  std::rotate(points.begin(), points.end() - 1, points.end());
  knots.insert(knots.begin(), lo);
  knots.push_back(hi);
  return NurbsCurve(periodic_axis(3, knots, hi - lo), points);
}

// Where the last span ends as the first begins, rounding apart.
bool closes_smoothly(const Curve& curve, std::vector<HermiteSpan>& spans) {
  const Vec3 start = spans.front().tangent_from, end = spans.back().tangent_to;
  if (spans.size() < 3 || !curve.is_closed() || glm::length(end - start) > kSmooth * glm::length(start)) return false;
  spans.back().tangent_to = start;
  spans.back().to = spans.front().from;
  return true;
}

}  // namespace

NurbsCurve spline_of_curve(const Curve& curve, double tolerance, const SplineOfCurveOptions& options) {
  const std::vector<double> at = corners(curve);
  std::optional<ByLength> by_length;
  if (options.by_length) by_length.emplace(curve);
  const auto fits = [&](const Interval& t) {
    return by_length ? by_length->is_within(t, tolerance) : is_within(curve, hermite_span(curve, t), tolerance);
  };
  std::vector<HermiteSpan> spans;
  for (size_t k = 1; k < at.size(); ++k) {
    const Interval part(at[k - 1], at[k]);
    const std::vector<double> knots = options.even ? equal_steps(part, fits) : longest_steps(part, fits);
    for (size_t i = 1; i < knots.size(); ++i) {
      const Interval t(knots[i - 1], knots[i]);
      spans.push_back(by_length ? by_length->span(t) : hermite_span(curve, t));
      // Inside a part both sides have one tangent, whatever the rounding at ends of pieces.
      if (i > 1) spans[spans.size() - 2].tangent_to = spans.back().tangent_from;
    }
  }
  const bool closed = closes_smoothly(curve, spans);
  return joined(spans, closed);
}

TypeDeclaration spline_of_curve_type() {
  return declare(Category::curve, "spline_of_curve",
                 "Cubic spline of class C1 that is nowhere farther from a curve than a tolerance.")
      .example("of: { type: circle, radius: 1 }, tolerance: 0.001")
      .field("of", reference({Category::curve}), "the curve")
      .field("tolerance", length().positive(), "largest distance between the two")
      .field(
          "parameter", choice({"own", "length"}),
          "the curve's own, or about the length of arc from its beginning (where the distance is checked, not proved)",
          "own")
      .field("steps", choice({"longest", "equal"}),
             "as long as the tolerance allows one after the other, or equal in the curve's parameter between corners",
             "longest")
      .shows({"control_polygon", "knots"})
      .built_by([](const Fields& f) {
        return spline_of_curve(*f.curve("of"), f.number("tolerance"),
                               {f.text("parameter") == "length", f.text("steps") == "equal"});
      });
}

}  // namespace lekalo::geometry
