// r(u, v) = o + a rho(v) cos u x + b rho(v) sin u y + z(v) z: the derivative i times by u, j times by v is
//
//   a rho^(j) cos(u + i pi/2) x + b rho^(j) sin(u + i pi/2) y   (+ z^(j) z where i = 0).
//
// Its NURBS form is the tensor product of the circle's form in u and the meridian's in v (Golovanov 2016, 3.7; NURBS
// Book 8.5).
#include "geometry/surfaces/analytic/meridian_surface.h"

#include <cmath>

#include "geometry/curves/analytic/conic_forms.h"
#include "geometry/numerics/instruction_sets.h"
#include "geometry/surfaces/analytic/parameter_range.h"

namespace lekalo::geometry {

namespace {

// Calls result(i, j, r_ij) for all i + j <= order; the origin is left out. T is double or Interval.
template <class T, class Result>
void partial_derivatives(const Frame& frame, double a, double b, const T& u, const MeridianJet<T>& meridian, int order,
                         Result result) {
  using std::cos;
  using std::sin;
  T c = cos(u), s = sin(u);
  for (int i = 0; i <= order; ++i) {
    const Triple<T> across = (a * c) * triple(frame.x) + (b * s) * triple(frame.y);
    for (int j = 0; i + j <= order; ++j) {
      Triple<T> r = meridian.rho[j] * across;
      if (i == 0) r = r + meridian.z[j] * triple(frame.z);
      result(i, j, r);
    }
    const T turned = -s;
    s = c;
    c = turned;
  }
}

}  // namespace

SurfaceJet MeridianSurface::evaluate(double u, double v, int order) const {
  SurfaceJet jet(order);
  partial_derivatives(frame_, a_, b_, u, meridian(v, order), order, [&](int i, int j, const Triple<double>& r) {
    jet.d(i, j) = {r.x, r.y, r.z};
  });
  jet.values[0] += frame_.origin;
  return jet;
}

SurfaceJet MeridianSurface::evaluate_near(const Vec3& near, double u, double v, int order) const {
  // An elliptical parallel would stretch the rounding of the point along it.
  if (order > 1 || a_ != b_) return evaluate(u, v, order);
  const Vec3 from = near - frame_.origin;
  const Vec3 local = upright_ ? from : frame_.to_local_direction(from);
  const double length = std::sqrt(local.x * local.x + local.y * local.y);
  const double inverse = 1 / length, rho = a_ == 1 ? length : length / a_;
  const MeridianTangent m = meridian_near({rho, local.z}, v);
  // Near the axis rounding turns the direction.
  constexpr double kNearAxis = 1e-3;
  if (!(rho > kNearAxis * (std::abs(m.rho_v) + std::abs(m.z_v)))) return evaluate(u, v, order);
  const double scale = m.rho < 0 ? -a_ * inverse : a_ * inverse;
  const double c = scale * local.x, s = scale * local.y;
  SurfaceJet jet(order);
  jet.d(0, 0) = frame_.origin + direction({m.rho * c, m.rho * s, m.z});
  if (order == 0) return jet;
  jet.d(1, 0) = direction({-m.rho * s, m.rho * c, 0});
  jet.d(0, 1) = direction({m.rho_v * c, m.rho_v * s, m.z_v});
  return jet;
}

SurfaceEnclosure MeridianSurface::enclose(const Rectangle& box, int order) const {
  SurfaceEnclosure result;
  partial_derivatives(frame_, a_, b_, box.u, meridian(box.v, order), order,
                      [&](int i, int j, const Triple<Interval>& r) {
                        result.values[SurfaceJet::index(i, j)] = box_of(i + j == 0 ? r + triple(frame_.origin) : r);
                      });
  return result;
}

Vec3 MeridianSurface::normal(double u, double v) const {
  const MeridianJet<double> m = meridian(v, 1);
  double side = m.rho[0];
  // On the axis the side is that of the domain's inside.
  const double reach = std::abs(m.rho[1]) + std::abs(m.z[1]);
  if (std::abs(side) <= 1e-14 * reach) {
    const double step = bounded() ? 1e-3 * domain_.v.width() : 1e-3;
    side = meridian(domain_.v.middle() < v ? v - step : v + step, 0).rho[0];
  }
  const Vec3 local(b_ * m.z[1] * std::cos(u), a_ * m.z[1] * std::sin(u), -a_ * b_ * m.rho[1]);
  return (side < 0 ? -normal_sign() : normal_sign()) * glm::normalize(frame_.direction(local));
}

bool MeridianSurface::is_pole(double v) const {
  if (!(std::abs(v) < kInfinity)) return false;
  const MeridianJet<double> m = meridian(v, 1);
  const double width = bounded() ? domain_.v.width() : 1.0;
  return std::abs(m.rho[0]) <= 1e-14 * (width * (std::abs(m.rho[1]) + std::abs(m.z[1])));
}

DegenerateEdges MeridianSurface::degenerate_edges() const {
  return {false, false, is_pole(domain_.v.lo), is_pole(domain_.v.hi)};
}

std::optional<NurbsSurfaceForm> MeridianSurface::as_nurbs() const {
  if (!bounded()) return std::nullopt;
  const NurbsCurveForm circle = circle_form(domain_.u);
  NurbsCurveForm profile = meridian_form();
  // The meridian meets the axis exactly where it should, so that poles are exactly one point.
  const DegenerateEdges poles = degenerate_edges();
  if (poles.v_min) profile.points.front().x = 0;
  if (poles.v_max) profile.points.back().x = 0;

  NurbsSurfaceForm form;
  form.degree_u = circle.degree;
  form.degree_v = profile.degree;
  form.knots_u = circle.knots;
  form.knots_v = profile.knots;
  form.maps_u = circle.maps;
  form.maps_v = profile.maps;
  for (const Vec4& c : circle.points) {
    for (const Vec4& m : profile.points) {
      const double weight = c.w * m.w;
      const Vec3 local(a_ * m.x * c.x, b_ * m.x * c.y, m.y * c.w);
      form.points.push_back({weight * frame_.origin + frame_.direction(local), weight});
    }
  }
  return form;
}

void MeridianSurface::set_quadric(const Quadric& quadric, const Vec3& scale) {
  quadric_ = quadric;
  scale_ = scale;
  const Interval& v = domain_.v;
  const bool has_lo = v.lo > -kInfinity, has_hi = v.hi < kInfinity;
  // Any place but a pole or apex tells the side, on one nappe.
  const double some = has_lo ? (has_hi ? v.middle() : v.lo + 1) : has_hi ? v.hi - 1 : 0;
  const Vec3 from = frame_.to_local_direction(evaluate(0, some, 0).point() - frame_.origin);
  side_ = glm::dot(frame_.direction(half_gradient(scale_ * from)), normal(0, some)) < 0 ? -1 : 1;
  has_closest_point_ = domain_.u.width() >= kTwoPi;
  inside_ = around_ = Interval::entire();
  if (whole_) return;
  const auto height = [&](double at) { return scale_.z * meridian(at, 0).z[0]; };
  const auto spanned = [&](double a, double b) { return Interval(std::min(a, b), std::max(a, b)); };
  inside_ = spanned(height(v.lo), height(v.hi));
  if (has_lo && has_hi) {
    // A hit beyond the border counts within kShallowReach. Heights rise or fall all along v, but beyond a pole or
    // vertex.
    const double reach = 2 * kShallowReach * v.width();
    const Interval farther = spanned(height(v.lo - reach), height(v.hi + reach));
    around_ = {std::min(inside_.lo, farther.lo), std::max(inside_.hi, farther.hi)};
  }
  // More than the rounding of heights and parameters.
  constexpr double kSlack = 1e-9;
  const auto size = [](double z) { return std::abs(z) < kInfinity ? std::abs(z) : 0.0; };
  const double slack = kSlack * (size(inside_.lo) + size(inside_.hi));
  inside_ = {inside_.lo + slack, inside_.hi - slack};
  around_ = {around_.lo - slack, around_.hi + slack};
}

// One step of Newton's iteration along the gradient.
FootPoint MeridianSurface::foot_point(const Vec3& near) const {
  const Vec3 from = near - frame_.origin;
  const Vec3 p = scale_ * (upright_ ? from : frame_.to_local_direction(from));
  const Vec3 half = half_gradient(p);
  const double square = glm::dot(half, half);
  const Vec3 step = (0.5 * quadric_.value(p) / square) * half;
  const double sign = normal_sign() * side_ / std::sqrt(square);
  return {near - direction(step), direction(sign * half)};
}

LEKALO_FUSED void MeridianSurface::add_quadric_hits(const Line& line, const Interval& range, LineHits& hits,
                                                    std::optional<double> (*parameter)(const Vec3&)) const {
  const bool by_height = has_closest_point_ && !hits.wants_parameters();
  visit_quadric_hits(quadric_, local_line(line, frame_.origin), scale_, range, hits, [&](double t, const Vec3& p) {
    const Place place = by_height ? place_by_height(p.z) : Place::at_border;
    if (place == Place::inside)
      hits.add({t, 0, 0});
    else if (place == Place::outside)
      return;
    else if (const auto v = parameter(p))
      add_hit(hits, line, t, std::atan2(p.y, p.x), *v);
  });
}

void MeridianSurface::add_hit(LineHits& hits, const Line& line, double t, double u, double v) const {
  auto in_v = within(domain_.v, v);
  if (!in_v && std::max(domain_.v.lo - v, v - domain_.v.hi) < kShallowReach * domain_.v.width()) {
    // Rounding of a line that hardly crosses the surface moves the hit far: through an edge it must meet both faces.
    const SurfaceJet jet = evaluate(u, v, 1);
    const double size = glm::length(jet.point()) + glm::length(frame_.origin);
    const double slack = kShallowSlack * size * shift_of_hit(jet, line.direction).largest().y;
    in_v = within(domain_.v, v, std::min(slack, kShallowReach * domain_.v.width()));
  }
  if (!in_v) return;
  const auto in_u = angle_within(domain_.u, u);
  if (in_u) hits.add({t, *in_u, *in_v});
}

}  // namespace lekalo::geometry
