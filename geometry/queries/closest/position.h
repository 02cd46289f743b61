// Where a point lies: above or below a surface, inside or outside of a region of the parameter plane or of a body
// (Golovanov 2016, 4.11; capabilities 4.11a, 4.11b).
#pragma once

#include "geometry/bodies/trims/trim.h"
#include "geometry/body.h"
#include "geometry/queries/closest/distance.h"
#include "geometry/queries/rays/line_intersections.h"
#include "geometry/shape.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// Points nearer than this part of the size are on a surface, border or body.
inline constexpr double kOnSurface = 1e-12;

struct SurfacePosition {
  // On the side of the normal, on the other, on the surface, or in the continuation of its tangent plane beyond a
  // border.
  enum class Side { above, below, on, beside };
  Side side = Side::on;
  double distance = 0;  // of the nearest point
  double height = 0;    // along the normal there: plus or minus the distance where the foot point is no border
  DistancePlace nearest;
};
// By the nearest point: v . m > 0 is above, v the way from it and m the normal there; on a crease the sum of the
// normals on both sides. Throws std::invalid_argument for an unbounded surface that is no plane.
SurfacePosition position(const Vec3& point, const Surface& surface);

enum class Containment { inside, outside, on };

struct RegionPosition {
  Containment where = Containment::outside;
  double distance = 0;  // of the nearest point of the border, in the parameter plane; infinite where there is none
  int loop = -1;        // of the nearest point: its loop, curve of that loop and parameter
  int curve = -1;
  double t = 0;
  Vec2 nearest{0};
};
// The border decides nothing here: as for trims, a line to the point crosses the loops an odd number of times if it is
// inside, so that vertices and cusps need no normals of their own.
RegionPosition position(const Vec2& point, const std::vector<std::vector<TrimRegion::Part>>& loops);

// The same for the region of a face: poles and seams are no border, and parameters wrap where the surface is periodic.
// Loops and curves are numbered in the face.
RegionPosition position(const Vec2& point, const Body& body, int face);

struct BodyPosition {
  Containment where = Containment::outside;
  double distance = 0;  // from the nearest point of the body's surface
  DistancePlace nearest;
  bool by_lines = false;  // the nearest point is on an edge or vertex: crossings of lines decided
};
// Of a closed body; throws std::invalid_argument for an open one. The nearest point decides where it lies inside of a
// face: the point is inside if the way to it runs against the outward normal. On edges and vertices several lines
// through the point vote by the number of crossings.
BodyPosition position(const Vec3& point, const Body& body);

// Inside of a closed body that is prepared for lines, by the vote alone: for points off its boundary.
bool is_inside(const Vec3& point, const LineIntersector& body);

// Inside of a closed shape, by the same vote; throws std::invalid_argument for an open one.
bool is_inside(const Vec3& point, const Shape& shape);

}  // namespace lekalo::geometry
