// Circular cone and cylinder (Golovanov 2016, 3.2): x^2 + y^2 = rho^2, rho = r + z tan(gamma).
//
// In the coordinates (x, y, rho) along a line the cone is x^2 + y^2 - rho^2 = 0 whatever its half-angle, and the line
// is still a line. A line steeper than the generatrices meets each nappe once, any other meets one nappe twice or
// never: that decides the nappe of a hit, so that at the apex, where both roots are equal, each nappe gets its own.
#include "geometry/surfaces/analytic/cone.h"

#include "geometry/curves/analytic/conic_forms.h"
#include "geometry/numerics/instruction_sets.h"
#include "geometry/surfaces/analytic/parameter_range.h"

namespace lekalo::geometry {

ConeSurface::ConeSurface(const Frame& frame, double radius, double top_radius, double height, const Rectangle& domain)
    : MeridianFormula(frame, 1, 1, domain), radius_(radius), widening_(top_radius - radius), height_(height) {
  if (radius == 0 && widening_ == 0) throw std::invalid_argument("a cone needs a radius or a half-angle");
  if (!(height != 0)) throw std::invalid_argument("the height of a cone must not be zero");
  check_domain(domain, {});
  // On both nappes the height of a hit does not tell its side, and at an apex there is no gradient.
  if (convex_sides(0, 0).front || convex_sides(0, 0).back) {
    const double slope = widening_ / height;
    set_quadric({{1, 1, -slope * slope}, -2 * radius * slope, -radius * radius}, Vec3(1));
  }
}

NurbsCurveForm ConeSurface::meridian_form() const {
  return parabola_form(domain_.v, {radius_, 0, 0}, {widening_, height_, 0});
}

// Where on the axis figures matter most: the apex if the domain reaches it.
Vec3 ConeSurface::nearest_axis_point() const {
  const double v = domain_.v.clamp(widening_ == 0 ? 0.0 : -radius_ / widening_);
  return frame_.point({0, 0, height_ * v});
}

Sides ConeSurface::convex_sides(double, double) const {
  // An unbounded cylinder has no change of radius to multiply infinity with.
  const double lo = widening_ == 0 ? radius_ : radius_ + widening_ * domain_.v.lo,
               hi = widening_ == 0 ? radius_ : radius_ + widening_ * domain_.v.hi;
  if (std::min(lo, hi) < 0 && std::max(lo, hi) > 0) return {};
  const bool outward = height_ > 0;
  return {.front = outward, .back = !outward};
}

FootPoint ConeSurface::foot_point(const Vec3& near) const {
  const Vec3 p = frame_.to_local_point(near);
  if (p.x == 0 && p.y == 0) return {near, normal(0, p.z / height_)};  // the apex
  return MeridianSurface::foot_point(near);
}

LEKALO_FUSED void ConeSurface::meet_line(const Line& line, const Interval& t, LineHits& hits) const {
  const MovedLine moved = local_line(line, nearest_axis_point());
  const bool cylinder = widening_ == 0;
  const double slope = widening_ / height_, scale = cylinder ? std::abs(radius_) : 1.0;
  const Vec3 o(moved.origin.x / scale, moved.origin.y / scale, cylinder ? 0.0 : radius_ + slope * moved.origin.z);
  const Vec3 d(moved.direction.x / scale, moved.direction.y / scale, slope * moved.direction.z);
  const Quadric quadric = cylinder ? Quadric{{1, 1, 0}, 0, -1} : Quadric{{1, 1, -1}, 0, 0};
  const QuadricRoots roots = quadric_roots(quadric, o, d);
  const Interval near{t.lo - moved.start, t.hi - moved.start};
  const bool by_height = has_closest_point() && !hits.wants_parameters();
  const auto add = [&](int i, double nappe) {
    if (hits.is_enough() || !roots.may_lie_in(near, i)) return;
    // Is there anything of this nappe in the domain?
    const double lo = radius_ + widening_ * domain_.v.lo, hi = radius_ + widening_ * domain_.v.hi;
    if (!cylinder && !(std::max(nappe * lo, nappe * hi) > 0)) return;
    const QuadricHit hit = quadric_hit(quadric, d, roots, i);
    const double at = moved.start + hit.s;
    if (!t.contains(at)) return;
    const double z = moved.at(hit.s).z;
    const Place place = by_height ? place_by_height(z) : Place::at_border;
    if (place == Place::inside)
      hits.add({at, 0, 0});
    else if (place == Place::at_border)
      add_hit(hits, line, at, std::atan2(nappe * hit.point.y, nappe * hit.point.x), z / height_);
  };
  if (cylinder) {
    for (int i = 0; i < roots.count; ++i) add(i, radius_ < 0 ? -1 : 1);
  } else if (roots.count == 2 && roots.square < 0) {
    add(0, d.z > 0 ? -1 : 1);
    add(1, d.z > 0 ? 1 : -1);
  } else {
    double rho = 0;
    for (int i = 0; i < roots.count; ++i) rho += quadric_hit(quadric, d, roots, i).point.z;
    for (int i = 0; i < roots.count; ++i) add(i, rho < 0 ? -1 : 1);
  }
}

TypeDeclaration cone_surface_type() {
  return declare(Category::surface, "cone_surface",
                 "Lateral surface of a circular cone or frustum; the normal points outward. Without a height it is "
                 "unbounded and has both nappes.")
      .example("radius: 1, height: 2")
      .field("frame", frame(), "placement: the center of the base circle, the axis z, x at the angle 0", "{}")
      .field("radius", length().non_negative(), "radius of the base circle (v = 0)")
      .optional("height", length().positive(), "distance of the top circle (v = 1) from the base, along the axis")
      .optional("top_radius", length().non_negative(),
                "radius of the top circle; 0, the apex, unless half_angle is given")
      .optional("half_angle", angle().between(-89.9999 * kPi / 180, 89.9999 * kPi / 180),
                "angle between generatrix and axis, positive where the cone widens upward; in place of top_radius")
      .optional("domain", rectangle(),
                "part of the surface: u the angle in radians, v from 0 at the base to 1 at the height (of an unbounded "
                "cone the length along the axis); { u: [0, 2*pi], v: [0, 1] } by default")
      .built_by([](const Fields& f) {
        const double radius = f.number("radius");
        if (f.has("top_radius") && f.has("half_angle"))
          throw FieldError("half_angle", "a cone has a top_radius or a half_angle, not both");
        const bool bounded = f.has("height");
        if (!bounded && !f.has("half_angle"))
          throw FieldError("height", "a cone without a height is unbounded and needs a half_angle", "give a height");
        const double height = bounded ? f.number("height") : 1.0;
        double top = f.has("top_radius") ? f.number("top_radius") : 0.0;
        if (f.has("half_angle")) top = radius + height * std::tan(f.number("half_angle"));
        if (radius == 0 && top == 0) throw FieldError("radius", "the cone has no width: both radii are zero");
        const Rectangle natural = bounded ? ConeSurface::kFull : CylinderSurface::kUnbounded;
        return ConeSurface(f.frame(), radius, top, height, read_domain(f, natural, {}));
      });
}

TypeDeclaration cylinder_surface_type() {
  return declare(Category::surface, "cylinder_surface",
                 "Lateral surface of a circular cylinder; the normal points outward. Without a height it is unbounded.")
      .example("radius: 1, height: 2")
      .field("frame", frame(), "placement: the center of the base circle, the axis z, x at the angle 0", "{}")
      .field("radius", length().positive(), "radius")
      .optional("height", length().positive(), "length along the axis")
      .optional("domain", rectangle(),
                "part of the surface: u the angle in radians, v from 0 at the base to 1 at the height (of an unbounded "
                "cylinder the length along the axis); { u: [0, 2*pi], v: [0, 1] } by default")
      .built_by([](const Fields& f) {
        const bool bounded = f.has("height");
        const Rectangle natural = bounded ? ConeSurface::kFull : CylinderSurface::kUnbounded;
        return CylinderSurface(f.frame(), f.number("radius"), bounded ? f.number("height") : 1.0,
                               read_domain(f, natural, {}));
      });
}

}  // namespace lekalo::geometry
