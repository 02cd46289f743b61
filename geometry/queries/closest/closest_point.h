// Projection of a point on a curve or a surface: all foot points, not only the nearest (Golovanov 2016, 4.1 and 4.2;
// capabilities 4.1b, 4.2b).
//
// A foot point is a place where the way to the point is perpendicular to the curve, (p - r) . r' = 0, or to the
// surface, (p - r) . r_u = (p - r) . r_v = 0: where the distance is stationary. All of them are found, certified by
// interval arithmetic (geometry/numerics/root_search.h). Ends, edges, corners and places where the tangent jumps are
// listed where the distance has a minimum there. So the nearest point of the whole is the first of the list.
//
// On rational pieces the search is for zeros of polynomials (geometry/queries/closest/foot_point_polynomials.h), which
// are made once for all points: a projector is worth having for more than one.
#pragma once

#include <memory>
#include <vector>

#include "geometry/curve.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

class Plane;
class ProjectorOfParts;

enum class FootPointKind {
  minimum,  // of the distance
  maximum,
  saddle,      // of surfaces
  degenerate,  // the point is a centre of curvature there: the second derivative of the distance tells nothing
  border       // an end, edge, corner, kink or pole, where the distance is least but not stationary
};

struct CurveFootPoint {
  double t = 0;
  Vec3 point{0};
  double distance = 0;
  FootPointKind kind = FootPointKind::minimum;
};
struct CurveFootPoints {
  std::vector<CurveFootPoint> foot_points;  // by distance, then t
  // Parts of the curve all of whose points are foot points: arcs about the point. Their middles stand among the foot
  // point points.
  std::vector<Interval> arcs;
};
// In the domain of the curve; a closed curve has no ends. Safe to use from many threads.
class CurveProjector {
 public:
  explicit CurveProjector(CurvePtr curve);
  // With pieces that it does not know itself.
  CurveProjector(CurvePtr curve, std::vector<CurvePiece> pieces);
  CurveFootPoints foot_points(const Vec3& point) const;
  // Those that are no farther than `within`: pieces all of which are farther are not searched.
  CurveFootPoints foot_points(const Vec3& point, double within) const;

 private:
  struct Prepared;
  std::shared_ptr<const Prepared> prepared_;
};
CurveFootPoints project(const Vec3& point, const Curve& curve);

struct SurfaceFootPoint {
  double u = 0, v = 0;
  Vec3 point{0};
  double distance = 0;
  FootPointKind kind = FootPointKind::minimum;
};
struct SurfaceFootPoints {
  std::vector<SurfaceFootPoint> foot_points;  // by distance, then u, then v
  // Parts of the surface that hold more foot points than can be told apart: the point is the centre of a sphere, on the
  // axis of a surface of revolution, or near to such a place. Their middles stand among the foot points.
  std::vector<Rectangle> regions;
};
// In the domain of the surface; at a step its edges are those of both sides. Throws std::invalid_argument for an
// unbounded one that is no plane, cylinder or cone, and where its steps are not all known. Safe to use from many
// threads.
class SurfaceProjector {
 public:
  explicit SurfaceProjector(SurfacePtr surface);
  SurfaceFootPoints foot_points(const Vec3& point) const;

 private:
  struct Prepared;
  std::shared_ptr<const Prepared> prepared_;
  std::shared_ptr<const Plane> plane_;             // an unbounded one instead
  SurfacePtr unbounded_;                           // another
  std::shared_ptr<const ProjectorOfParts> parts_;  // of one with kinks or steps
};
SurfaceFootPoints project(const Vec3& point, const Surface& surface);

}  // namespace lekalo::geometry
