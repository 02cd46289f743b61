// Curves of edges between two vertices, with their images on both faces.
#pragma once

#include <array>
#include <vector>

#include "geometry/bodies/local/common_point.h"
#include "geometry/bodies/topology/line_on_surface.h"
#include "geometry/curves/analytic/circle.h"

namespace lekalo::geometry {

// What an edge is to run along: a surface beyond its borders, and parameters near to its ends.
struct EdgeSide {
  SurfacePtr surface;
  std::optional<Frame> plane;  // of a plane: the surface is Plane(*plane)
  std::array<Vec2, 2> near{};  // at the start and the end
};

struct EdgeCurve {
  CurvePtr curve;
  std::array<Curve2Ptr, 2> images;  // on each side, with the curve's parameter
};

// The part between two points of the curve in which two surfaces meet; from = to: all of a closed one. The way is the
// one that lies nearest to `guide`, points along the old edge. In closed form where it is a straight line, a parameter
// line of one of the surfaces (a circle, a profile), or the section of a surface that is ruled along a parameter by a
// plane; else by a search. Nothing where they do not meet so.
std::optional<EdgeCurve> intersection_edge(const std::array<EdgeSide, 2>& sides, const Vec3& from, const Vec3& to,
                                           const std::vector<Vec3>& guide, double size);

// The edge along a straight line of the first side's parameters between its ends; the second side's image is a line of
// its parameters or, in a plane, that of the curve. Nothing where the second surface does not run along it.
std::optional<EdgeCurve> parameter_edge(const std::array<EdgeSide, 2>& sides, const Vec3& from, const Vec3& to,
                                        double size);

// The image of a line of the parameter plane on a surface: a segment or an arc of a circle where it is one, with the
// line that has the same parameter.
LineOnSurface line_on_surface(const SurfacePtr& surface, const Vec2& from, const Vec2& to, double size);

// The circle that a curve runs along evenly, to rounding of things of that size: from the angle 0, counterclockwise.
// Null for another curve.
std::shared_ptr<const Circle> even_circle(const Curve& curve, double size);

}  // namespace lekalo::geometry
