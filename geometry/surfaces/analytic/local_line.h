// A line seen from a surface's frame without loss of figures.
//
// Formulas for hits lose as many digits as the line's origin is farther away than the surface is large. So the line
// starts anew at its point nearest to the surface (Haines, Gunther, Akenine-Moller, "Precision Improvements for
// Ray/Sphere Intersection", Ray Tracing Gems 2019). The new origin o + t d is formed with one rounding only (fused
// multiply-add): the moved line then deviates from the given one by an ulp of the coordinates near the surface, not of
// those of the distant origin.
#pragma once

#include <cmath>

#include "geometry/surface.h"
#include "geometry/vectors.h"

namespace lekalo::geometry {

// The line about its point nearest to `center`: point(t) = moved.origin + (t - start) moved.direction.
struct MovedLine {
  double start = 0;
  Vec3 origin{0};
  Vec3 direction{0};
  Vec3 at(double s) const { return origin + s * direction; }
  // The same in coordinates from another origin.
  MovedLine shifted(const Vec3& to) const { return {start, origin - to, direction}; }
};

// The line's point at t with one rounding in each coordinate. (Inline, as what else meets surfaces in closed form: who
// calls it is LEKALO_FUSED.)
inline Vec3 fused_at(const Line& line, double t) {
  const Vec3 &o = line.origin, &d = line.direction;
  return {std::fma(t, d.x, o.x), std::fma(t, d.y, o.y), std::fma(t, d.z, o.z)};
}

// 1 / |direction|^2, of rays, whose directions are of unit length but for rounding, without a quotient.
inline double inverse_square(const Vec3& direction) {
  const double square = glm::dot(direction, direction), off = square - 1;
  return std::abs(off) < 1e-8 ? 1 - off : 1 / square;
}

inline MovedLine moved_near(const Line& line, const Vec3& center) {
  const double t = glm::dot(center - line.origin, line.direction) * inverse_square(line.direction);
  return {t, fused_at(line, t), line.direction};
}

// The same in the coordinates of the frame; `center` is in world coordinates.
inline MovedLine moved_near(const Line& line, const Vec3& center, const Frame& frame) {
  const MovedLine moved = moved_near(line, center);
  return {moved.start, frame.to_local_point(moved.origin), frame.to_local_direction(moved.direction)};
}

// How far a shift of a line by a unit length, across it in any direction, moves its hit with a surface in the
// parameters: by at most `across`, and up to so far to either side in the direction `along`, in which the line leans.
struct HitShift {
  Vec2 along{0}, across{0};
  Vec2 largest() const { return glm::sqrt(along * along + across * across); }
};

// At the surface's point and first derivatives. Not finite where the line is tangent to the surface.
inline HitShift shift_of_hit(const SurfaceJet& at, const Vec3& direction) {
  // The line through p + e meets the tangent plane at p + e - (n . e / n . d) d.
  const Vec3 n = glm::cross(at.du(), at.dv());
  const double area2 = glm::dot(n, n);
  const Vec3 of_u = glm::cross(at.dv(), n) / area2, of_v = glm::cross(n, at.du()) / area2;
  const double per_slope = std::sqrt(area2) / glm::dot(n, direction);
  return {per_slope * Vec2(glm::dot(of_u, direction), glm::dot(of_v, direction)),
          Vec2(glm::length(of_u), glm::length(of_v))};
}

}  // namespace lekalo::geometry
