// Extrusion of a curve along a vector (Golovanov 2016, 3.3.2).
#include "geometry/surfaces/swept/extrusion.h"

#include "geometry/composition.h"
#include "geometry/curves/operations/curve_parts.h"
#include "geometry/describe.h"
#include "geometry/surfaces/analytic/parameter_range.h"

namespace lekalo::geometry {

ExtrusionSurface::ExtrusionSurface(CurvePtr curve, const Vec3& along)
    : ExtrusionSurface(curve, along, {curve->domain(), {0, 1}}) {}

ExtrusionSurface::ExtrusionSurface(CurvePtr curve, const Vec3& along, const Rectangle& domain)
    : curve_(std::move(curve)), along_(along), domain_(domain) {
  if (!(glm::length(along) > 0)) throw std::invalid_argument("the vector of an extrusion must not be zero");
  check_domain(domain, {{curve_->domain(), Interval::entire()}, false, false});
}

template <class T>
Triple<T> ExtrusionSurface::at(const T& u, const T& v) const {
  return curve_at(*curve_, u) + v * triple(along_);
}

SurfaceJet ExtrusionSurface::evaluate(double u, double v, int order) const {
  return evaluate_surface_formula([this](const auto& a, const auto& b) { return at(a, b); }, u, v, order);
}

SurfaceEnclosure ExtrusionSurface::enclose(const Rectangle& box, int order) const {
  return enclose_surface_formula([this](const auto& a, const auto& b) { return at(a, b); }, box, order);
}

std::vector<SurfacePiece> ExtrusionSurface::pieces() const {
  if (const auto form = as_nurbs()) return bezier_pieces(*form, domain_);
  std::vector<SurfacePiece> pieces;
  for (const Interval& u : parts_of(*curve_, domain_.u)) pieces.push_back(plain_piece({u, domain_.v}));
  return pieces;
}

std::optional<NurbsSurfaceForm> ExtrusionSurface::as_nurbs() const {
  auto profile = curve_->as_nurbs();
  if (!profile) return std::nullopt;
  NurbsSurfaceForm form;
  form.degree_u = profile->degree;
  form.knots_u = std::move(profile->knots);
  form.maps_u = std::move(profile->maps);
  form.knots_v = {domain_.v.lo, domain_.v.lo, domain_.v.hi, domain_.v.hi};
  for (const Vec4& p : profile->points)
    for (const double v : {domain_.v.lo, domain_.v.hi}) form.points.push_back({Vec3(p) + (p.w * v) * along_, p.w});
  return form;
}

TypeDeclaration extrusion_surface_type() {
  return declare(Category::surface, "extrusion_surface",
                 "Surface that a curve sweeps when it is moved along a vector; the normal is (tangent of the curve) x "
                 "(vector).")
      .field("of", reference({Category::curve}), "the curve; its parameter is u")
      .field("along", vector(), "the vector; v runs from 0 at the curve to 1 at its end")
      .optional("domain", rectangle(), "part of the surface: u a part of the curve's parameters, v any range")
      .built_by([](const Fields& f) {
        const CurvePtr curve = f.curve("of");
        const Vec3& along = f.vec3("along");
        if (!(glm::length(along) > 0)) throw FieldError("along", "the vector of an extrusion must not be zero");
        const Rectangle domain =
            read_domain(f, {curve->domain(), {0, 1}}, {{curve->domain(), Interval::entire()}, false, false});
        return ExtrusionSurface(curve, along, domain);
      });
}

}  // namespace lekalo::geometry
