// What queries of one ray (hierarchy_query.cpp) and of lists of rays (hierarchy_lists.cpp) share.
#pragma once

#include <algorithm>
#include <cmath>

#include "render/trace/hierarchy_parts.h"

namespace lekalo::render {

// The end of a float ray, rounded outward: 2^-24 of x is enough, since boxes are inflated by more.
inline float ray_end(double x) { return static_cast<float>(x + 0x1p-23 * std::abs(x)); }

inline void begin(Hierarchy::Query& query, const Ray& ray) {
  query.range.lo = ray.t_min;
  query.range.hi = ray.t_max;
  query.kind = static_cast<uint32_t>(ray.kind);
  query.left_instance = ray.left_instance;
  query.left_face = ray.left_face;
  query.left_piece = ray.left_piece;
  query.left_for_good = ray.left_for_good;
}

// The point where the line meets the triangle's plane, in double, with the weights clamped to the triangle.
inline bool triangle_hit(const PackedMesh& mesh, int triangle, const geometry::Line& line, Hit& hit) {
  const PackedTriangle& at = mesh.triangles[triangle];
  const PackedVertex &v0 = mesh.vertices[at.vertex[0]], &v1 = mesh.vertices[at.vertex[1]],
                     &v2 = mesh.vertices[at.vertex[2]];
  const Vec3 &a = v0.point, ab = v1.point - a, ac = v2.point - a;
  const Vec3 n = glm::cross(ab, ac);
  const double slope = glm::dot(n, line.direction), area2 = glm::dot(n, n);
  if (slope == 0 || area2 == 0) return false;
  const double per_area2 = 1 / area2;
  hit.t = glm::dot(n, a - line.origin) / slope;
  const Vec3 p = line.at(hit.t) - a;
  hit.b = std::clamp(glm::dot(glm::cross(p, ac), n) * per_area2, 0.0, 1.0);
  hit.c = std::clamp(glm::dot(glm::cross(ab, p), n) * per_area2, 0.0, 1.0 - hit.b);
  hit.piece = triangle;
  hit.face = at.face;
  const geometry::Vec2 q = (1 - hit.b - hit.c) * v0.parameter + hit.b * v1.parameter + hit.c * v2.parameter;
  hit.u = q.x;
  hit.v = q.y;
  return std::isfinite(hit.t);
}

// What of a ray matters to a hierarchy: from where it enters the bounding sphere, in double.
struct Stretch {
  double start, end;  // t
  Vec3 from;          // at the start, relative to the sphere's centre
  double slack;       // float uncertainty of t
  bool empty;
};

inline __attribute__((always_inline)) Stretch stretch_in(const Hierarchy::Parts& p, const geometry::Line& line,
                                                         double t_min, double t_max) {
  const Vec3& d = line.direction;
  const Vec3 origin = line.origin - p.center;
  const double a = glm::dot(d, d), r2 = p.radius * p.radius * (1 + 2e-6);
  // Rays have unit directions; only lines in the space of an instance have others.
  const bool unit = std::abs(a - 1) < 1e-12;
  Stretch s{t_min, t_max, origin + t_min * d, kBoxInflation * p.radius / (unit ? 1 : std::sqrt(a)), false};
  if (!(glm::dot(s.from, s.from) <= r2)) {
    const double foot_point = -glm::dot(origin, d) / a;
    const Vec3 nearest = origin + foot_point * d;
    const double half = std::sqrt((r2 - glm::dot(nearest, nearest)) / a);  // NaN for a line that passes by
    s.start = std::max(t_min, foot_point - half);
    s.end = std::min(t_max, foot_point + half);
    s.from = origin + s.start * d;
    s.empty = !(half > 0);
  }
  s.empty = s.empty || !(s.start <= s.end);
  return s;
}

}  // namespace lekalo::render
