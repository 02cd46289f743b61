// Rational Bezier patches of any degree as plain arrays: restriction, halving and evaluation without allocation.
#pragma once

#include <span>

#include "geometry/vectors.h"

namespace lekalo::geometry {

// Homogeneous control points, (i, j) at points[i * (degree_v + 1) + j]; i runs with s in [0, 1], j with t in [0, 1].
struct PatchView {
  const Vec4* points = nullptr;
  int degree_u = 0;
  int degree_v = 0;
  int count() const { return (degree_u + 1) * (degree_v + 1); }
  const Vec4& at(int i, int j) const { return points[i * (degree_v + 1) + j]; }
};

// Point and first derivatives by s and t.
struct PatchPoint {
  Vec3 point{0};
  Vec3 ds{0};
  Vec3 dt{0};
};
PatchPoint evaluate(const PatchView& patch, double s, double t);

// The halves of a patch at s = 1/2 or t = 1/2 (de Casteljau); room for patch.count() points each. `first` may be the
// patch's own points.
void halve_u(const PatchView& patch, Vec4* first, Vec4* second);
void halve_v(const PatchView& patch, Vec4* first, Vec4* second);

}  // namespace lekalo::geometry
