#include "geometry/curves/analytic/conic_forms.h"

#include <cmath>

namespace lekalo::geometry {

namespace {

// Cosine and sine, exact at doubles that stand for multiples of a right angle.
Vec2 circle_point(double t) {
  const double quarters = t / (0.5 * kPi);
  const double nearest = std::nearbyint(quarters);
  if (std::abs(quarters - nearest) <= 1e-15 * std::abs(nearest)) {
    constexpr double kCosines[4] = {1, 0, -1, 0};
    const int k = static_cast<int>(std::fmod(nearest, 4.0) + 4) % 4;
    return {kCosines[k], kCosines[(k + 3) % 4]};
  }
  return {std::cos(t), std::sin(t)};
}

// A quadratic through at(t_0), at(t_1), ..., with the homogeneous middle points (at(m), weight(d/2)).
template <class Point, class Weight>
NurbsCurveForm conic_form(const Interval& range, int spans, ParameterMap::Kind kind, Point at, Weight weight) {
  NurbsCurveForm form;
  form.degree = 2;
  const auto knot = [&](int k) { return k == spans ? range.hi : range.lo + range.width() * k / spans; };
  form.knots.push_back(range.lo);
  for (int k = 0; k <= spans; ++k) {
    form.knots.insert(form.knots.end(), 2, knot(k));
    const Vec2 p = at(knot(k));
    form.points.push_back({p, 0, 1});
    if (k == spans) break;
    const Vec2 middle = at(0.5 * (knot(k) + knot(k + 1)));
    form.points.push_back({middle, 0, weight(0.5 * (knot(k + 1) - knot(k)))});
    form.maps.push_back({kind, knot(k), knot(k + 1)});
  }
  form.knots.push_back(range.hi);
  return form;
}

}  // namespace

NurbsCurveForm circle_form(const Interval& t) {
  const int spans = std::max(1, static_cast<int>(std::ceil(t.width() / (0.5 * kPi) - 1e-9)));
  NurbsCurveForm form =
      conic_form(t, spans, ParameterMap::Kind::half_angle, circle_point, [](double half) { return std::cos(half); });
  if (t.width() >= kTwoPi * (1 - 1e-15)) form.points.back() = form.points.front();
  return form;
}

NurbsCurveForm hyperbola_form(const Interval& t) {
  const int spans = std::max(1, static_cast<int>(std::ceil(t.width() / 2 - 1e-9)));
  return conic_form(
      t, spans, ParameterMap::Kind::hyperbolic, [](double x) { return Vec2(std::cosh(x), std::sinh(x)); },
      [](double half) { return std::cosh(half); });
}

NurbsCurveForm parabola_form(const Interval& t, const Vec3& a, const Vec3& b, const Vec3& c) {
  NurbsCurveForm form;
  form.degree = c == Vec3(0) ? 1 : 2;
  form.knots.insert(form.knots.end(), form.degree + 1, t.lo);
  form.knots.insert(form.knots.end(), form.degree + 1, t.hi);
  form.points.push_back({a + t.lo * (b + t.lo * c), 1});
  // The polar form a + b (s + t)/2 + c s t at (lo, hi).
  if (form.degree == 2) form.points.push_back({a + t.middle() * b + t.lo * t.hi * c, 1});
  form.points.push_back({a + t.hi * (b + t.hi * c), 1});
  return form;
}

}  // namespace lekalo::geometry
