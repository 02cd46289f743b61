// Ellipsoid (Golovanov 2016, 3.2): K = [a b c (x^2/a^4 + y^2/b^4 + z^2/c^4)]^-2.
#include "geometry/surfaces/analytic/ellipsoid.h"

#include "geometry/curves/analytic/conic_forms.h"
#include "geometry/surfaces/analytic/parameter_range.h"

namespace lekalo::geometry {

namespace {
const DomainRules kRules{{Interval::entire(), Ellipsoid::kFull.v}, true, true};
}

Ellipsoid::Ellipsoid(const Frame& frame, const Vec3& semi_axes, const Rectangle& domain)
    : MeridianFormula(frame, semi_axes.x, semi_axes.y, domain), c_(semi_axes.z) {
  if (!(semi_axes.x > 0 && semi_axes.y > 0 && semi_axes.z > 0))
    throw std::invalid_argument("the semi-axes of an ellipsoid must be positive");
  check_domain(domain, kRules);
  whole_ = covers(domain, kFull);
  set_quadric({{1, 1, 1}, 0, -1}, 1.0 / semi_axes);
}

NurbsCurveForm Ellipsoid::meridian_form() const {
  NurbsCurveForm form = circle_form(domain_.v);
  for (Vec4& p : form.points) p.y *= c_;
  return form;
}

void Ellipsoid::line_hits(const Line& line, const Interval& t, LineHits& hits) const {
  add_quadric_hits(line, t, hits, [](const Vec3& p) {
    return std::optional<double>(std::atan2(p.z, std::sqrt(p.x * p.x + p.y * p.y)));
  });
}

TypeDeclaration ellipsoid_type() {
  return declare(Category::surface, "ellipsoid", "Ellipsoid with its axes along those of its frame; normal outward.")
      .example("semi_axes: [3, 2, 1]")
      .field("frame", frame(), "placement: the center and the directions of the axes", "{}")
      .field("semi_axes", numbers().count(3, 3).positive(), "semi-axes a, b, c along x, y, z")
      .field("domain", rectangle(), "part of the surface: u longitude, v latitude (of the sphere that is stretched)",
             "{ u: [0, 2*pi], v: [-pi/2, pi/2] }")
      .built_by([](const Fields& f) {
        return Ellipsoid(f.frame(), read_semi_axes(f), read_domain(f, Ellipsoid::kFull, kRules));
      });
}

}  // namespace lekalo::geometry
