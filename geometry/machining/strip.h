// How a cutter lies on a surface where it touches: the width of the strip that it leaves within a height, and whether
// it cuts into the surface (Zavyalov, Leus, Skorospelov 1985, V.1).
//
// In the plane of the unit tangent tau and chi = n x tau, curvatures signed by the normal n on the cutter's side:
//
//   cutter   k_1 = 1/rho in the plane of n and the axis q, k_2 = sin f/((R - rho) + rho sin f) across, sin f = |q x n|
//   part     the forms S of the surface, S (1 - d S)^-1 of its offset by the allowance d
//   across   k_F = k_1 cos^2 p + k_2 sin^2 p, cos p = (q, n, tau)/|q x n|;   k_G that of the part along chi
//
// A strip of the width e leaves cusps of the height C = e^2 (k_F - k_G)/8. The cutter does not cut into the part where
// k_F > k_G in every direction: the least of their differences is the least eigenvalue of that of the forms.
#pragma once

#include "geometry/machining/cutter_place.h"

namespace lekalo::geometry {

// At one place. Infinite curvatures stand for a sharp corner.
struct ContactBend {
  double cutter_across = 0, part_across = 0;  // k_F, k_G along chi
  double min_difference = 0;                  // of the cutter's curvature above the part's, over all directions
  Vec2 across{0};                             // the change of (u, v) by a unit of length along chi

  // Of the strip within a height > 0; infinite where the cutter fits the part, 0 where it cuts into it.
  double width(double height) const;
  // Of a cusp between strips of this distance.
  double height(double width) const { return width * width * std::max(cutter_across - part_across, 0.0) / 8; }
};

// u, v of the contact's line at t. Throws FieldError (field of) where the surface has no curvature there.
ContactBend contact_bend(const SurfaceContact& contact, double t);

// The least differences and widths along a line, looked for among so many places.
struct StripReport {
  double min_difference = kInfinity, u = 0, v = 0;  // and where
  double min_width = kInfinity, max_width = 0;      // of the strip within the height; without one not known
  double max_band = 0, min_band = kInfinity;        // d: length of the change of (u, v) over the strip's width
};
StripReport strip_report(const SurfaceContact& contact, const Interval& range, double height);

}  // namespace lekalo::geometry
