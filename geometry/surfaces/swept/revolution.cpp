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
#include "geometry/expression/scalar_law.h"
#include "geometry/surfaces/analytic/parameter_range.h"

namespace lekalo::geometry {

namespace {

// The same with the distance from the axis multiplied by a law of the angle (Golovanov 2016, 3.3).
struct LawfulRevolution {
  CurvePtr of;
  Frame frame;
  ScalarLaw factor;

  template <class T>
  Triple<T> operator()(const T& u, const T& v) const {
    using std::cos;
    using std::sin;
    const T f = factor(v), cosine = f * cos(v), sine = f * sin(v);
    const Triple<T> c = curve_at(*of, u) - triple(frame.origin);
    const T x = dot(c, triple(frame.x)), y = dot(c, triple(frame.y)), z = dot(c, triple(frame.z));
    return triple(frame.origin) + ((x * cosine - y * sine) * triple(frame.x) +
                                   (x * sine + y * cosine) * triple(frame.y) + z * triple(frame.z));
  }
};

SurfacePtr revolved_by_law(const CurvePtr& curve, const Axis& axis, const Rectangle& domain, ScalarLaw factor) {
  SurfaceProperties properties = properties_along_u(*curve, domain.v);
  if (domain.u != curve->domain())
    throw FieldError("domain", "with a factor the whole curve is turned", "give 'start' and 'angle'");
  // Quarters, as of circles: enclosures over a whole turn tell nothing.
  for (int k = 1; k < 8; ++k)
    properties.breaks_v.insert(properties.breaks_v.end() - 1, domain.v.lo + domain.v.width() * k / 8);
  const double begin = factor(domain.v.lo), end = factor(domain.v.hi);
  if (std::abs(domain.v.width() - kTwoPi) <= 1e-14 && std::abs(end - begin) <= 1e-12 * std::abs(begin))
    properties.periods.v = kTwoPi;
  return std::make_shared<ComposedSurface<LawfulRevolution>>(
      LawfulRevolution{curve, frame_about(axis.through, axis.along), std::move(factor)}, std::move(properties));
}

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
      .optional("factor", formula({"v"}), "of the distance from the axis, as a formula of the angle v in radians")
      .built_by([](const Fields& f) {
        const CurvePtr curve = f.curve("of");
        const double start = f.number("start");
        const Rectangle natural{curve->domain(), {start, start + f.number("angle")}};
        try {
          const Rectangle domain = read_domain(f, natural, rules(*curve));
          if (f.has("factor"))
            return std::any(revolved_by_law(curve, f.axis("axis"), domain, ScalarLaw(f.get<Expression>("factor"))));
          return std::any(SurfacePtr(std::make_shared<RevolutionSurface>(curve, f.axis("axis"), domain)));
        } catch (const FieldError&) {
          throw;
        } catch (const std::invalid_argument& error) {
          throw FieldError("of", error.what());
        }
      });
}

}  // namespace lekalo::geometry
