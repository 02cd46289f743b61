// Whether curves and surfaces are admissible: r' != 0 with a bounded curvature, r_u x r_v != 0 (Zavyalov, Leus,
// Skorospelov 1985, II.1, the classes Q and T).
//
// Parts of the domain are halved until enclosures prove it there; what stays unproven at the smallest parts is
// singular: a cusp, a pole, an edge that shrinks to a point.
#pragma once

#include <vector>

#include "geometry/curve.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

struct CurveRegularity {
  int pieces = 0;                // smooth ones; the tangent may turn abruptly between them
  double min_speed = 0;          // |r'| is nowhere smaller, proven; 0 where it may vanish
  double curvature_bound = 0;    // |r' x r''| / |r'|^3 is nowhere larger, proven; infinite where the speed may vanish
  std::vector<double> singular;  // parameters where the speed may vanish, each for all beside it
  bool is_regular() const { return singular.empty(); }
};
// The domain must be finite; throws std::invalid_argument.
CurveRegularity regularity(const Curve& curve);

struct SurfaceRegularity {
  double min_area = 0;              // |r_u x r_v| is nowhere smaller, proven; 0 where it may vanish
  std::vector<Rectangle> singular;  // parts of the domain where it may vanish, neighbouring ones together
  bool is_regular() const { return singular.empty(); }
};
// The domain must be finite; throws std::invalid_argument.
SurfaceRegularity regularity(const Surface& surface);

}  // namespace lekalo::geometry
