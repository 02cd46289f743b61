// Sphere by longitude and latitude (Golovanov 2016, 3.2): x^2 + y^2 + z^2 = R^2, N = R^2 cos v (outward unit vector).
#include "geometry/surfaces/analytic/sphere.h"

#include "geometry/curves/analytic/conic_forms.h"
#include "geometry/surfaces/analytic/parameter_range.h"

namespace lekalo::geometry {

namespace {
const DomainRules kRules{{Interval::entire(), SphereSurface::kFull.v}, true, true};
}

SphereSurface::SphereSurface(const Frame& frame, double radius, const Rectangle& domain)
    : MeridianFormula(frame, 1, 1, domain), radius_(radius) {
  if (!(radius > 0)) throw std::invalid_argument("the radius of a sphere must be positive");
  check_domain(domain, kRules);
  whole_ = covers(domain, kFull);
  set_quadric({{1, 1, 1}, 0, -1}, Vec3(1 / radius));
}

NurbsCurveForm SphereSurface::meridian_form() const {
  NurbsCurveForm form = circle_form(domain_.v);
  for (Vec4& p : form.points) p = {radius_ * p.x, radius_ * p.y, 0, p.w};
  return form;
}

SphereSurface::MeridianTangent SphereSurface::meridian_near(const MeridianPoint<double>& near, double) const {
  const double scale = radius_ / std::sqrt(near.rho * near.rho + near.z * near.z);
  const double rho = scale * near.rho, z = scale * near.z;
  return {rho, z, -z, rho};
}

Vec3 SphereSurface::normal(double, double, const SurfaceJet& jet) const {
  return (normal_sign() / radius_) * (jet.point() - frame_.origin);
}

FootPoint SphereSurface::foot_point(const Vec3& near) const {
  // The length differs from the radius by rounding, so that one step of Newton's iteration replaces root and quotient.
  const Vec3 from_center = near - frame_.origin;
  const double square = glm::dot(from_center, from_center) * (scale_.x * scale_.x);
  const Vec3 outward =
      std::abs(square - 1) < 1e-8 ? (scale_.x * (1.5 - 0.5 * square)) * from_center : glm::normalize(from_center);
  return {frame_.origin + radius_ * outward, normal_sign() * outward};
}

void SphereSurface::line_hits(const Line& line, const Interval& t, LineHits& hits) const {
  add_quadric_hits(line, t, hits, [](const Vec3& p) {
    return std::optional<double>(std::atan2(p.z, std::sqrt(p.x * p.x + p.y * p.y)));
  });
}

TypeDeclaration sphere_surface_type() {
  return declare(Category::surface, "sphere_surface",
                 "Sphere, or a part of it between meridians and parallels; the normal points outward.")
      .field("frame", frame(), "placement: the center, the axis z through the poles, x at longitude 0", "{}")
      .field("radius", length().positive(), "radius")
      .field("domain", rectangle(), "part of the sphere: u longitude, v latitude, in radians (90 deg is accepted)",
             "{ u: [0, 2*pi], v: [-pi/2, pi/2] }")
      .built_by([](const Fields& f) {
        return SphereSurface(f.frame(), f.number("radius"), read_domain(f, SphereSurface::kFull, kRules));
      });
}

}  // namespace lekalo::geometry
