// Outlines, edges and sections of shapes that are made of balls, as seen: tubes (Golovanov 2016, 4.6 for the
// silhouettes of the envelope) and balls.
//
// A point c(t) + R(t) n of the wall of a tube, |n| = 1, is on its outline if
//
//   n . c' = -R'          it is on the envelope of the balls,
//   n . i = 0             the line of sight i touches there; from an eye at e, n . (c - e) = -R,
//
// two planes through which n = x a + y b +- z a x b is found in closed form, a = c' and b = i or c - e. Where
// 1 - |x a + y b|^2 < 0 the balls hide one another altogether, and the two branches join at the ends of such stretches.
// At ends, corners and where the tube is seen end-on the outline goes on along the circle of one ball.
#pragma once

#include <vector>

#include "geometry/contour.h"
#include "geometry/queries/contours/plane_section.h"
#include "geometry/shapes/tube/balls.h"
#include "geometry/shapes/tube/tube.h"

namespace lekalo::geometry {

struct ShapeOutline {
  CurvePtr curve;     // to 1e-10 of the size where it is no circle
  bool edge = false;  // a sharp edge; else a silhouette, without cusps inside
  // Of silhouettes: a vector, by the same parameter, along which lines beside the curve miss the shape.
  CurvePtr outward_offset;
  std::vector<double> turns;  // of edges, by t: where a surface at the edge turns away from the viewer
  Curve2Ptr image;            // of the line in which a surface is met: on that surface
};

struct ShapeOutlines {
  std::vector<ShapeOutline> lines;
  bool complete = true;  // false where some were not found to that precision
};

// Where tubes go through themselves outlines end to 1e-6 of the size; of the edges there only those of corners between
// straight parts are among these (tube_lines.h has the others).
ShapeOutlines outlines(const Tube& tube, const ViewOf& view);
// With the circles in which balls meet.
ShapeOutlines outlines(const Balls& balls, const ViewOf& view);
// The lines in which a plane cuts these shapes, all of them edges; `view` is that of the turns. The normal must not be
// zero. Of balls circles, as far as they are outside of the others. Of tubes (tube_section.cpp) lines of the wall, of
// round ends and corners, and chords of flat ends; bulges smaller than 1/256 of a piece of the curve may be missed.
ShapeOutlines plane_section(const Balls& balls, const Vec3& origin, const Vec3& normal, const ViewOf& view);
ShapeOutlines plane_section(const Tube& tube, const Vec3& origin, const Vec3& normal, const ViewOf& view);

}  // namespace lekalo::geometry
