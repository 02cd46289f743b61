// Where two curves meet, and where a curve meets a surface: all points, contacts and common parts (Golovanov 2016, 4.3
// and 4.4; capabilities 4.3b, 4.3c, 4.3e, 4.4b, 4.4c).
//
// Crossings are isolated by interval arithmetic (geometry/numerics/root_search.h): none is lost. Where the curves
// touch, r_a(s) = r_b(t) has a double root that no arithmetic of doubles tells from two near ones or none: such places
// are refined by the conditions of contact, (r_a - r_b) . r_a' = 0 and parallel tangents, and reported as contacts
// where the distance left is within the tolerance. Where they run together, the common part is an interval of each.
#pragma once

#include <vector>

#include "geometry/curve.h"
#include "geometry/surface.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

struct CurveIntersection {
  double s = 0, t = 0;   // on the first and on the second curve
  Vec3 point{0};         // midway between both
  double distance = 0;   // between them
  bool contact = false;  // they touch here: the tangents are parallel
};
// A common part: from s.lo to s.hi the first curve runs along the second, there from `begin` to `end` (begin > end
// where it runs backwards).
struct CommonPart {
  Interval s;
  double begin = 0, end = 0;
};
struct CurveIntersections {
  std::vector<CurveIntersection> points;  // by s; ends of common parts are not among them
  std::vector<CommonPart> common;         // by s
};
// `tolerance` is relative to the size of both. A closed curve's seam counts once.
CurveIntersections intersect(const Curve& a, const Curve& b, double tolerance = kSamePoint);

struct SurfaceIntersection {
  double t = 0, u = 0, v = 0;  // on the curve and on the surface
  Vec3 point{0};               // of the curve
  double distance = 0;         // from the surface's
  bool contact = false;        // the curve touches the surface here
};
struct SurfaceIntersections {
  std::vector<SurfaceIntersection> points;  // by t
  std::vector<Interval> on_surface;         // parts of the curve that lie on the surface
};
SurfaceIntersections intersect(const Curve& curve, const Surface& surface, double tolerance = kSamePoint);

}  // namespace lekalo::geometry
