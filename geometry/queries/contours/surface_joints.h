// How the domain of a surface is joined to itself along its borders: periods, seams, and borders that run along each
// other the other way round, as those of Moebius' band and Klein's bottle do; and where a surface is one-to-one.
//
// The surface goes on across such a border: a place beyond it is a place inside, moved. Two places that a motion takes
// to one are the same place of the surface.
#pragma once

#include <vector>

#include "geometry/queries/contours/contour_equations.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// (u, v) to (sign_u u + shift_u, sign_v v + shift_v).
struct DomainMotion {
  double sign_u = 1, shift_u = 0, sign_v = 1, shift_v = 0;

  Vec2 of(const Vec2& place) const { return {sign_u * place.x + shift_u, sign_v * place.y + shift_v}; }
  Rectangle of(const Rectangle& box) const;
  Rectangle back(const Rectangle& box) const;
};

class SurfaceJoints {
 public:
  // Borders join where they coincide to `tolerance`, a length, after a shift or mirroring of the parameter along them
  // (and half of its period). Others are not known.
  SurfaceJoints(const Surface& surface, double tolerance);

  // The identity first, then across each border, then across two.
  const std::vector<DomainMotion>& motions() const { return motions_; }
  // Whether the surface goes on beyond the upper border of u or v.
  bool goes_on_u() const { return goes_on_u_; }
  bool goes_on_v() const { return goes_on_v_; }
  // Whether a motion takes the second place to the first, to `near` of the domain's sides.
  bool is_same_place(const Vec2& a, const Vec2& b, double near) const;
  // The least distance of the first from the second moved, of the domain's sides.
  double apart(const Vec2& a, const Vec2& b) const;

  // Whether the surface is one-to-one on a rectangle, which may lie across borders that join, with proof: for two
  // places p, q of it r(p) - r(q) = J (p - q) with J in the hull of the derivatives' ranges, and a matrix C makes
  // |I - C J| < 1 for all of these. Across a border or crease where only the point goes on C J is formed on each side:
  // the matrices that satisfy this are convex.
  bool is_one_to_one(const Rectangle& rectangle, KnownEnclosures& known) const;

 private:
  void find_joints(bool of_u, double tolerance);

  const Surface& surface_;
  Rectangle domain_;
  std::vector<Rectangle> pieces_;
  std::vector<DomainMotion> motions_;
  bool goes_on_u_ = false, goes_on_v_ = false;
};

}  // namespace lekalo::geometry
