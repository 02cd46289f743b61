// Elliptic and hyperbolic paraboloid (Golovanov 2016, 3.2); |K| = 4/[a b (1 + 4 x^2/a^4 + 4 y^2/b^4)]^2.
#include "geometry/surfaces/analytic/paraboloid.h"

#include "geometry/curves/analytic/conic_forms.h"
#include "geometry/numerics/instruction_sets.h"
#include "geometry/surfaces/analytic/parameter_range.h"

namespace lekalo::geometry {

namespace {
const DomainRules kEllipticRules{{Interval::entire(), {0, kInfinity}}, true, false};
const DomainRules kHyperbolicRules{{Interval::entire(), Interval::entire()}, false, false};
}  // namespace

EllipticParaboloid::EllipticParaboloid(const Frame& frame, double a, double b, const Rectangle& domain)
    : MeridianFormula(frame, a, b, domain) {
  if (!(a > 0 && b > 0)) throw std::invalid_argument("the semi-axes of a paraboloid must be positive");
  check_domain(domain, kEllipticRules);
  set_quadric({{1, 1, 0}, -1, 0}, {1 / a, 1 / b, 1});
}

NurbsCurveForm EllipticParaboloid::meridian_form() const {
  return parabola_form(domain_.v, Vec3(0), {1, 0, 0}, {0, 1, 0});
}

void EllipticParaboloid::line_hits(const Line& line, const Interval& t, LineHits& hits) const {
  add_quadric_hits(line, t, hits, [](const Vec3& p) { return std::optional<double>(std::hypot(p.x, p.y)); });
}

HyperbolicParaboloid::HyperbolicParaboloid(const Frame& frame, double a, double b, const Rectangle& domain)
    : frame_(frame), a_(a), b_(b), domain_(domain) {
  if (!(a > 0 && b > 0)) throw std::invalid_argument("the semi-axes of a paraboloid must be positive");
  check_domain(domain, kHyperbolicRules);
}

bool HyperbolicParaboloid::bounded() const {
  return domain_.u.lo > -kInfinity && domain_.u.hi < kInfinity && domain_.v.lo > -kInfinity && domain_.v.hi < kInfinity;
}

template <class T>
Triple<T> HyperbolicParaboloid::at(const T& u, const T& v) const {
  return triple(frame_.origin) +
         ((a_ * u) * triple(frame_.x) + (b_ * v) * triple(frame_.y) + (sqr(u) - sqr(v)) * triple(frame_.z));
}

SurfaceJet HyperbolicParaboloid::evaluate(double u, double v, int order) const {
  return evaluate_surface_formula([this](const auto& a, const auto& b) { return at(a, b); }, u, v, order);
}

SurfaceEnclosure HyperbolicParaboloid::enclose(const Rectangle& box, int order) const {
  return enclose_surface_formula([this](const auto& a, const auto& b) { return at(a, b); }, box, order);
}

// Biquadratic with unit weights: u and v enter by degree 2 in separate terms, so the polar form is their sum.
std::optional<NurbsSurfaceForm> HyperbolicParaboloid::as_nurbs() const {
  if (!bounded()) return std::nullopt;
  const NurbsCurveForm along_u = parabola_form(domain_.u, frame_.origin, a_ * frame_.x, frame_.z);
  const NurbsCurveForm along_v = parabola_form(domain_.v, Vec3(0), b_ * frame_.y, -frame_.z);
  NurbsSurfaceForm form;
  form.degree_u = form.degree_v = 2;
  form.knots_u = along_u.knots;
  form.knots_v = along_v.knots;
  for (const Vec4& p : along_u.points)
    for (const Vec4& q : along_v.points) form.points.push_back({Vec3(p) + Vec3(q), 1});
  return form;
}

LEKALO_FUSED void HyperbolicParaboloid::meet_line(const Line& line, const Interval& range, LineHits& hits) const {
  const Vec3 scale(1 / a_, 1 / b_, 1);
  visit_quadric_hits({{1, -1, 0}, -1, 0}, moved_near(line, frame_.origin, frame_), scale, range, hits,
                     [&](double t, const Vec3& p) {
                       const auto u = within(domain_.u, p.x), v = within(domain_.v, p.y);
                       if (u && v) hits.add({t, *u, *v});
                     });
}

TypeDeclaration elliptic_paraboloid_type() {
  return declare(
             Category::surface, "elliptic_paraboloid",
             "Elliptic paraboloid x^2/a^2 + y^2/b^2 = z in its frame; the normal points to the convex side. Without "
             "heights or a domain it is unbounded.")
      .example("semi_axes: [1, 1], heights: [0, 2]")
      .field("frame", frame(), "placement: the vertex, the axis z, x and y along the semi-axes", "{}")
      .field("semi_axes", numbers().count(2, 2).positive(), "semi-axes a, b of the section z = 1")
      .optional("heights", range(), "the part between two heights z >= 0, which are lengths along the axis")
      .optional("domain", rectangle(), "in place of heights: u the angle in radians, v >= 0 with z = v^2")
      .built_by([](const Fields& f) {
        const std::vector<double>& axes = f.numbers("semi_axes");
        if (!(axes[0] > 0 && axes[1] > 0)) throw FieldError("semi_axes", "semi-axes must be positive");
        const Rectangle domain =
            read_heights(f, read_domain(f, EllipticParaboloid::kUnbounded, kEllipticRules), [](double z) {
              if (!(z >= 0)) throw FieldError("heights", "a paraboloid begins at the height 0, above these heights");
              return std::sqrt(z);
            });
        return EllipticParaboloid(f.frame(), axes[0], axes[1], domain);
      });
}

TypeDeclaration hyperbolic_paraboloid_type() {
  return declare(
             Category::surface, "hyperbolic_paraboloid",
             "Hyperbolic paraboloid (saddle) x^2/a^2 - y^2/b^2 = z in its frame; the normal points upward. Without a "
             "domain it is unbounded.")
      .example("semi_axes: [1, 1], domain: { u: [-1, 1], v: [-1, 1] }")
      .field("frame", frame(), "placement: the saddle point; the surface rises along x and falls along y", "{}")
      .field("semi_axes", numbers().count(2, 2).positive(), "a, b: z = 1 at x = a on the axis x, z = -1 at y = b on y")
      .optional("domain", rectangle(), "part of the surface: x = a u, y = b v")
      .built_by([](const Fields& f) {
        const std::vector<double>& axes = f.numbers("semi_axes");
        if (!(axes[0] > 0 && axes[1] > 0)) throw FieldError("semi_axes", "semi-axes must be positive");
        return HyperbolicParaboloid(f.frame(), axes[0], axes[1],
                                    read_domain(f, HyperbolicParaboloid::kUnbounded, kHyperbolicRules));
      });
}

}  // namespace lekalo::geometry
