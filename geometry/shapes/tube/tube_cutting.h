// What of a line on tubes lies on their boundaries (tube_lines.h, tube_edges.cpp).
#pragma once

#include <functional>
#include <vector>

#include "geometry/shapes/tube/ball_outlines.h"

namespace lekalo::geometry {

struct TubeLine {
  CurvePtr curve;
  // Whether a place is bare, as seen from so far outside, of the size.
  std::function<bool(double t, double beside)> is_exposed;
  std::vector<std::function<Vec3(double t)>> outward;  // normals of the tubes there
  Curve2Ptr image;                                     // on the surface that is met, if any
  int places = 64;                                     // where it is asked at least
};

// Adds the bare stretches, with turns. Their ends are where a point 1e-7 of the size outside of the surface is found
// inside of the tube; a line is so far off its end as it is seen from outside, and half as far from half as far: so it
// is moved by twice the difference.
void add_bare(const TubeLine& line, const ViewOf& view, ShapeOutlines& found);

}  // namespace lekalo::geometry
