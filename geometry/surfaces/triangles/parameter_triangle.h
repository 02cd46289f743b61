// Barycentric coordinates in the plane of parameters (Golovanov 2016, 3.10 and 3.12).
#pragma once

#include <array>

#include "geometry/surfaces/triangles/triangular_net.h"

namespace lekalo::geometry {

// d(p, q, r) = |p q r; 1 1 1|: twice the signed area, positive where they turn left (3.12.1).
double homogeneous_determinant(const Vec2& p, const Vec2& q, const Vec2& r);
// The same of weighted points (u, v, w): w = 1 for points, 0 for vectors.
double homogeneous_determinant(const Vec3& p, const Vec3& q, const Vec3& r);

// A triangle in the plane of parameters u, v; its corners must not be collinear.
struct ParameterTriangle {
  std::array<Vec2, 3> corners{Vec2(1, 0), Vec2(0, 1), Vec2(0, 0)};

  double determinant() const { return homogeneous_determinant(corners[0], corners[1], corners[2]); }
  // a + b + c = 1; all >= 0 inside (3.10.4).
  Barycentric coordinates(const Vec2& point) const;
  // a + b + c = 0 (3.10.9).
  Barycentric direction(const Vec2& vector) const;
  Vec2 point(const Barycentric& t) const { return t.x * corners[0] + t.y * corners[1] + t.z * corners[2]; }
  // In the triangle or on its border, decided exactly.
  bool contains(const Vec2& point) const;
};

// Whether a point belongs to the half-open region of a convex polygon, counterclockwise or clockwise: its left and
// lower sides do, its right and upper ones do not, a corner does with both its sides; so that every point of a region
// cut into polygons is in exactly one (3.12). Decided exactly; a polygon without an inside has no points.
bool in_half_open_region(std::span<const Vec2> polygon, const Vec2& point);

}  // namespace lekalo::geometry
