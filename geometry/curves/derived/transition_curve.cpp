// With D the distance of the ends and a', a'', ... the derivatives of a curve by its arc length, the transition r(w),
// w in [0, 1], is the Hermite interpolant with
//
//   r^(i)(0) = (k D)^i a^(i),   r^(i)(1) = (k D)^i b^(i),   i = 0..continuity
//
// (Golovanov 2016, 2.15: i = 0, 1). As Bezier points: p_i = sum C(i, j) (n - j)!/n! r^(j)(0), and from the other end.
#include "geometry/curves/derived/transition_curve.h"

#include <fmt/format.h>

#include <cmath>

#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/describe.h"
#include "geometry/formula.h"

namespace lekalo::geometry {

namespace {

constexpr int kMaxContinuity = 3;
using Series = Jet<double, kMaxContinuity>;

// The derivatives by arc length in the direction of travel at the end, from the curve's own by t: with s' = |r'| the
// series of t(s) is found order by order from t' = 1/|r'(t)|.
std::array<Vec3, kMaxContinuity + 1> by_length(const CurveEnd& end, const char* field) {
  const Interval domain = end.curve->domain();
  const CurveJet jet = end.curve->evaluate(end.at_start ? domain.lo : domain.hi, kMaxContinuity);
  const double sign = end.against ? -1 : 1;
  Triple<Series> r, velocity;
  double factorial = 1;
  for (int k = 0; k <= kMaxContinuity; ++k) {
    if (k > 0) factorial *= k;
    const Triple<double> d = triple(jet.d[k]);
    r.x.c[k] = d.x / factorial, r.y.c[k] = d.y / factorial, r.z.c[k] = d.z / factorial;
    if (k > 0) {
      const double of_velocity = k / factorial;
      velocity.x.c[k - 1] = d.x * of_velocity, velocity.y.c[k - 1] = d.y * of_velocity,
                       velocity.z.c[k - 1] = d.z * of_velocity;
    }
  }
  if (!(glm::length(jet.d[1]) > 0)) throw FieldError(field, "the curve has no tangent at this end");
  const Series rate = sign / length(velocity);
  Series t;
  for (int k = 1; k <= kMaxContinuity; ++k) {
    Series from_zero = t;
    from_zero.c[0] = 0;
    t.c[k] = Series::composed(rate, from_zero).c[k - 1] / k;
  }
  t.c[0] = 0;
  const Triple<Series> along{Series::composed(r.x, t), Series::composed(r.y, t), Series::composed(r.z, t)};
  std::array<Vec3, kMaxContinuity + 1> result;
  for (int k = 0; k <= kMaxContinuity; ++k)
    result[k] = {along.x.derivative(k), along.y.derivative(k), along.z.derivative(k)};
  return result;
}

// The first k + 1 Bezier points of degree n from the derivatives at their end.
std::vector<Vec3> points_from(const std::array<Vec3, kMaxContinuity + 1>& derivatives, int k, int n, double scale) {
  std::vector<Vec3> points;
  for (int i = 0; i <= k; ++i) {
    Vec3 point(0);
    double choose = 1, falling = 1, power = 1;  // C(i, j), n!/(n - j)!, scale^j
    for (int j = 0; j <= i; ++j) {
      point += (choose * power / falling) * derivatives[j];
      choose *= static_cast<double>(i - j) / (j + 1);
      falling *= n - j;
      power *= scale;
    }
    points.push_back(point);
  }
  return points;
}

CurveEnd read_end(const Fields& f, const char* name, bool leaves) {
  const bool at_start = f.text(std::string(name) + "_end") == "start";
  // The transition leaves the first curve and enters the second.
  return {f.curve(name), at_start, at_start == leaves};
}

}  // namespace

NurbsCurveForm transition(const CurveEnd& from, const CurveEnd& to, int continuity, double tension_from,
                          double tension_to) {
  for (const auto& [end, field] : {std::pair(&from, "from"), std::pair(&to, "to")})
    if (!(end->curve->domain().width() < kInfinity)) throw FieldError(field, "the curve is unbounded");
  const auto a = by_length(from, "from"), b = by_length(to, "to");
  const double distance = glm::length(b[0] - a[0]);
  if (!(distance > 0)) throw FieldError("to", "the two ends are one point: there is nothing between them");
  const int degree = 2 * continuity + 1;
  const auto begin = points_from(a, continuity, degree, tension_from * distance);
  const auto end = points_from(b, continuity, degree, -tension_to * distance);
  NurbsCurveForm form{degree, std::vector<double>(degree + 1, 0.0), {}, {}};
  form.knots.insert(form.knots.end(), degree + 1, 1.0);
  for (const Vec3& p : begin) form.points.emplace_back(p, 1);
  for (auto p = end.rbegin(); p != end.rend(); ++p) form.points.emplace_back(*p, 1);
  return form;
}

TypeDeclaration transition_curve_type() {
  return declare(Category::curve, "transition_curve",
                 "Curve from an end of one curve to an end of another, with the tangents (G1), curvatures (G2) and "
                 "changes of curvature (G3) of both; its parameter runs in 0..1.")
      .example("from: round, to: { type: segment, from: [4, 2], to: [9, 2] }")
      .field("from", reference({Category::curve}), "the curve that it leaves")
      .field("from_end", choice({"start", "end"}), "at which of its ends", "end")
      .field("to", reference({Category::curve}), "the curve that it enters")
      .field("to_end", choice({"start", "end"}), "at which of its ends", "start")
      .field("continuity", integer().between(1, kMaxContinuity), "of the joints: 1 for G1, 2 for G2, 3 for G3", "1")
      .field("tension", number().positive(),
             "length of the end derivatives, relative to the distance between the ends; larger goes on straighter", "1")
      .optional("tension_to", number().positive(), "another one at the second end")
      .shows({"control_polygon"})
      .built_by([](const Fields& f) {
        const double tension = f.number("tension");
        return NurbsCurve(transition(read_end(f, "from", true), read_end(f, "to", false), f.integer("continuity"),
                                     tension, f.has("tension_to") ? f.number("tension_to") : tension));
      });
}

}  // namespace lekalo::geometry
