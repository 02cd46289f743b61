// Circles in which tori meet planes, spheres, cylinders, cones and other tori (Golovanov 2016, 4.7 and 4.8, checks).
#pragma once

#include <optional>

#include "geometry/queries/quadrics/quadric_sections.h"

namespace lekalo::geometry {

// Coordinates as those of a SectionScale: about the middle of what matters.
struct TorusForm {
  Vec3 center{0}, axis{0, 0, 1};
  double major = 0, minor = 0;
};

// A meridian of a surface of revolution, in the half-plane of rho > 0 and z from `center` along `axis`: the circle with
// its own center (rho, z) and radius, or the line n . (rho, z) = h, n of unit length.
struct CoaxialMeridian {
  bool is_line = false;
  Vec2 center_or_normal{0};
  double radius_or_height = 0;
};

// Nothing where the plane cuts no circles, or where rounding or the tolerance would have to decide.
std::optional<PlaneIntersection> plane_section(const TorusForm& torus, const PlaneEquation& plane,
                                               const SectionScale& scale);

// With a surface about the same axis.
std::optional<PlaneIntersection> coaxial_section(const TorusForm& torus, const CoaxialMeridian& meridian,
                                                 const SectionScale& scale);

// With a sphere: about the axis, or filling the tube.
std::optional<PlaneIntersection> sphere_section(const TorusForm& torus, const Vec3& center, double radius,
                                                const SectionScale& scale);

}  // namespace lekalo::geometry
