// Curves that cross themselves in a point where the surfaces touch, in the form of an eight. A search knows them only
// to the root of rounding near that point. Each is one branch, from the contact to the contact and through it.
//
// A cylinder cuts a sphere that it touches from within in a hippopede, Viviani's curve where it goes through the center
// (Fischer, "Mathematical Models", 1986). With the radii R = r + d, the distance d of the axis from the center, the
// direction n from the center to the contact, the cylinder's axis a, and m = a x n it is
//
//   d n + r (n cos t + m sin t) + 2 sqrt(r d) sin(t/2) a,    0 <= t <= 4 pi,
//
// since R^2 - |d n + r e(t)|^2 = 2 r d (1 - cos t).
//
// A plane along the axis cuts a torus that it touches at the inner equator in a spiric line of Perseus that is a
// hippopede, too (Proclus). With v = t + pi on the torus, and rho = R - r cos t,
//
//   (R - r) n + sqrt(2 r) sin(t/2) sqrt(2 R - r - r cos t) m - r sin t a,    0 <= t <= 4 pi,
//
// since rho^2 - (R - r)^2 = r (1 - cos t) (2 R - r - r cos t).
#pragma once

#include <optional>

#include "geometry/contour.h"
#include "geometry/queries/quadrics/canonical_surface.h"

namespace lekalo::geometry {

// None for other surfaces, or where a border or pole may be on the curve. `size`: of both.
std::optional<Contours> hippopede(const CanonicalSurface& a, const CanonicalSurface& b, double size);

// The plane is unbounded, its normal of unit length; contours have one image.
std::optional<Contours> hippopede_section(const CanonicalSurface& torus, const Vec3& origin, const Vec3& normal,
                                          double size);

}  // namespace lekalo::geometry
