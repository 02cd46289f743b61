// At a corner A = r(c) the curve is left at P = r(c - zone / |r'(c-)|) and met again at Q = r(c + zone / |r'(c+)|).
// Between them goes the cubic with r'(P) and |r'(P)| r'(Q) / |r'(Q)|, over |PQ| / |r'(P)| of the parameter
// (Zavyalov et al. 1985, 128).
#include "geometry/curves/operations/rounded_corners.h"

#include <fmt/format.h>

#include "geometry/curves/operations/hermite_span.h"
#include "geometry/curves/operations/smooth_pieces.h"
#include "geometry/curves/splines/nurbs_operations.h"

namespace lekalo::geometry {

namespace {

// The form over a part of its domain, clamped.
NurbsCurveForm part_of(NurbsCurveForm form, const Interval& part) {
  if (part.lo > form.domain().lo) form = split(form, part.lo).second;
  if (part.hi < form.domain().hi) form = split(form, part.hi).first;
  return form;
}

// Parts with common ends, one after the other: each begins at the parameter where the one before ends.
class Joined {
 public:
  Joined(int degree, double begin) : degree_(degree), knots_(degree + 1, begin) {}

  // The part with its parameter stretched by `pace`.
  void add(const NurbsCurveForm& part, double pace) {
    const double from = knots_.back(), begin = part.domain().lo;
    const double scale = points_.empty() ? 1 : points_.back().w / part.points.front().w;
    for (size_t i = part.degree + 1; i + 1 < part.knots.size(); ++i)
      knots_.push_back(from + pace * (part.knots[i] - begin));
    for (size_t i = points_.empty() ? 0 : 1; i < part.points.size(); ++i) points_.push_back(scale * part.points[i]);
  }
  NurbsCurveForm form() const {
    NurbsCurveForm result{degree_, knots_, points_, {}};
    result.knots.push_back(knots_.back());
    return result;
  }

 private:
  int degree_;
  std::vector<double> knots_;
  std::vector<Vec4> points_;
};

NurbsCurveForm bezier_form(const CurvePiece& piece, int degree) {
  NurbsCurveForm form{piece.degree(), std::vector<double>(piece.points.size(), piece.domain.lo), piece.points, {}};
  form.knots.insert(form.knots.end(), piece.points.size(), piece.domain.hi);
  return elevate_degree(form, degree - piece.degree());
}

// All pieces, clamped at both ends, of degree 3 at least.
NurbsCurveForm own_form(const Curve& curve) {
  const std::vector<CurvePiece> pieces = curve.pieces();
  int degree = 3;
  for (const CurvePiece& piece : pieces) {
    if (!piece.is_rational() || piece.map.kind != ParameterMap::Kind::affine)
      throw FieldError("of", "the curve is not a NURBS curve in its own parameter",
                       "a spline_of_curve comes as near as you like");
    degree = std::max(degree, piece.degree());
  }
  Joined joined(degree, curve.domain().lo);
  for (const CurvePiece& piece : pieces) joined.add(bezier_form(piece, degree), 1);
  return joined.form();
}

struct Corner {
  double before, after;  // parameters where the curve is left and met
  double at;
};

Corner corner_at(const Curve& curve, double before_at, double after_at, double zone) {
  const double before = glm::length(evaluate_within(curve, {curve.domain().lo, before_at}, before_at, 1).d[1]);
  const double after = glm::length(curve.evaluate(after_at, 1).d[1]);
  if (!(before > 0 && after > 0)) throw FieldError("of", fmt::format("the curve stops at its corner t = {}", after_at));
  return {before_at - zone / before, after_at + zone / after, after_at};
}

NurbsCurveForm bridge(const Curve& curve, const Corner& corner) {
  const CurveJet p = curve.evaluate(corner.before, 1), q = curve.evaluate(corner.after, 1);
  const double speed = glm::length(p.d[1]), h = glm::length(q.d[0] - p.d[0]) / speed;
  if (!(h > 0)) throw FieldError("of", fmt::format("the curve turns back at its corner t = {}", corner.at));
  const Vec3 end = speed * glm::normalize(q.d[1]);
  const Vec3 points[4] = {p.d[0], p.d[0] + h / 3 * p.d[1], q.d[0] - h / 3 * end, q.d[0]};
  NurbsCurveForm form{3, {0, 0, 0, 0, h, h, h, h}, {}, {}};
  for (const Vec3& point : points) form.points.emplace_back(point, 1);
  return form;
}

}  // namespace

NurbsCurve rounded_corners(const Curve& curve, double zone) {
  const NurbsCurveForm form = own_form(curve);
  const std::vector<double> at = corners(curve);
  std::vector<Corner> rounded;
  for (size_t k = 1; k + 1 < at.size(); ++k) rounded.push_back(corner_at(curve, at[k], at[k], zone));
  Interval rest = curve.domain();
  const Vec3 end = evaluate_within(curve, rest, rest.hi, 1).d[1], start = curve.evaluate(rest.lo, 1).d[1];
  if (curve.is_closed() && glm::length(end - start) > 1e-9 * glm::length(start)) {
    rounded.push_back(corner_at(curve, rest.hi, rest.lo, zone));
    rest = {rounded.back().after, rounded.back().before};
  }
  Joined joined(form.degree, rest.lo);
  double pace = 1, from = rest.lo;
  for (const Corner& corner : rounded) {
    const bool last = &corner == &rounded.back() && rest != curve.domain();
    if (!(corner.before > from) || !(corner.after < rest.hi || last))
      throw FieldError("zone", fmt::format("the zone about the corner t = {} meets the next one, or an end", corner.at),
                       "a smaller zone");
    joined.add(part_of(form, {from, corner.before}), pace);
    joined.add(elevate_degree(bridge(curve, corner), form.degree - 3), pace);
    pace *= glm::length(curve.evaluate(corner.after, 1).d[1]) / glm::length(curve.evaluate(corner.before, 1).d[1]);
    from = corner.after;
    if (last) return NurbsCurve(joined.form());
  }
  joined.add(part_of(form, {from, rest.hi}), pace);
  return NurbsCurve(joined.form());
}

TypeDeclaration rounded_corners_type() {
  return declare(Category::curve, "rounded_corners", "A curve with cubic pieces in place of its corners, of class C1.")
      .example("of: { type: polyline, points: [[0, 0], [2, 0], [2, 1]] }, zone: 0.3")
      .field("of", reference({Category::curve}), "the curve: a polyline, a spline, ...")
      .field("zone", length().positive(), "how far from a corner along the curve its rounding begins and ends")
      .shows({"control_polygon", "knots"})
      .built_by([](const Fields& f) { return rounded_corners(*f.curve("of"), f.number("zone")); });
}

}  // namespace lekalo::geometry
