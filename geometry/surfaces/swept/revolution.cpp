// Surface of revolution (Golovanov 2016, 3.3.3). In a frame (p; x, y, z) with z along the axis, c - p = (X, Y, Z) and
//
//   r = p + (X cos v - Y sin v) x + (X sin v + Y cos v) y + Z z.
//
// The NURBS form is the tensor product with the circle's (NURBS Book 8.5).
#include "geometry/surfaces/swept/revolution.h"

#include <cmath>

#include "geometry/composition.h"
#include "geometry/curves/analytic/conic_forms.h"
#include "geometry/curves/operations/curve_parts.h"
#include "geometry/surfaces/analytic/parameter_range.h"

namespace lekalo::geometry {

namespace {

DomainRules rules(const Curve& curve) { return {{curve.domain(), Interval::entire()}, false, true}; }

}  // namespace

RevolutionSurface::RevolutionSurface(CurvePtr curve, const Axis& axis, double angle)
    : RevolutionSurface(curve, axis, Rectangle{curve->domain(), {0, angle}}) {}

RevolutionSurface::RevolutionSurface(CurvePtr curve, const Axis& axis, const Rectangle& domain)
    : curve_(std::move(curve)), frame_(frame_about(axis.through, axis.along)), domain_(domain) {
  check_domain(domain, rules(*curve_));
  bool off_axis = false;
  for (int k = 0; k <= 8; ++k) off_axis = off_axis || !on_axis(domain.u.lo + domain.u.width() * k / 8);
  if (!off_axis) throw std::invalid_argument("the curve lies on the axis of revolution");
}

template <class T>
Triple<T> RevolutionSurface::at(const T& u, const T& v) const {
  using std::cos;
  using std::sin;
  const T cosine = cos(v), sine = sin(v);
  const Triple<T> c = curve_at(*curve_, u) - triple(frame_.origin);
  const T x = dot(c, triple(frame_.x)), y = dot(c, triple(frame_.y)), z = dot(c, triple(frame_.z));
  return triple(frame_.origin) + ((x * cosine - y * sine) * triple(frame_.x) +
                                  (x * sine + y * cosine) * triple(frame_.y) + z * triple(frame_.z));
}

SurfaceJet RevolutionSurface::evaluate(double u, double v, int order) const {
  return evaluate_surface_formula([this](const auto& a, const auto& b) { return at(a, b); }, u, v, order);
}

SurfaceEnclosure RevolutionSurface::enclose(const Rectangle& box, int order) const {
  return enclose_surface_formula([this](const auto& a, const auto& b) { return at(a, b); }, box, order);
}

// Within rounding of the axis, that is, of the coordinates that the curve's point was computed from.
bool RevolutionSurface::on_axis(double u) const {
  const CurveJet c = curve_->evaluate(u, 1);
  const Vec3 local = frame_.to_local_point(c.d[0]);
  const double size = glm::length(c.d[0]) + glm::length(frame_.origin) + glm::length(c.d[1]) * domain_.u.width();
  return std::hypot(local.x, local.y) <= 1e-14 * size;
}

DegenerateEdges RevolutionSurface::degenerate_edges() const {
  return {on_axis(domain_.u.lo), on_axis(domain_.u.hi), false, false};
}

std::vector<SurfacePiece> RevolutionSurface::pieces() const {
  if (const auto form = as_nurbs()) return bezier_pieces(*form, domain_);
  std::vector<SurfacePiece> pieces;
  const NurbsCurveForm circle = circle_form(domain_.v);
  for (const Interval& u : parts_of(*curve_, domain_.u))
    for (const ParameterMap& span : circle.maps) pieces.push_back(plain_piece({u, {span.lo, span.hi}}));
  return pieces;
}

std::optional<NurbsSurfaceForm> RevolutionSurface::as_nurbs() const {
  auto profile = curve_->as_nurbs();
  if (!profile) return std::nullopt;
  const NurbsCurveForm circle = circle_form(domain_.v);
  NurbsSurfaceForm form;
  form.degree_u = profile->degree;
  form.degree_v = circle.degree;
  form.knots_u = std::move(profile->knots);
  form.maps_u = std::move(profile->maps);
  form.knots_v = circle.knots;
  form.maps_v = circle.maps;
  const Vec4 *first = &profile->points.front(), *last = &profile->points.back();
  for (const Vec4& p : profile->points) {
    Vec3 c = frame_.to_local_direction(Vec3(p) - p.w * frame_.origin);
    // An end of a clamped curve on the axis is exactly on it, so that the pole is exactly one point.
    if (&p == first || &p == last) {
      const double size = glm::length(Vec3(p)) + std::abs(p.w) * glm::length(frame_.origin);
      if (std::hypot(c.x, c.y) <= 1e-14 * size) c.x = c.y = 0;
    }
    for (const Vec4& q : circle.points) {
      const Vec3 local(c.x * q.x - c.y * q.y, c.x * q.y + c.y * q.x, c.z * q.w);
      form.points.push_back({p.w * q.w * frame_.origin + frame_.direction(local), p.w * q.w});
    }
  }
  return form;
}

TypeDeclaration revolution_surface_type() {
  return declare(Category::surface, "revolution_surface",
                 "Surface that a curve sweeps when it is turned about an axis. The normal of a curve that runs upward "
                 "beside the axis points inward: use reversed, or let the curve run downward.")
      .field("of", reference({Category::curve}), "the curve; its parameter is u")
      .field("axis", axis(), "the axis of rotation, by the right-hand rule", "z")
      .field("angle", angle().positive().at_most(kTwoPi), "how far the curve is turned", "360")
      .field("start", angle(), "angle at which the surface begins; 0 is the curve itself", "0")
      .optional("domain", rectangle(),
                "part of the surface, in place of angle and start: u a part of the curve's parameters, v in radians")
      .built_by([](const Fields& f) {
        const CurvePtr curve = f.curve("of");
        const double start = f.number("start");
        const Rectangle natural{curve->domain(), {start, start + f.number("angle")}};
        try {
          return RevolutionSurface(curve, f.axis("axis"), read_domain(f, natural, rules(*curve)));
        } catch (const FieldError&) {
          throw;
        } catch (const std::invalid_argument& error) {
          throw FieldError("of", error.what());
        }
      });
}

}  // namespace lekalo::geometry
