// Lines on surfaces that are given by differential equations: geodesics, lines of curvature, asymptotic lines
// (Golovanov 2016, 3.1; Patrikalakis, Maekawa 2002, chapters 9 and 10).
//
// Each is a curve in the parameter plane by the length of the line in space, a polynomial on each of its parts. Images
// are not wrapped where a surface is closed: they go on beyond its domain.
#pragma once

#include <optional>

#include "geometry/curves/splines/polynomial_curve.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

enum class LineEnd {
  length,    // the length asked for
  border,    // of the surface's domain, or a crease that the line does not cross
  pole,      // an edge of the domain that is one point
  singular,  // an umbilic or parabolic point
  closed,    // back at its beginning
  jagged     // the surface is not smooth enough to go on
};

struct SurfaceLine {
  std::shared_ptr<const PolynomialCurve> image;
  bool closed = false;
  LineEnd begins = LineEnd::length, ends = LineEnd::length;
  double error = 0;  // the largest distance in space seen between this line and one integrated by other steps
};

// All of these throw FieldError (fields of, from, to, through, length, as those of scene files are called).

// From `start` in the domain; `angle` in radians is that from r_u to its direction, counterclockwise seen from the
// side to which r_u x r_v points. `length` > 0 is finite; where the line meets the border of the domain it ends before.
// Over a crease it goes on at the same angle to it, as the shortest way does.
SurfaceLine geodesic(const Surface& surface, const Vec2& start, double angle, double length);

// The shortest geodesic between two points among all that go out from the first and are no longer than the
// straight line in the parameter plane; throws where there is none, since then the shortest way runs along the border.
SurfaceLine shortest_geodesic(const Surface& surface, const Vec2& from, const Vec2& to);

enum class CurvatureFamily { maximum, minimum };  // of the curvature signed by the surface's normal
enum class AsymptoticFamily {
  first,  // turned from the direction of the largest curvature counterclockwise seen from the normal
  second  // clockwise
};

// Through a point, in both directions to the border, an umbilic or a parabolic point, or closed; the parameter is 0 at
// the point. With a length, no farther than half of it each way. Without one a line that goes on for more than a
// hundred diameters of the surface is refused. The direction at the point is that in which u grows (or v, where u does
// not change).
SurfaceLine curvature_line(const Surface& surface, const Vec2& through, CurvatureFamily family,
                           std::optional<double> length);
SurfaceLine asymptotic_line(const Surface& surface, const Vec2& through, AsymptoticFamily family,
                            std::optional<double> length);

}  // namespace lekalo::geometry
