#include "geometry/surfaces/triangles/parameter_triangle.h"

#include "geometry/tessellation/predicates.h"

namespace lekalo::geometry {

double homogeneous_determinant(const Vec2& p, const Vec2& q, const Vec2& r) {
  return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

double homogeneous_determinant(const Vec3& p, const Vec3& q, const Vec3& r) { return glm::dot(p, glm::cross(q, r)); }

Barycentric ParameterTriangle::coordinates(const Vec2& p) const {
  const auto& [a, b, c] = corners;
  const double whole = determinant();
  return {homogeneous_determinant(p, b, c) / whole, homogeneous_determinant(a, p, c) / whole,
          homogeneous_determinant(a, b, p) / whole};
}

Barycentric ParameterTriangle::direction(const Vec2& t) const {
  const auto& [a, b, c] = corners;
  const auto across = [&](const Vec2& from, const Vec2& to) { return t.x * (from.y - to.y) + t.y * (to.x - from.x); };
  return Vec3(across(b, c), across(c, a), across(a, b)) / determinant();
}

bool ParameterTriangle::contains(const Vec2& p) const {
  const double turn = orient2d(corners[0], corners[1], corners[2]) > 0 ? 1 : -1;
  for (size_t k = 0; k < 3; ++k)
    if (turn * orient2d(corners[k], corners[(k + 1) % 3], p) < 0) return false;
  return true;
}

bool in_half_open_region(std::span<const Vec2> polygon, const Vec2& p) {
  const size_t n = polygon.size();
  // Twice the area has the polygon's turn; a convex one with an inside has three corners that turn as it does.
  double turn = 0;
  for (size_t k = 0; k < n && turn == 0; ++k) turn = orient2d(polygon[k], polygon[(k + 1) % n], polygon[(k + 2) % n]);
  if (turn == 0) return false;
  for (size_t k = 0; k < n; ++k) {
    Vec2 q = polygon[k], r = polygon[(k + 1) % n];
    if (turn < 0) std::swap(q, r);
    if (q == r) continue;
    // The point moved by (d, d^2), d small, must lie strictly inside.
    double side = orient2d(q, r, p);
    if (side == 0) side = q.y - r.y;
    if (side == 0) side = r.x - q.x;
    if (!(side > 0)) return false;
  }
  return true;
}

}  // namespace lekalo::geometry
