// Sections of quadrics by planes, and the planes in which two quadrics meet (Golovanov 2016, 4.7).
//
// The plane n . p = h in coordinates along the principal axes of what the quadric is there:
//
//   l1 (s - s0)^2 + l2 (t - t0)^2 + K = 0         an ellipse, a hyperbola, a point, two lines;
//   l1 (s - s0)^2 + 2 b (t - t0) = 0              a parabola; with b = 0 two parallel lines or a double one.
//
// Two quadrics Q1, Q2 meet in planes where Q1 - c Q2 is the product of two linear functions: two spheres, two cylinders
// with parallel axes, surfaces of revolution about one axis, cones and cylinders about one sphere.
#pragma once

#include <optional>
#include <vector>

#include "geometry/queries/quadrics/conic.h"

namespace lekalo::geometry {

// p . a p + 2 b . p + c.
struct QuadricForm {
  Mat3 a{0.0};
  Vec3 b{0};
  double c = 0;
  double rounding = 0;  // of the value at points that matter

  double at(const Vec3& p) const { return glm::dot(p, a * p) + 2 * glm::dot(b, p) + c; }
  Vec3 gradient(const Vec3& p) const { return 2.0 * (a * p + b); }
};

// normal . p = height, the normal of unit length.
struct PlaneEquation {
  Vec3 normal{0, 0, 1};
  double height = 0;
};

struct PlaneIntersection {
  std::vector<Conic> conics;
  bool touching = false;        // along them
  std::vector<Vec3> contacts;   // isolated points
  std::vector<Vec3> crossings;  // of two of the conics
};

// Lengths: `size` of the part of space that matters, about the coordinates' origin; what comes nearer than `tolerance`
// touches. Nothing where rounding or the tolerance would have to decide.
struct SectionScale {
  double size = 1, tolerance = 0;
};
std::optional<PlaneIntersection> plane_section(const QuadricForm& quadric, const PlaneEquation& plane,
                                               const SectionScale& scale);

struct CommonPlanes {
  std::vector<PlaneEquation> planes;
  bool touching = false;    // the quadrics touch in the only one
  bool coincident = false;  // they are the same
};
// Nothing where the quadrics meet in no planes, or where rounding or the tolerance would have to decide.
std::optional<CommonPlanes> common_planes(const QuadricForm& first, const QuadricForm& second,
                                          const SectionScale& scale);

}  // namespace lekalo::geometry
