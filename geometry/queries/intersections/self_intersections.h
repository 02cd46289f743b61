// Where a curve or a surface meets itself at different parameters: all points, contacts and common parts of a curve
// (Golovanov 2016, 4.3), all curves of a surface (4.7, 4.8).
//
// Every place solves r(s) = r(t) for s = t. That solution is taken out with proof, not by a distance: by equations that
// it does not solve (curves), by a test that the surface is one-to-one (geometry/queries/contours/surface_joints.h).
#pragma once

#include <vector>

#include "geometry/contour.h"
#include "geometry/queries/intersections/curve_intersections.h"

namespace lekalo::geometry {

enum class SelfIntersectionKind {
  crossing,
  contact,  // the tangents are parallel
  cusp      // s = t: the curve stops and turns, r' = 0
};
struct CurveSelfIntersection {
  SelfIntersectionKind kind = SelfIntersectionKind::crossing;
  double s = 0, t = 0;  // s <= t
  Vec3 point{0};        // midway between both
  double distance = 0;  // between them
};
struct CurveSelfIntersections {
  std::vector<CurveSelfIntersection> points;  // by s; ends of common parts are not among them
  // Parts that the curve runs twice: from s.lo to s.hi as from `begin` to `end`, which are larger.
  std::vector<CommonPart> common;
};
// Of curves in space and in the plane. Where the ends of a closed curve join it does not meet itself. `tolerance` is
// relative to the size of the curve: what comes so near to itself far along the curve meets itself, and proportionally
// nearer where s and t are nearer.
CurveSelfIntersections self_intersections(const Curve& curve, double tolerance = kSamePoint);

// Each branch has two images on the surface; where they jump they cross a border that joins another. Points: `end`
// where a curve begins at a pinch point, `contact` where two sheets touch or the surface runs through one point again
// and again, as that of a spindle torus on its axis. Seams and poles are none. Where `complete` is false the surface
// covers itself, touches itself along a curve or has a cuspidal edge, which are left out. Throws std::invalid_argument
// for unbounded surfaces. `tolerance` as of intersect().
Contours self_intersection(const SurfacePtr& surface, double tolerance = kSamePoint);

}  // namespace lekalo::geometry
